#include "export/cycles_blend.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/files.h"
#include "base/process.h"
#include "slab/slab.h"

enum { FILE_NAME_SIZE = SLAB_NAME_SIZE + 8 };

/* Runs a program in the folder; whether it is there is in `exit`. */
static enum result run(const char *const *words, const char *folder, int *exit,
                       struct error *error) {
  struct process process = {.words = words,
                            .folder = folder,
                            .in = PROCESS_NOTHING,
                            .out = PROCESS_NOTHING,
                            .errors = PROCESS_SAID};
  enum result result = process_run(&process, error);
  *exit = process.exit;
  return result;
}

enum result cycles_blend(const char *folder, const char *name, struct error *error) {
  char lamp[FILE_NAME_SIZE], blend[FILE_NAME_SIZE];
  snprintf(lamp, sizeof lamp, "%s.json", name);
  snprintf(blend, sizeof blend, "%s.blend", name);
  const char *given = getenv("BLENDER"), *blender = given && *given ? given : "blender";
  const char *const try_bpy[] = {"python3", "-c", "import bpy", NULL};
  const char *const by_blender[] = {blender,
                                    "-b",
                                    "--factory-startup",
                                    "--python-exit-code",
                                    "1",
                                    "-P",
                                    "canned_lights.py",
                                    "--",
                                    lamp,
                                    "--only",
                                    "--save",
                                    blend,
                                    NULL};
  const char *const by_bpy[] = {"python3", "canned_lights.py", lamp, "--only", "--save", blend,
                                NULL};
  int exit = 0;
  enum result result = run(by_blender, folder, &exit, error);
  if (result != RESULT_OK && exit == PROCESS_MISSING && !(given && *given)) {
    if (run(try_bpy, folder, &exit, error) != RESULT_OK)
      return result_fail(error, RESULT_IO,
                         "--blend: there is no blender, and no python3 with the module bpy; name "
                         "one by BLENDER in the environment, or leave --blend out");
    result = run(by_bpy, folder, &exit, error);
  }
  if (result != RESULT_OK) return result_at(result, error, "--blend: Blender");
  char *path = files_join(folder, blend);
  if (!path) return result_no_memory(error);
  if (access(path, R_OK) != 0)
    result = result_fail(error, RESULT_IO, "--blend: Blender has made no %s", blend);
  free(path);
  return result;
}
