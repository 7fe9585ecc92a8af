#include "bake/bake_housing.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/files.h"
#include "lamp/housing.h"

enum result bake_housing(const struct bake_work *work, struct bake_report *report, char **housing,
                         struct error *error) {
  char *script = files_read(work->source->folder, strrchr(work->source->path, '/') + 1);
  char *scratch = NULL;
  if (!script)
    return result_fail(error, RESULT_IO, "%s: %s", work->source->script, strerror(errno));
  errno = 0;
  *housing = housing_find(script);
  enum result result = RESULT_OK;
  if (*housing)
    result = bake_store_scratch(work->store, NULL, &scratch, error);
  else if (errno == ENOMEM)
    result = result_no_memory(error);
  if (*housing && result == RESULT_OK)
    result = housing_parses(work->povray, work->source, *housing, scratch, work->stop, error);
  if (result == RESULT_BAD) {
    warnings_add(&report->warnings,
                 "Canned_Housing is left out of the slab, since it does not parse with only the "
                 "numbers declared before it; write it without includes and macros");
    free(*housing);
    *housing = NULL;
    result = RESULT_OK;
  }
  free(scratch);
  free(script);
  return result;
}
