/* bake_need.c - see bake_need.h.
 *
 * 1. Make slabs of the sums so far, and estimate by how much their noise and their resolution
 *    change irradiance at the distance asked for (slab_accuracy.h), page by page.
 * 2. Those of the lamp are the pages', weighted by flux: noise in quadrature, blur added.
 * 3. The limit of noise is that asked for, or else the greater of a quarter of what the
 *    resolution does, which adds little to the error, and of one that nobody sees. Then the
 *    flux, which resolution leaves alone, has a limit of its own. */
#include "batch/bake_need.h"

#include <math.h>
#include <stdlib.h>

#include "slab/plane.h"
#include "slab/slab_accuracy.h"

/* The flux is known about twice as well as is told (bake_sum.h). */
static const double beside_blur = 0.25, unseen = 0.0025, unseen_flux = 0.004;

double bake_need_distance(const struct bake_options *options, const struct slab *page) {
  return options->for_distance > 0 ? options->for_distance : 4 * plane_width(page);
}

/* What changes irradiance, weighted by flux. */
struct changes {
  double flux, blur, squared_noise;
};

static enum result add_page(const struct bake_work *work, const struct slab *page,
                            const struct slab_sampling *sampling, struct changes *sum,
                            struct error *error) {
  double distance = bake_need_distance(work->options, page), flux[3];
  struct slab_accuracy accuracy;
  enum result result = slab_accuracy_estimate(page, sampling, 1, &distance, &accuracy, error);
  if (result == RESULT_OK) result = slab_flux(page, flux, error);
  if (result != RESULT_OK || isnan(accuracy.all) || isnan(accuracy.noise)) return result;
  double light = fabs(flux[0]) + fabs(flux[1]) + fabs(flux[2]);
  sum->flux += light;
  sum->blur += light * sqrt(fmax(0, pow(accuracy.all, 2) - pow(accuracy.noise, 2)));
  sum->squared_noise += pow(light * accuracy.noise, 2);
  return RESULT_OK;
}

/* Step 3: the part of the variance that may stay, of slabs that are lit. */
static double find_part(const struct changes *changes, double flux_noise, double asked) {
  double noise = sqrt(changes->squared_noise) / changes->flux;
  if (noise == 0) return 1;
  if (asked > 0) return pow(asked / noise, 2);
  double limit = fmax(beside_blur * changes->blur / changes->flux, unseen);
  return fmin(pow(limit / noise, 2), flux_noise > 0 ? pow(unseen_flux / flux_noise, 2) : 1);
}

enum result bake_need(const struct bake_work *work, const struct bake_sum *sum, double *part,
                      struct error *error) {
  int pages = work->lamp->slab_count;
  struct slab *slabs = calloc((size_t)pages, sizeof *slabs);
  struct changes changes = {0};
  struct bake_noise noise;
  enum result result = slabs ? RESULT_OK : result_no_memory(error);
  *part = 0;
  bake_sum_noise(sum, 1, work->look.offsets, &noise);
  const struct slab_sampling sampling = {.sample_noise = noise.sample, .flux_noise = noise.flux};
  if (isnan(work->options->noise) || !noise.known) goto out;
  for (int n = 0; n < pages && result == RESULT_OK; ++n)
    result = slab_copy_geometry(&work->slabs[n], &slabs[n], error);
  if (result == RESULT_OK) result = bake_sum_finish(sum, 1, slabs, error);
  for (int n = 0; n < pages && result == RESULT_OK; ++n)
    result = add_page(work, &slabs[n], &sampling, &changes, error);
  if (changes.flux > 0) *part = find_part(&changes, noise.flux, work->options->noise);
out:
  for (int n = 0; slabs && n < pages; ++n) slab_free(&slabs[n]);
  free(slabs);
  return result;
}
