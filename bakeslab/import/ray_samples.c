/* ray_samples.c - one grid's samples and their error.
 *
 * 1. The densities of each channel are the mean over PASSES partitions with their cuts elsewhere
 *    (ray_partition.h). They differ most where the light is not even in boxes, and then their mean
 *    is better than each.
 * 2. All samples of a channel are multiplied by one factor, so that the flux of the interpolated
 *    slab is that of the rays.
 * 3. The error that is told is what the density of a pass may be about its mean. That leaves out
 *    that light may not be even in any boxes, but is of one pass, of which the mean is better: on
 *    sources of known radiance the one makes up for the other (tests/RESULTS.md). What all samples
 *    share of it is the flux, which is known but for the rays that leave elsewhere.
 * 4. What rays held out show of the error of one pass is lessened by how much the passes differ,
 *    which is exactly what their mean errs less by than they do (A. Krogh and J. Vedelsby, "Neural
 *    network ensembles, cross validation, and active learning", NIPS 7, 1995, equation 5). Where
 *    that is surely more than 3. says, it is told instead. */
#include "import/ray_samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_json.h"
#include "import/ray_etendue.h"
#include "import/ray_held_out.h"
#include "slab/slab_logluv.h"

enum { PASSES = 6 };

/* What the passes say of the luminance, on average; relative to `square`, that of their mean. */
struct spread {
  double square;   /* integral over the etendue of the mean's square */
  double variance; /* expected squared error */
  double passes;   /* squared difference of a pass from the mean */
  double even;     /* mean over the samples of their variance, not relative */
};

/* ---- Step 1 ---- */

/* Multiples of an odd number, so that the passes' cuts differ within boxes of every size. */
static void choose_shift(const int samples[SLAB_AXES], int pass, int shift[SLAB_AXES]) {
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    shift[axis] = pass * ((int)(0.36 * samples[axis]) | 1) % samples[axis];
}

static enum result estimate(const struct ray_bins *bins, const double *etendue, int channel,
                            double *density, struct spread *spread, struct error *error) {
  size_t count = slab_sample_count(&bins->page);
  float *counts = malloc(2 * count * sizeof *counts);
  if (!counts) return result_no_memory(error);
  struct ray_cells cells = {.count = counts, .exposure = counts + count};
  memcpy(cells.samples, bins->page.samples, sizeof cells.samples);
  ray_bins_cells(bins, etendue, channel, true, counts, counts + count);
  struct ray_posterior sum = {0};
  enum result result = RESULT_OK;
  for (int pass = 0; pass < PASSES && result == RESULT_OK; ++pass) {
    int shift[SLAB_AXES];
    struct ray_posterior one = {0};
    choose_shift(cells.samples, pass, shift);
    result = ray_partition_add(&cells, shift, density, &one, error);
    sum.square += one.square / PASSES;
    sum.variance += one.variance / PASSES;
    sum.even_variance += one.even_variance / PASSES;
  }
  double square = 0;
  for (size_t n = 0; n < count; ++n) {
    density[n] /= PASSES;
    square += (double)cells.exposure[n] * density[n] * density[n];
    spread->square += etendue[n] * density[n] * density[n];
  }
  spread->variance = fmax(sum.variance / square, 0);
  spread->passes = fmax(sum.square / square - 1, 0);
  spread->even = fmax(sum.even_variance, 0) / (double)count;
  free(counts);
  return result;
}

/* ---- Step 2 ---- */

/* The slab's channels are X, Y, Z, or luminance three times. */
static enum result keep_flux(const struct ray_bins *bins, struct slab *slab, struct error *error) {
  double flux[3], factor[3];
  enum result result = slab_flux_metric(slab, flux, error);
  for (int c = 0; c < 3 && result == RESULT_OK; ++c) {
    double wanted = bins->flux[bins->channels == 1 ? 0 : c];
    factor[c] = wanted > 0 ? wanted / flux[c] : 0;
    if (!isfinite(flux[c]) || !isfinite(factor[c]))
      result =
          result_fail(error, RESULT_BAD, "the radiance of its rays is more than a number holds");
  }
  for (size_t n = 0; n < slab_sample_count(slab) && result == RESULT_OK; ++n) {
    double xyz[3];
    float *rgb = slab->rgb + 3 * n;
    for (int c = 0; c < 3; ++c) xyz[c] = (double)rgb[c] * factor[c];
    if (bins->channels == 3)
      slab_logluv_to_rgb(xyz, rgb);
    else
      for (int c = 0; c < 3; ++c) rgb[c] = (float)xyz[c];
  }
  return result;
}

