/* ray_samples.c - one grid's samples and their error.
 *
 * 1. The densities of each channel are the mean of passes over partitions whose cuts differ
 *    (ray_partition.h). These differ most where the light is not even in boxes, and then their mean
 *    is better than each.
 * 2. All samples of a channel are multiplied by one factor, so that the flux of the interpolated
 *    slab is that of the rays.
 * 3. The error that is told is what the density of a pass may be about its mean. That leaves out
 *    that light may not be even in any boxes, but it is of one pass, and the mean of them is
 * better: on sources of known radiance the one makes up for the other (tests/RESULTS.md). What all
 *    samples share of it is the flux, of which only what leaves elsewhere is not known.
 * 4. Where rays that were held out surely show more (ray_held_out.h), that is told. */
#include "import/rays/ray_samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_json.h"
#include "import/rays/ray_etendue.h"
#include "import/rays/ray_held_out.h"
#include "import/rays/ray_partition.h"
#include "slab/slab_logluv.h"

/* What the passes say of the luminance, on average. */
struct noise {
  double square;   /* integral over the etendue of the mean's square */
  double variance; /* expected squared error, relative to that */
  double views;    /* mean over the samples of view_variance (ray_partition.h), not relative */
};

/* ---- Step 1 ---- */

static enum result estimate(const struct ray_bins *bins, const double *etendue, int channel,
                            double *density, struct noise *noise, struct error *error) {
  size_t count = slab_sample_count(&bins->page);
  float *counts = malloc(2 * count * sizeof *counts);
  if (!counts) return result_no_memory(error);
  struct ray_cells cells = {.count = counts, .exposure = counts + count, .threads = bins->threads};
  memcpy(cells.samples, bins->page.samples, sizeof cells.samples);
  ray_bins_cells(bins, etendue, channel, true, counts, counts + count);
  struct ray_posterior mean;
  enum result result = ray_partition(&cells, density, &mean, error);
  double square = 0;
  for (size_t n = 0; n < count; ++n) {
    square += (double)cells.exposure[n] * density[n] * density[n];
    noise->square += etendue[n] * density[n] * density[n];
  }
  noise->variance = fmax(mean.variance / square, 0);
  noise->views = fmax(mean.view_variance, 0) / (double)count;
  free(counts);
  return result;
}

/* ---- Step 2 ---- */

/* The slab's channels are X, Y, Z, or luminance three times. */
static enum result keep_flux(const struct ray_bins *bins, struct slab *slab, struct error *error) {
  double flux[3], factor[3] = {0, 0, 0};
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
                        struct noise *noise, struct error *error) {
  size_t count = slab_sample_count(slab);
  double *density = malloc(count * sizeof *density);
  enum result result = RESULT_OK;
  if (!density) return result_no_memory(error);
  for (int c = 0; c < bins->channels && result == RESULT_OK; ++c) {
    struct noise one = {0};
    for (size_t n = 0; n < count; ++n) density[n] = 0;
    if (!(bins->flux[c] > 0)) continue;
    result = estimate(bins, etendue, c, density, &one, error);
    if (c == bins->luminance) *noise = one;
    for (size_t n = 0; n < count; ++n)
      for (int k = 0; k < 3; ++k)
        if (bins->channels == 1 || k == c) slab->rgb[3 * n + (size_t)k] = (float)density[n];
  }
  free(density);
  return result == RESULT_OK ? keep_flux(bins, slab, error) : result;
}

/* ---- Steps 3 and 4 ---- */

static enum result tell(const struct ray_bins *bins, const double *etendue, double whole,
                        const struct noise *noise, struct ray_estimate_told *told,
                        struct error *error) {
  struct ray_held_out held_out;
  size_t numbers = (size_t)bins->channels + 1;
  int y = bins->luminance;
  enum result result = ray_held_out(bins, etendue, &held_out, error);
  if (result != RESULT_OK) return result;
  double by_chance = bins->square[y] / (bins->flux[y] * bins->flux[y]);
  double share = fmin(bins->flux[y] / whole, 1);
  double by_rays = fmax(noise->variance - share * by_chance, 0);
  told->square = noise->square;
  told->noise = sqrt(fmax(by_rays, held_out.least / noise->square));
  told->held_out = sqrt(held_out.likely / noise->square);
  told->flux_noise = sqrt((1 - share) * by_chance);
  told->sample_noise = noise->variance > 0 ? told->noise * sqrt(noise->views / noise->variance) : 0;
  double bin_variance = 0;
  for (size_t n = 0; n < slab_sample_count(&bins->page); ++n)
    bin_variance += ray_bins_quantum(bins, n, y) * bins->sums[n * numbers + (size_t)y] / etendue[n];
  told->bins = sqrt(bin_variance / noise->square);
  return RESULT_OK;
}

static void tell_flux(const struct ray_bins *bins, struct ray_estimate_told *told) {
  float rgb[3];
  slab_logluv_to_rgb(bins->flux, rgb);
  for (int c = 0; c < 3; ++c) told->flux[c] = bins->channels == 3 ? (double)rgb[c] : bins->flux[0];
}

enum result ray_samples(const struct ray_bins *bins, double whole, struct slab *slab,
                        struct ray_estimate_told *told, struct error *error) {
  struct noise noise = {0};
  double *etendue = NULL;
  enum result result = slab_copy_geometry(&bins->page, slab, error);
  if (result == RESULT_OK) result = slab_alloc(slab, error);
  if (result == RESULT_OK) result = slab_json_set(slab, "samples_are", "\"cell_means\"", error);
  *told = (struct ray_estimate_told){.rays = bins->rays, .held_out = NAN};
  memcpy(told->samples, bins->page.samples, sizeof told->samples);
  if (result == RESULT_OK && bins->rays > 0) {
    etendue = ray_etendue(slab);
    result = etendue ? fill(bins, etendue, slab, &noise, error) : result_no_memory(error);
    if (etendue && result == RESULT_OK) result = tell(bins, etendue, whole, &noise, told, error);
    tell_flux(bins, told);
  }
  free(etendue);
  if (result != RESULT_OK) slab_free(slab);
  return result;
}
