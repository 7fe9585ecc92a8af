/* slab_image.c - see slab_image.h and image/bakeslab-image.cc, the program that does the work. */
#include "file/slab_image.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/files.h"
#include "base/process.h"

static const char PROGRAM[] = "lib/canned/bakeslab-image";
static const char LETTERS[] = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/* Reads what the program writes; where that breaks off, the program's own words say why. */
static enum result take(FILE *from, struct picture *picture, struct slab_image_says *says,
                        struct error *error) {
  int transparent = 0, several = 0, integers = 0;
  result_fail(error, RESULT_IO, "%s broke off", PROGRAM);
  if (fscanf(from, "%d %d %d %d %d %lf", &picture->width, &picture->height, &transparent, &several,
             &integers, &says->pixel_aspect) != 6 ||
      getc(from) != '\n')
    return RESULT_IO;
  says->transparent = transparent;
  says->several = several;
  says->integers = integers;
  size_t count = (size_t)picture->width * (size_t)picture->height, pixel = 3 * sizeof(float);
  picture->rgb = calloc(count, pixel);
  if (!picture->rgb)
    return result_fail(error, RESULT_MEMORY, "out of memory for %d x %d pixels", picture->width,
                       picture->height);
  return fread(picture->rgb, pixel, count, from) == count ? RESULT_OK : RESULT_IO;
}

/* Runs the program on an open file. */
static enum result run(const char *program, const char *suffix, enum slab_image_colours colours,
                       int in, struct picture *picture, struct slab_image_says *says,
                       struct error *error) {
  char kind[16];
  const char *const words[] = {program, kind, colours == SLAB_IMAGE_OWN ? "own" : "srgb", NULL};
  int ends[2];
  snprintf(kind, sizeof kind, "%.*s", (int)strspn(suffix, LETTERS), suffix);
  if (pipe2(ends, O_CLOEXEC) != 0)
    return result_fail(error, RESULT_IO, "pipe: %s", strerror(errno));
  struct process process = {.words = words, .in = in, .out = ends[1], .errors = PROCESS_SAID};
  FILE *from = fdopen(ends[0], "r");
  enum result result = from ? process_start(&process, error) : result_no_memory(error);
  close(ends[1]);
  bool started = result == RESULT_OK;
  if (started) result = take(from, picture, says, error);
  if (from)
    fclose(from);
  else
    close(ends[0]);
  if (started && process_wait(&process, result == RESULT_MEMORY ? NULL : error) != RESULT_OK &&
      result != RESULT_MEMORY)
    result = RESULT_BAD;
  return result;
}

/* A file that can be sought in. Nothing waits for a pipe's other end. */
static enum result open_file(const char *path, int *fd, struct error *error) {
  struct stat status;
  *fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (*fd < 0 || fstat(*fd, &status) != 0)
    return result_fail(error, RESULT_IO, "%s", strerror(errno));
  if (S_ISREG(status.st_mode)) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "is not a file");
}

static enum result keep_bytes(const void *bytes, size_t size, int *fd, struct error *error) {
  *fd = memfd_create("image", MFD_CLOEXEC);
  size_t done = 0;
  while (*fd >= 0 && done < size) {
    ssize_t put = write(*fd, (const char *)bytes + done, size - done);
    if (put < 0) break;
    done += (size_t)put;
  }
  if (*fd >= 0 && done == size) return RESULT_OK;
  return result_fail(error, RESULT_IO, "%s", strerror(errno));
}

enum result slab_image_read(const char *path, const void *bytes, size_t size, const char *suffix,
                            enum slab_image_colours colours, struct picture *picture,
                            struct slab_image_says *says, struct error *error) {
  const char *dot = strrchr(path, '.');
  struct slab_image_says unasked;
  int in = -1;
  *picture = (struct picture){0};
  if (!suffix) suffix = dot ? dot + 1 : "";
  char *program = files_beside_program(PROGRAM);
  enum result result = bytes ? keep_bytes(bytes, size, &in, error) : open_file(path, &in, error);
  if (result == RESULT_OK && !program)
    result = result_fail(error, RESULT_IO,
                         "%s, which reads images, is not where this program was installed; run "
                         "`make` or `make install` again",
                         PROGRAM);
  if (result == RESULT_OK)
    result = run(program, suffix, colours, in, picture, says ? says : &unasked, error);
  if (result != RESULT_OK) picture_free(picture);
  if (in >= 0) close(in);
  free(program);
  return result_at(result, error, "%s", path);
}