static enum result fill(const struct ray_bins *bins, const double *etendue, struct slab *slab,
                        struct spread *spread, struct error *error) {
  size_t count = slab_sample_count(slab);
  double *density = malloc(count * sizeof *density);
  enum result result = density ? RESULT_OK : result_no_memory(error);
  for (int c = 0; c < bins->channels && result == RESULT_OK; ++c) {
    struct spread one = {0};
    for (size_t n = 0; n < count; ++n) density[n] = 0;
    if (!(bins->flux[c] > 0)) continue;
    result = estimate(bins, etendue, c, density, &one, error);
    if (c == bins->luminance) *spread = one;
    for (size_t n = 0; n < count; ++n)
      for (int k = 0; k < 3; ++k)
        if (bins->channels == 1 || k == c) slab->rgb[3 * n + (size_t)k] = (float)density[n];
  }
  free(density);
  return result == RESULT_OK ? keep_flux(bins, slab, error) : result;
}

/* ---- Steps 3 and 4 ---- */

static enum result tell(const struct ray_bins *bins, const double *etendue, double elsewhere,
                        const struct spread *spread, struct ray_estimate_told *told,
                        struct error *error) {
  struct ray_held_out held_out;
  size_t numbers = (size_t)bins->channels + 1;
  int y = bins->luminance;
  enum result result = ray_held_out(bins, etendue, &held_out, error);
  if (result != RESULT_OK) return result;
  double whole = bins->square[y] / (bins->flux[y] * bins->flux[y]);
  double known = bins->flux[y] / (bins->flux[y] + elsewhere);
  double by_rays = fmax(spread->variance - whole * known, 0);
  double shown = held_out.least / spread->square - spread->passes;
  double noise = sqrt(fmax(by_rays, shown));
  told->square = spread->square;
  told->noise = told->error = noise;
  told->held_out = sqrt(held_out.likely / spread->square);
  told->flux_noise = sqrt(whole);
  told->sample_noise = spread->variance > 0 ? noise * sqrt(spread->even / spread->variance) : 0;
  double bin_variance = 0;
  for (size_t n = 0; n < slab_sample_count(&bins->page); ++n)
    bin_variance += ray_bins_quantum(bins, n, y) * bins->sums[n * numbers + (size_t)y] / etendue[n];
  told->bins = sqrt(bin_variance / spread->square);
  return RESULT_OK;
}

static void tell_flux(const struct ray_bins *bins, struct ray_estimate_told *told) {
  float rgb[3];
  slab_logluv_to_rgb(bins->flux, rgb);
  for (int c = 0; c < 3; ++c) told->flux[c] = bins->channels == 3 ? (double)rgb[c] : bins->flux[0];
}

enum result ray_samples(const struct ray_bins *bins, double elsewhere, struct slab *slab,
                        struct ray_estimate_told *told, struct error *error) {
  struct spread spread = {0};
  double *etendue = NULL;
  enum result result = slab_copy_geometry(&bins->page, slab, error);
  if (result == RESULT_OK) result = slab_alloc(slab, error);
  if (result == RESULT_OK) result = slab_json_set(slab, "samples_are", "\"cell_means\"", error);
  *told = (struct ray_estimate_told){.rays = bins->rays, .held_out = NAN, .blur = NAN};
  memcpy(told->samples, bins->page.samples, sizeof told->samples);
  if (result == RESULT_OK && bins->rays > 0) {
    etendue = ray_etendue(slab);
    if (!etendue) result = result_no_memory(error);
    if (result == RESULT_OK) result = fill(bins, etendue, slab, &spread, error);
    if (result == RESULT_OK) result = tell(bins, etendue, elsewhere, &spread, told, error);
    tell_flux(bins, told);
  }
  free(etendue);
  if (result != RESULT_OK) slab_free(slab);
  return result;
}
