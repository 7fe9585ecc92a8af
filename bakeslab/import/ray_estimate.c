/* ray_estimate.c - sums of the rays on the page's grid, and samples of them. */
#include "import/ray_estimate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_json.h"
#include "import/ray_etendue.h"

struct ray_estimate {
  struct slab page; /* its geometry and grid */
  double tolerance;
  int channels;                          /* 1, or 3 where coloured */
  double low[SLAB_AXES], per[SLAB_AXES]; /* a cell's index along an axis is (x - low) * per */
  double *sums;                          /* of each cell: flux of each channel */
  unsigned long long rays;
  double flux[3], squares; /* of all rays; squared luminance */
};

enum result ray_estimate_new(const struct slab *page, bool coloured, double tolerance,
                             struct ray_estimate **out, struct error *error) {
  struct ray_estimate *estimate = calloc(1, sizeof *estimate);
  *out = NULL;
  if (!estimate) return result_no_memory(error);
  enum result result = slab_check(page, error);
  if (result == RESULT_OK) result = slab_copy_geometry(page, &estimate->page, error);
  if (result == RESULT_OK) {
    estimate->tolerance = tolerance;
    estimate->channels = coloured ? 3 : 1;
    estimate->sums =
        calloc(slab_sample_count(page), (size_t)estimate->channels * sizeof *estimate->sums);
    if (!estimate->sums) result = result_no_memory(error);
  }
  for (int axis = 0; axis < SLAB_AXES && result == RESULT_OK; ++axis) {
    estimate->per[axis] = 1 / slab_spacing(page, axis);
    estimate->low[axis] = slab_position(page, axis, 0) - slab_spacing(page, axis) / 2;
  }
  if (result == RESULT_OK)
    *out = estimate;
  else
    ray_estimate_free(estimate);
  return result;
}

void ray_estimate_free(struct ray_estimate *estimate) {
  if (!estimate) return;
  slab_free(&estimate->page);
  free(estimate->sums);
  free(estimate);
}

bool ray_estimate_add(struct ray_estimate *estimate, const double abst[SLAB_AXES],
                      const double rgb[3]) {
  int at[SLAB_AXES];
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    int count = estimate->page.samples[axis];
    double x = (abst[axis] - estimate->low[axis]) * estimate->per[axis];
    if (!(x >= 0 && x <= count)) return false;
    at[axis] = x < count ? (int)x : count - 1;
  }
  double luminance =
      estimate->channels == 1 ? rgb[1] : 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  if (!(luminance > 0 && isfinite(luminance))) return false;
  const int *samples = estimate->page.samples;
  size_t cell = ((size_t)at[SLAB_V] * (size_t)samples[SLAB_T] + (size_t)at[SLAB_T]) *
                    ((size_t)samples[SLAB_U] * (size_t)samples[SLAB_S]) +
                (size_t)at[SLAB_U] * (size_t)samples[SLAB_S] + (size_t)at[SLAB_S];
  double *sum = estimate->sums + cell * (size_t)estimate->channels;
  if (estimate->channels == 1)
    sum[0] += luminance;
  else
    for (int c = 0; c < 3; ++c) sum[c] += rgb[c];
  for (int c = 0; c < 3; ++c) estimate->flux[c] += estimate->channels == 1 ? luminance : rgb[c];
  estimate->squares += luminance * luminance;
  ++estimate->rays;
  return true;
}

/* Scales each channel so that the slab's flux is that of the rays. */
static enum result keep_flux(const struct ray_estimate *estimate, struct slab *slab,
                             struct error *error) {
  double flux[3];
  enum result result = slab_flux_metric(slab, flux, error);
  for (size_t n = 0; n < 3 * slab_sample_count(slab) && result == RESULT_OK; ++n)
    if (flux[n % 3] != 0)
      slab->rgb[n] = (float)((double)slab->rgb[n] * estimate->flux[n % 3] / flux[n % 3]);
  return result;
}

enum result ray_estimate_finish(struct ray_estimate *estimate, struct slab *slab,
                                struct ray_estimate_told *told, struct error *error) {
  enum result result = slab_copy_geometry(&estimate->page, slab, error);
  if (result == RESULT_OK) result = slab_alloc(slab, error);
  if (result != RESULT_OK) return result;
  double *etendue = ray_etendue(slab);
  double total = 0;
  if (!etendue) result = result_no_memory(error);
  *told = (struct ray_estimate_told){.rays = estimate->rays, .held_out = NAN, .blur = NAN};
  for (size_t n = 0; n < slab_sample_count(slab) && etendue; ++n) {
    const double *sum = estimate->sums + n * (size_t)estimate->channels;
    for (int c = 0; c < 3; ++c)
      slab->rgb[3 * n + (size_t)c] = (float)(sum[estimate->channels == 1 ? 0 : c] / etendue[n]);
    double luminance = slab_luminance(slab->rgb + 3 * n);
    told->square += etendue[n] * luminance * luminance;
    total += etendue[n];
  }
  free(etendue);
  if (result == RESULT_OK) result = keep_flux(estimate, slab, error);
  if (result == RESULT_OK) result = slab_json_set(slab, "samples_are", "\"cell_means\"", error);
  if (result != RESULT_OK) {
    slab_free(slab);
    return result;
  }
  memcpy(told->flux, estimate->flux, sizeof told->flux);
  memcpy(told->samples, slab->samples, sizeof told->samples);
  if (estimate->rays == 0) return RESULT_OK;
  /* As many rays as cells have an error of 100 %, if all cells are alike. */
  double mean = 0.2126 * told->flux[0] + 0.7152 * told->flux[1] + 0.0722 * told->flux[2];
  told->flux_noise = sqrt(estimate->squares) / mean;
  told->bins = told->noise = told->error = told->flux_noise * sqrt((double)slab_sample_count(slab));
  told->sample_noise = told->error * sqrt(told->square / total);
  return RESULT_OK;
}
