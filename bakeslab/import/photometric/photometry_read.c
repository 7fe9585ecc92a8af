/* photometry_read.c - a photometric file of either kind. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "import/photometric/eulumdat.h"
#include "import/photometric/ies.h"

enum { MOST_BYTES = 64 << 20 }; /* no such file has more */

static enum result read_all(const char *path, char **text, size_t *size, struct error *error) {
  FILE *file = fopen(path, "rb");
  struct stat about;
  *text = NULL;
  if (!file || fstat(fileno(file), &about) != 0) {
    result_fail(error, RESULT_IO, "%s: cannot be read: %s", path, strerror(errno));
    if (file) fclose(file);
    return RESULT_IO;
  }
  size_t room = S_ISREG(about.st_mode) && about.st_size < MOST_BYTES ? (size_t)about.st_size + 1
                                                                     : MOST_BYTES + 1;
  enum result result = RESULT_OK;
  if (!(*text = malloc(room))) result = result_no_memory(error);
  *size = *text ? fread(*text, 1, room, file) : 0;
  if (result == RESULT_OK && ferror(file))
    result = result_fail(error, RESULT_IO, "%s: cannot be read: %s", path, strerror(errno));
  if (result == RESULT_OK && *size > MOST_BYTES)
    result = result_fail(error, RESULT_BAD, "%s: is larger than any photometric file", path);
  fclose(file);
  return result;
}

enum result photometry_read(const char *path, struct photometry *lamp, struct warnings *notes,
                            struct error *error) {
  const char *slash = strrchr(path, '/');
  char *text = NULL, *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
  size_t size = 0;
  *lamp = (struct photometry){0};
  enum result result = folder ? read_all(path, &text, &size, error) : result_no_memory(error);
  if (result == RESULT_OK) {
    if (ies_is(text, size))
      result = ies_read(text, size, folder, lamp, notes, error);
    else
      result = eulumdat_read(text, size, lamp, notes, error);
    result = result_at(result, error, "%s", path);
  }
  if (result != RESULT_OK) photometry_free(lamp);
  free(folder);
  free(text);
  return result;
}
