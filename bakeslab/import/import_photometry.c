#include "import/import_photometry.h"

#include "import/eulumdat.h"
#include "import/ies.h"

static bool is_ies(const char *head, size_t size, const char *path) {
  (void)path;
  return ies_is(head, size);
}

static bool is_eulumdat(const char *head, size_t size, const char *path) {
  (void)path;
  return eulumdat_is(head, size);
}

static enum result read_slabs(const struct import_wish *wish, struct import_light *light,
                              struct error *error) {
  (void)light;
  return result_fail(error, RESULT_BAD, "%s: photometric files are not read yet", wish->files[0]);
}

const struct import_kind import_ies = {"ies", is_ies, read_slabs};
const struct import_kind import_eulumdat = {"eulumdat", is_eulumdat, read_slabs};
