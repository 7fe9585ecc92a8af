#include "import/import_photometry.h"

#include <string.h>

/* A line that starts with TILT=: all files since 1986 have it. */
static bool is_ies(const char *head, size_t size, const char *path) {
  (void)path;
  if (size >= 5 && !memcmp(head, "IESNA", 5)) return true;
  for (const char *at = head; (at = memchr(at, 'T', size - (size_t)(at - head))); ++at)
    if (!strncmp(at, "TILT=", 5) && (at == head || at[-1] == '\n' || at[-1] == '\r')) return true;
  return false;
}

static bool is_eulumdat(const char *head, size_t size, const char *path) {
  (void)head;
  (void)size;
  size_t length = strlen(path);
  return length > 4 && !strcmp(path + length - 4, ".ldt");
}

static enum result read_slabs(const struct import_wish *wish, struct import_light *light,
                              struct error *error) {
  (void)light;
  return result_fail(error, RESULT_BAD, "%s: photometric files are not read yet", wish->files[0]);
}

const struct import_kind import_ies = {"ies", is_ies, read_slabs};
const struct import_kind import_eulumdat = {"eulumdat", is_eulumdat, read_slabs};
