#include "engine.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>

#include "lamps.h"
#include "testing.h"

enum { NO_ENGINE = 77, NO_PYTHON = 127 };

static const char *python(enum engine engine) {
  const char *given = getenv(engine == MITSUBA ? "MITSUBA_PYTHON" : "BLENDER_PYTHON");
  return given && *given ? given : "python3";
}

/* Scripts say by their exit status. */
bool engine_there(enum engine engine) {
  static const char *const names[] = {"Radiance", "Mitsuba", "Blender"};
  char command[512] = "for p in rtrace oconv xform; do command -v $p || exit 77; done >/dev/null";
  if (engine != RADIANCE)
    snprintf(command, sizeof command, "%s tests/export/%s_rays.py </dev/null >'%s' 2>&1",
             python(engine), engine == MITSUBA ? "mitsuba" : "blender", scratch("said"));
  int status = WEXITSTATUS(system(command));
  if (status != NO_ENGINE && status != NO_PYTHON) return true;
  print_message("# skipped: %s is not installed\n", names[engine]);
  return false;
}

double engine_mitsuba(const char *folder, const char *name, const char *more, double (*rows)[6],
                      int count, double (*rgb)[3]) {
  char command[1024];
  snprintf(command, sizeof command, "%s tests/export/mitsuba_rays.py '%s' %s %s", python(MITSUBA),
           folder, name, more);
  return lamp_run(command, rows[0], 6, count, rgb);
}

double engine_blender(const char *script, const char *folder, const char *name, const char *more,
                      double (*rows)[6], int count, double (*rgb)[3]) {
  char command[1024];
  snprintf(command, sizeof command, "%s tests/export/%s '%s' %s %s", python(BLENDER), script,
           folder, name, more);
  return lamp_run(command, rows[0], 6, count, rgb);
}

double engine_radiance(const char *folder, const char *scene, const char *more, double (*rows)[6],
                       int count, double (*rgb)[3]) {
  char command[1024];
  snprintf(command, sizeof command,
           "cd '%s' && echo '%s' | oconv - >scene.oct && rtrace -h -ab 0 %s scene.oct", folder,
           scene, more);
  return lamp_run(command, rows[0], 6, count, rgb);
}
