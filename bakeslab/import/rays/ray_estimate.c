/* ray_estimate.c - samples on the page's grid, or on the coarsest that meets a tolerance.
 *
 * 1. From the fewest samples to the most: grids of the page's halved along u and v, along s and t,
 *    or both, then its own. Each is estimated by the same rays.
 * 2. What blur and noise of each do together to irradiance at some distances, slab_accuracy.h
 * tells.
 * 3. The first for which that is within the tolerance is taken, else that of the least. */
#include "import/rays/ray_estimate.h"

#include <math.h>
#include <stdlib.h>

#include "import/rays/ray_boxes.h"
#include "import/rays/ray_samples.h"
#include "slab/plane.h"
#include "slab/slab_accuracy.h"

/* Where irradiance counts, in apertures: as for `bake --tolerance`. */
enum { DISTANCES = 3 };
static const double apertures[DISTANCES] = {RAY_ESTIMATE_APERTURES, 2 * RAY_ESTIMATE_APERTURES,
                                            8 * RAY_ESTIMATE_APERTURES};

struct ray_estimate {
  struct ray_bins bins;
  struct ray_estimate_wish wish;
  double whole;
};

enum result ray_estimate_new(const struct slab *page, const struct ray_estimate_wish *wish,
                             struct ray_estimate **out, struct error *error) {
  struct ray_estimate *estimate = calloc(1, sizeof *estimate);
  *out = NULL;
  if (!estimate) return result_no_memory(error);
  estimate->wish = *wish;
  enum result result = ray_boxes_check(page->samples, error);
  if (result == RESULT_OK) result = ray_bins_new(page, wish->coloured, &estimate->bins, error);
  estimate->bins.threads = wish->threads;
  if (result == RESULT_OK)
    *out = estimate;
  else
    free(estimate);
  return result;
}

void ray_estimate_free(struct ray_estimate *estimate) {
  if (estimate) ray_bins_free(&estimate->bins);
  free(estimate);
}

void ray_estimate_expect(const struct ray_estimate *estimate, const double abst[SLAB_AXES]) {
  ray_bins_expect(&estimate->bins, abst);
}

bool ray_estimate_add(struct ray_estimate *estimate, const double abst[SLAB_AXES],
                      const double rgb[3]) {
  return ray_bins_add(&estimate->bins, abst, rgb);
}

void ray_estimate_whole(struct ray_estimate *estimate, double flux) {
  estimate->whole = flux;
}

/* A slab, and what is told of it. */
struct candidate {
  struct slab slab;
  struct ray_estimate_told told;
};

/* ---- Step 1 ---- */

static enum result halve(const struct ray_estimate *estimate, const int halvings[SLAB_AXES],
                         struct candidate *one, struct error *error) {
  struct ray_bins bins;
  enum result result = ray_bins_coarser(&estimate->bins, halvings, &bins, error);
  if (result != RESULT_OK) return result;
  result = ray_samples(&bins, estimate->whole, &one->slab, &one->told, error);
  ray_bins_free(&bins);
  return result;
}

/* ---- Step 2 ---- */

static enum result find_irradiance(struct candidate *one, struct error *error) {
  const struct slab_sampling sampling = {.sample_noise = one->told.sample_noise,
                                         .flux_noise = one->told.flux_noise};
  struct slab_accuracy accuracy[DISTANCES];
  double at[DISTANCES];
  for (int k = 0; k < DISTANCES; ++k) at[k] = apertures[k] * plane_width(&one->slab);
  enum result result =
      slab_accuracy_estimate(&one->slab, &sampling, DISTANCES, at, accuracy, error);
  if (result != RESULT_OK) slab_free(&one->slab);
  for (int k = 0; k < DISTANCES && result == RESULT_OK; ++k)
    one->told.irradiance = fmax(one->told.irradiance, accuracy[k].all);
  return result;
}

/* ---- Step 3 ---- */

static enum result choose(const struct ray_estimate *estimate, struct candidate *best,
                          struct error *error) {
  /* halvings of uv and st, from the fewest samples to the most */
  static const int order[][2] = {{2, 2}, {2, 1}, {1, 2}, {2, 0}, {1, 1},
                                 {0, 2}, {1, 0}, {0, 1}, {0, 0}};
  const struct ray_estimate_wish *wish = &estimate->wish;
  enum result result = RESULT_OK;
  bool any = false, met = false;
  for (size_t n = 0; n < sizeof order / sizeof *order && !met && result == RESULT_OK; ++n) {
    int uv = order[n][0], st = order[n][1];
    const int halvings[SLAB_AXES] = {uv, uv, st, st};
    struct candidate one = {0};
    if ((uv && wish->uv_given) || (st && wish->st_given) ||
        !ray_bins_halves(&estimate->bins, halvings))
      continue;
    result = halve(estimate, halvings, &one, error);
    if (result == RESULT_OK) result = find_irradiance(&one, error);
    if (result != RESULT_OK) break;
    met = one.told.irradiance <= wish->tolerance;
    bool better = !any || met || one.told.irradiance < best->told.irradiance;
    struct candidate *worse = better ? best : &one;
    slab_free(&worse->slab);
    if (better) *best = one;
    any = true;
  }
  if (result != RESULT_OK) slab_free(&best->slab);
  return result;
}

enum result ray_estimate_finish(struct ray_estimate *estimate, struct slab *slab,
                                struct ray_estimate_told *told, struct error *error) {
  struct candidate best = {0};
  enum result result = RESULT_OK;
  if (estimate->wish.tolerance > 0 && estimate->bins.rays > 0)
    result = choose(estimate, &best, error);
  else
    result = ray_samples(&estimate->bins, estimate->whole, &best.slab, &best.told, error);
  if (result != RESULT_OK) return result;
  *slab = best.slab;
  *told = best.told;
  return RESULT_OK;
}
