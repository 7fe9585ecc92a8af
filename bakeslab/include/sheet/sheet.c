/* sheet.c - from a lamp's slabs to the levels of its sheet. */
#include "include/sheet/sheet.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "include/sheet/sheet_error.h"
#include "include/text/include_light.h"
#include "slab/plane.h"
#include "slab/slab_resample.h"

const double sheet_gate = 0.5, sheet_gap = 0.00104, sheet_least_height = 0.0011;

/* POV-Ray takes light colours up to here. */
static const double largest_colour = 1e37;

static double faintest_of(const struct slab *slab) {
  double faintest = INFINITY;
  size_t values = 3 * slab_sample_count(slab);
  for (size_t k = 0; k < values; ++k)
    if (slab->rgb[k] > 0) faintest = fmin(faintest, slab->rgb[k]);
  return faintest;
}

static int view_is_lit(const struct slab *slab, int i, int j) {
  for (int l = 0; l < slab->samples[SLAB_T]; ++l) {
    const float *row = slab_at(slab, i, j, 0, l);
    for (int k = 0; k < 3 * slab->samples[SLAB_S]; ++k)
      if (row[k] > 0) return 1;
  }
  return 0;
}

static enum result make_mask(struct sheet_level *level, struct error *error) {
  const struct slab *views = &level->views;
  int nu = views->samples[SLAB_U], nv = views->samples[SLAB_V];
  level->mask = malloc((size_t)nu * (size_t)nv);
  if (!level->mask) return result_fail(error, RESULT_MEMORY, "out of memory");
  level->lit = 0;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      int lit = view_is_lit(views, i, j);
      level->mask[j * nu + i] = lit ? '1' : '0';
      level->lit += lit;
    }
  return RESULT_OK;
}

/* Height at which tiles of Ns+2 by Nt+2 texels, one before each light, just
 * do not overlap: along the tighter axis they meet. */
static double sheet_height(const struct slab *views) {
  double height = INFINITY;
  for (int k = 0; k < 2; ++k) {
    double pitch = slab_spacing(views, k ? SLAB_V : SLAB_U);
    int texels = views->samples[k ? SLAB_T : SLAB_S] + 2 * SHEET_RING;
    double slope = slab_spacing(views, k ? SLAB_T : SLAB_S);
    height = fmin(height, pitch / (texels * slope + slab_kappa(views) * pitch));
  }
  return height;
}

/* The colour that the include gives to a light, at Scale 1 and Gain 1. */
static enum result check_colour(const struct sheet_level *level, int page, struct error *error) {
  const struct slab *views = &level->views;
  double du = slab_spacing(views, SLAB_U), dv = slab_spacing(views, SLAB_V);
  double fade = 1e-3 * plane_width(views);
  double colour = level->peak * (du / fade) * (dv / fade) / (2 * M_PI);
  if (colour <= largest_colour) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "page %d: peak radiance %g is more than POV-Ray's light colours hold (1e37); "
                     "use a larger radiance unit",
                     page + 1, level->peak);
}

static enum result make_level(const struct slab *slab, int page, const int lights[2],
                              struct sheet_level *level, struct error *error) {
  const int samples[SLAB_AXES] = {lights[0], lights[1], slab->samples[SLAB_S],
                                  slab->samples[SLAB_T]};
  enum result result = slab_resample(slab, samples, &level->views, error);
  if (result == RESULT_OK) result = make_mask(level, error);
  if (result != RESULT_OK) return result;
  level->peak = include_peak(&level->views);
  level->height = sheet_height(&level->views);
  return check_colour(level, page, error);
}

static int level_count(const int lights[2]) {
  int count = 1;
  for (int n = lights[0] > lights[1] ? lights[0] : lights[1]; n > 1; n = (n + 1) / 2) ++count;
  return count;
}

static enum result make_page(const struct slab *slab, int number, int most, struct sheet_page *page,
                             struct error *error) {
  int lights[2] = {slab->samples[SLAB_U], slab->samples[SLAB_V]};
  for (int k = 0; k < 2; ++k)
    if (most > 0 && lights[k] > most) lights[k] = most;
  page->level_count = level_count(lights);
  page->levels = calloc((size_t)page->level_count, sizeof *page->levels);
  if (!page->levels) {
    page->level_count = 0;
    return result_fail(error, RESULT_MEMORY, "out of memory");
  }
  for (int k = 0; k < page->level_count; ++k) {
    enum result result = make_level(slab, number, lights, &page->levels[k], error);
    if (result != RESULT_OK) return result;
    lights[0] = (lights[0] + 1) / 2;
    lights[1] = (lights[1] + 1) / 2;
  }
  enum result result = slab_flux_metric(slab, page->flux, error);
  if (result != RESULT_OK) return result;
  page->faintest = faintest_of(slab) / page->levels[0].peak;
  return sheet_measure(slab, page->levels, page->level_count, error);
}

enum result sheet_make(const struct slab *slabs, int count, int lights, struct sheet *sheet,
                       struct error *error) {
  memset(sheet, 0, sizeof *sheet);
  sheet->pages = calloc((size_t)count, sizeof *sheet->pages);
  if (!sheet->pages) return result_fail(error, RESULT_MEMORY, "out of memory");
  for (int k = 0; k < count; ++k) {
    enum result result = include_check_radiance(&slabs[k], k, error);
    if (result != RESULT_OK) return result;
    if (include_peak(&slabs[k]) <= 0) {
      ++sheet->black_pages;
      continue;
    }
    result = make_page(&slabs[k], k, lights, &sheet->pages[sheet->page_count++], error);
    if (result != RESULT_OK) return result;
  }
  if (!sheet->page_count) return include_no_light(error);
  return sheet_paint(sheet, error);
}

void sheet_free(struct sheet *sheet) {
  for (int p = 0; p < sheet->page_count; ++p) {
    struct sheet_page *page = &sheet->pages[p];
    for (int k = 0; k < page->level_count; ++k) {
      slab_free(&page->levels[k].views);
      free(page->levels[k].mask);
    }
    free(page->levels);
  }
  free(sheet->pages);
  picture_free(&sheet->picture);
  memset(sheet, 0, sizeof *sheet);
}
