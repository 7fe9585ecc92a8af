/* slab_image.c - see slab_image.h and image/bakeslab-image.cc, the program that does the work. */
#include "file/slab_image.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/files.h"
#include "base/process.h"

static const char PROGRAM[] = "lib/canned/bakeslab-image";
static const char LETTERS[] = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/* Reads what the program writes; where that breaks off, the program's own words say why. */
static enum result take(FILE *from, struct picture *picture, int *transparent,
                        struct error *error) {
  result_fail(error, RESULT_IO, "%s broke off", PROGRAM);
  if (fscanf(from, "%d %d %d%*[^\n]", &picture->width, &picture->height, transparent) != 3 ||
      getc(from) != '\n')
    return RESULT_IO;
  size_t count = (size_t)picture->width * (size_t)picture->height, pixel = 3 * sizeof(float);
  picture->rgb = calloc(count, pixel);
  if (!picture->rgb)
    return result_fail(error, RESULT_MEMORY, "out of memory for %d x %d pixels", picture->width,
                       picture->height);
  return fread(picture->rgb, pixel, count, from) == count ? RESULT_OK : RESULT_IO;
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
  FILE *from = fdopen(ends[0], "r");
  enum result result = from ? process_start(&process, error) : result_no_memory(error);
  close(ends[1]);
  bool started = result == RESULT_OK;
  if (started) result = take(from, picture, transparent, error);
  if (from)
    fclose(from);
  else
    close(ends[0]);
  if (started && process_wait(&process, result == RESULT_MEMORY ? NULL : error) != RESULT_OK &&
      result != RESULT_MEMORY)
    result = RESULT_BAD;
  return result;
}

enum result slab_image_read(const char *path, const void *bytes, size_t size, const char *suffix,
                            struct picture *picture, bool *transparent, struct error *error) {
  const char *dot = strrchr(path, '.');
  int clear = 0;
  enum result result = RESULT_OK;
  *picture = (struct picture){0};
  if (!suffix) suffix = dot ? dot + 1 : "";
  char *program = files_beside_program(PROGRAM);
  FILE *in = bytes ? tmpfile() : fopen(path, "re");
  if (!in || (bytes && (fwrite(bytes, 1, size, in) != size || fflush(in) != 0)))
    result = result_fail(error, RESULT_IO, "%s", strerror(errno));
  else if (!program)
    result = result_fail(error, RESULT_IO,
                         "%s, which reads images, is not where this program was installed; run "
                         "`make` or `make install` again",
                         PROGRAM);
  else
    result = run(program, suffix, fileno(in), picture, &clear, error);
  if (result != RESULT_OK) picture_free(picture);
  if (transparent) *transparent = clear;
  if (in) fclose(in);
  free(program);
  return result_at(result, error, "%s", path);
}
