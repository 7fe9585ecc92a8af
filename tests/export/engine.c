#include "engine.h"

#include <stdio.h>
#include <stdlib.h>

#include "lamps.h"
#include "testing.h"

static const char *python(const char *variable) {
  const char *given = getenv(variable);
  return given && *given ? given : "python3";
}

/* Scripts say by their exit status. */
bool engine_there(enum engine engine) {
  static const char *const names[] = {"Radiance", "Mitsuba", "Mitsuba with LLVM", "Blender"};
  char command[512] = "for p in rtrace oconv xform; do command -v $p || exit 1; done >/dev/null";
  if (engine == BLENDER)
    snprintf(command, sizeof command, "%s tests/export/blender_rays.py </dev/null >'%s' 2>&1",
             python("BLENDER_PYTHON"), scratch("said"));
  else if (engine != RADIANCE)
    snprintf(command, sizeof command, "%s tests/export/mitsuba_rays.py %s </dev/null >'%s' 2>&1",
             python("MITSUBA_PYTHON"), engine == MITSUBA ? "irradiance" : "rays", scratch("said"));
  if (system(command) == 0) return true;
  print_message("# skipped: %s is not installed\n", names[engine]);
  return false;
}

double engine_mitsuba(const char *folder, const char *name, const char *more, double (*rows)[6],
                      int count, double (*rgb)[3]) {
  char command[1024];
  snprintf(command, sizeof command, "%s tests/export/mitsuba_rays.py '%s' %s %s",
           python("MITSUBA_PYTHON"), folder, name, more);
  return lamp_run(command, rows[0], 6, count, rgb);
}

double engine_blender(const char *script, const char *folder, const char *name, const char *more,
                      double (*rows)[6], int count, double (*rgb)[3]) {
  char command[1024];
  snprintf(command, sizeof command, "%s tests/export/%s '%s' %s %s", python("BLENDER_PYTHON"),
           script, folder, name, more);
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
