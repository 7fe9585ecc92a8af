/* reads.c - preloaded into POV-Ray. Where the environment variable CANNED_MATT is set, scripts come
 * without highlights and rainbows (matt.h). In a trial run it lists every file that POV-Ray opens,
 * one path a line, in the file that CANNED_READS names; those that it may write begin with >, a
 * line * says that a script had highlights, one & that a finish has a diffuse back side. POV-Ray
 * has no option for that, and file names in scripts may be computed, so that the script's text does
 * not show them. */
#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "preload/matt.h"

static __thread int busy; /* with a list, which is no file of the script's */

static void note_line(const char *list, const char *mark, const char *path) {
  busy = 1;
  int file = open(list, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file >= 0) dprintf(file, "%s%s\n", mark, path);
  if (file >= 0) close(file);
  busy = 0;
}

/* The process has read a scene: it is POV-Ray. What a wrapper writes is none of the script's. */
static volatile int scene_read;

static void note(const char *path, int written) {
  const char *list = getenv("CANNED_READS");
  if (!list || busy) return;
  char *real = realpath(path, NULL);
  const char *name = real ? strrchr(real, '/') : NULL;
  if (name && !written && !strcmp(name, "/scene.pov")) scene_read = 1;
  if (real && (scene_read || !written)) note_line(list, written ? ">" : "", real);
  free(real);
}

static FILE *matt(FILE *file, const char *mode) {
  const char *list = getenv("CANNED_READS");
  int found = 0;
  if (file && mode[0] == 'r' && getenv("CANNED_MATT")) file = matt_script(file, &found);
  if (found & MATT_HIGHLIGHTS && list) note_line(list, "*", "");
  if (found & MATT_TRANSLUCENT && list) note_line(list, "&", "");
  return file;
}

/* The next definition of the function that is being replaced. */
#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

#define FOPEN(name)                                                                                \
  FILE *name(const char *path, const char *mode) {                                                 \
    FILE *file = NEXT(name)(path, mode);                                                           \
    if (file) note(path, mode[0] != 'r' || strchr(mode, '+'));                                     \
    return matt(file, mode);                                                                       \
  }

#define OPEN(name)                                                                                 \
  int name(const char *path, int flags, ...) {                                                     \
    va_list rest;                                                                                  \
    va_start(rest, flags);                                                                         \
    int mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(rest, int) : 0;                            \
    va_end(rest);                                                                                  \
    int file = NEXT(name)(path, flags, mode);                                                      \
    if (file >= 0 && !(flags & O_DIRECTORY)) note(path, (flags & O_ACCMODE) != O_RDONLY);          \
    return file;                                                                                   \
  }

FOPEN(fopen)
FOPEN(fopen64)
OPEN(open)
OPEN(open64)
