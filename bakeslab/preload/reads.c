/* reads.c - preloaded into POV-Ray while it parses a lamp script: lists every
 * file that it opens, one path a line, in the file that the environment variable
 * CANNED_READS names; those that it may write begin with >. POV-Ray has no option for that, and
 * file names in scripts may be computed, so that the script's text does not show them. */
#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void note(const char *path, int written) {
  static __thread int busy;
  const char *list = getenv("CANNED_READS");
  if (!list || busy) return;
  busy = 1;
  char *real = realpath(path, NULL);
  int file = open(list, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (real && file >= 0) dprintf(file, "%s%s\n", written ? ">" : "", real);
  if (file >= 0) close(file);
  free(real);
  busy = 0;
}

/* The next definition of the function that is being replaced. */
#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

#define FOPEN(name)                                                                                \
  FILE *name(const char *path, const char *mode) {                                                 \
    FILE *file = NEXT(name)(path, mode);                                                           \
    if (file) note(path, mode[0] != 'r' || strchr(mode, '+'));                                     \
    return file;                                                                                   \
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
