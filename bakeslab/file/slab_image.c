/* slab_image.c - see slab_image.h and image/bakeslab-image.cc, the program that does the work. */
#include "file/slab_image.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/files.h"
#include "base/process.h"

static const char PROGRAM[] = "lib/canned/bakeslab-image";
static const char LETTERS[] = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/* A file without a name that holds the bytes; -1 with errno. */
static int hold(const char *bytes, size_t size) {
  int file = memfd_create("image", MFD_CLOEXEC);
  while (file >= 0 && size > 0) {
    ssize_t put = write(file, bytes, size);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) {
      int why = errno;
      close(file);
      errno = why;
      return -1;
    }
    bytes += put;
    size -= (size_t)put;
  }
  return file;
}

/* Reads what the program writes. Closes `end`. */
static enum result take(int end, struct picture *picture, int *transparent, struct error *error) {
  FILE *from = fdopen(end, "r");
  enum result result = RESULT_OK;
  if (!from) {
    close(end);
    return result_fail(error, RESULT_MEMORY, "out of memory");
  }
  if (fscanf(from, "%d %d %d%*[^\n]", &picture->width, &picture->height, transparent) != 3) {
    result = result_fail(error, RESULT_IO, "%s did not say what it read", PROGRAM);
    goto out;
  }
  getc(from); /* the line's end */
  size_t count = (size_t)picture->width * (size_t)picture->height, pixel = 3 * sizeof(float);
  picture->rgb = calloc(count, pixel);
  if (!picture->rgb)
    result = result_fail(error, RESULT_MEMORY, "out of memory for %d x %d pixels", picture->width,
                         picture->height);
  else if (fread(picture->rgb, pixel, count, from) != count)
    result = result_fail(error, RESULT_IO, "%s broke off", PROGRAM);
out:
  fclose(from);
  return result;
}

/* Runs the program on an open file. */
static enum result run(const char *program, const char *suffix, int in, struct picture *picture,
                       int *transparent, struct error *error) {
  char kind[16];
  const char *const words[] = {program, kind, NULL};
  int ends[2];
  snprintf(kind, sizeof kind, "%.*s", (int)strspn(suffix, LETTERS), suffix);
  if (pipe2(ends, O_CLOEXEC) != 0)
    return result_fail(error, RESULT_IO, "pipe: %s", strerror(errno));
  struct process process = {.words = words, .in = in, .out = ends[1], .errors = PROCESS_SAID};
  enum result result = process_start(&process, error);
  close(ends[1]);
  if (result != RESULT_OK) {
    close(ends[0]);
    return result;
  }
  result = take(ends[0], picture, transparent, error);
  /* Where it told nothing, or not all, its own words say why. */
  if (process_wait(&process, result == RESULT_MEMORY ? NULL : error) != RESULT_OK &&
      result != RESULT_MEMORY)
    result = RESULT_BAD;
  return result;
}

enum result slab_image_read(const char *path, const void *bytes, size_t size, const char *suffix,
                            struct picture *picture, bool *transparent, struct error *error) {
  struct error why;
  const char *dot = strrchr(path, '.');
  int clear = 0, in = -1;
  *picture = (struct picture){0};
  enum result result = RESULT_OK;
  char *program = files_beside_program(PROGRAM);
  if (!program)
    result = result_fail(&why, RESULT_IO,
                         "%s, which reads images, is not where this program was installed; run "
                         "`make` or `make install` again",
                         PROGRAM);
  if (result == RESULT_OK) {
    in = bytes ? hold(bytes, size) : open(path, O_RDONLY | O_CLOEXEC);
    if (in < 0) result = result_fail(&why, RESULT_IO, "%s", strerror(errno));
  }
  if (!suffix) suffix = dot ? dot + 1 : "";
  if (result == RESULT_OK) result = run(program, suffix, in, picture, &clear, &why);
  if (result != RESULT_OK) result_fail(error, result, "%s: %s", path, why.text);
  if (result != RESULT_OK) picture_free(picture);
  if (transparent) *transparent = clear;
  if (in >= 0) close(in);
  free(program);
  return result;
}
