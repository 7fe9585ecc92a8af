/* fuzz_photometric.c - photometric files of either kind, all the way to slabs, with few samples. */
#include <stdlib.h>

#include "import/eulumdat.h"
#include "import/ies.h"
#include "import/photometry_slab.h"

#include "fuzz_photometry.h"

static void make(const struct photometry *lamp, const struct photometry_pages *pages) {
  static const int uv[2] = {2, 1}, st[2] = {3, 2};
  static const double white[3] = {1, 1, 1};
  struct photometry_grid grid = {0};
  struct slab *slabs = NULL;
  struct error error = {{0}};
  enum result result = photometry_grid(lamp, pages, st, 0.02, &grid, &error);
  if (result == RESULT_OK) result = photometry_slabs(lamp, pages, &grid, uv, white, &slabs, &error);
  fuzz_check(result == RESULT_OK || *error.text);
  for (int n = 0; slabs && n < pages->count; ++n) {
    fuzz_check(slab_check(&slabs[n], &error) == RESULT_OK);
    for (size_t k = 0; k < 3 * slab_sample_count(&slabs[n]); ++k)
      fuzz_check(isfinite(slabs[n].rgb[k]));
    slab_free(&slabs[n]);
  }
  free(slabs);
  photometry_grid_free(&grid);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct photometry lamp = {0};
  struct photometry_pages pages;
  struct warnings notes = {0};
  struct error error = {{0}};
  const char *text = (const char *)data;
  enum result result = ies_is(text, size) ? ies_read(text, size, NULL, &lamp, &notes, &error)
                                          : eulumdat_read(text, size, &lamp, &notes, &error);
  if (result == RESULT_OK && photometry_pages(&lamp, 0.02, &pages, &error) == RESULT_OK) {
    fuzz_check(pages.count >= 1 && pages.count <= BODY_FACES);
    make(&lamp, &pages);
  }
  photometry_free(&lamp);
  return 0;
}
