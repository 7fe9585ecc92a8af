/* ray_bins.c - sums by cell, and by block: each axis is cut into 4 blocks of cells, in each of
 * which all rays are taken to carry flux alike. */
#include "import/rays/ray_bins.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "slab/slab_logluv.h"

enum {
  BLOCKS = 4, /* an axis */
  ALL_BLOCKS = BLOCKS * BLOCKS * BLOCKS * BLOCKS,
  MEAN_RAYS = 8 /* of the whole page, that a block's rays are mixed with */
};

static bool find_blocks(struct ray_bins *bins) {
  const int *samples = bins->page.samples;
  size_t all = 0;
  for (int axis = 0; axis < SLAB_AXES; ++axis) all += (size_t)samples[axis];
  unsigned char *block = bins->block[0] = malloc(all);
  for (int axis = 0; axis < SLAB_AXES && bins->block[0]; ++axis) {
    bins->block[axis] = block;
    for (int at = 0; at < samples[axis]; ++at)
      *block++ = (unsigned char)((long)at * BLOCKS / samples[axis]);
  }
  return bins->block[0] != NULL;
}

enum result ray_bins_new(const struct slab *page, bool coloured, struct ray_bins *bins,
                         struct error *error) {
  static const int order[] = {SLAB_S, SLAB_U, SLAB_T, SLAB_V};
  *bins =
      (struct ray_bins){.channels = coloured ? 3 : 1, .luminance = coloured ? 1 : 0, .threads = 1};
  enum result result = slab_check(page, error);
  if (result == RESULT_OK) result = slab_copy_geometry(page, &bins->page, error);
  if (result != RESULT_OK) return result;
  size_t cells = 1, channels = (size_t)bins->channels;
  for (int n = 0; n < SLAB_AXES; ++n) {
    int axis = order[n];
    bins->per[axis] = 1 / slab_spacing(page, axis);
    bins->low[axis] = slab_position(page, axis, 0) - slab_spacing(page, axis) / 2;
    bins->step[axis] = cells;
    cells *= (size_t)page->samples[axis];
  }
  bins->sums = calloc(cells, (channels + 1) * sizeof *bins->sums);
  bins->blocks = calloc(ALL_BLOCKS, 2 * channels * sizeof *bins->blocks);
  if (bins->sums && bins->blocks && find_blocks(bins)) return RESULT_OK;
  ray_bins_free(bins);
  return result_no_memory(error);
}

void ray_bins_free(struct ray_bins *bins) {
  slab_free(&bins->page);
  free(bins->sums);
  free(bins->blocks);
  free(bins->block[0]);
  *bins = (struct ray_bins){0};
}

/* ---- Adding a ray ---- */

/* One ray in four, by a scrambled number (SplitMix64): files may be ordered. */
static bool is_held_out(unsigned long long number) {
  uint64_t z = ((uint64_t)number + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return ((z ^ (z >> 31)) & 3) == 0;
}

/* By channel; false where there is no light. Rounding may leave X or Z just below 0. */
static bool find_flux(const struct ray_bins *bins, const double rgb[3], double flux[3]) {
  flux[0] = rgb[1];
  if (bins->channels == 3) {
    slab_logluv_from_rgb((const float[]){(float)rgb[0], (float)rgb[1], (float)rgb[2]}, flux);
    for (int c = 0; c < 3; c += 2) flux[c] = flux[c] > 0 ? flux[c] : 0;
    if (!(isfinite(flux[0]) && isfinite(flux[2]))) return false;
  }
  return flux[bins->luminance] > 0 && isfinite(flux[bins->luminance]);
}

/* The numbers of a ray's cell and block; false where it passes outside. */
static bool find_cell(const struct ray_bins *bins, const double abst[SLAB_AXES], size_t *cell,
                      size_t *block) {
  *cell = *block = 0;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    int count = bins->page.samples[axis];
    double x = (abst[axis] - bins->low[axis]) * bins->per[axis];
    if (!(x >= 0 && x <= count)) return false;
    int at = x < count ? (int)x : count - 1;
    *cell += (size_t)at * bins->step[axis];
    *block = *block * BLOCKS + bins->block[axis][at];
  }
  return true;
}

void ray_bins_expect(const struct ray_bins *bins, const double abst[SLAB_AXES]) {
  size_t cell, block;
  if (find_cell(bins, abst, &cell, &block))
    __builtin_prefetch(&bins->sums[cell * ((size_t)bins->channels + 1)], 1);
}

bool ray_bins_add(struct ray_bins *bins, const double abst[SLAB_AXES], const double rgb[3]) {
  size_t cell, block;
  double flux[3];
  if (!find_cell(bins, abst, &cell, &block)) return false;
  if (!find_flux(bins, rgb, flux)) return false;
  double *sum = bins->sums + cell * ((size_t)bins->channels + 1);
  double *block_sum = bins->blocks + block * 2 * (size_t)bins->channels;
  for (int c = 0; c < bins->channels; ++c) {
    sum[c] += flux[c];
    block_sum[2 * c] += flux[c];
    block_sum[2 * c + 1] += flux[c] * flux[c];
    bins->flux[c] += flux[c];
    bins->square[c] += flux[c] * flux[c];
  }
  if (is_held_out(bins->rays++)) {
    sum[bins->channels] += flux[bins->luminance];
    bins->held += flux[bins->luminance];
  }
  return true;
}

/* ---- A coarser grid ---- */

bool ray_bins_halves(const struct ray_bins *bins, const int halvings[SLAB_AXES]) {
  bool halves = true;
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    halves &= halvings[axis] == 0 || bins->page.samples[axis] % (BLOCKS << halvings[axis]) == 0;
  return halves;
}

enum result ray_bins_coarser(const struct ray_bins *bins, const int halvings[SLAB_AXES],
                             struct ray_bins *coarser, struct error *error) {
  struct slab page = bins->page;
  for (int axis = 0; axis < SLAB_AXES; ++axis) page.samples[axis] >>= halvings[axis];
  enum result result = ray_bins_new(&page, bins->channels == 3, coarser, error);
  if (result != RESULT_OK) return result;
  size_t numbers = (size_t)bins->channels + 1;
  for (size_t n = 0; n < slab_sample_count(&bins->page); ++n) {
    int at[SLAB_AXES];
    size_t cell = 0;
    slab_locate(&bins->page, n, at);
    for (int axis = 0; axis < SLAB_AXES; ++axis)
      cell += (size_t)(at[axis] >> halvings[axis]) * coarser->step[axis];
    for (size_t c = 0; c < numbers; ++c)
      coarser->sums[cell * numbers + c] += bins->sums[n * numbers + c];
  }
  memcpy(coarser->blocks, bins->blocks,
         ALL_BLOCKS * 2 * (size_t)bins->channels * sizeof *bins->blocks);
  memcpy(coarser->flux, bins->flux, sizeof bins->flux);
  memcpy(coarser->square, bins->square, sizeof bins->square);
  coarser->rays = bins->rays;
  coarser->held = bins->held;
  coarser->threads = bins->threads;
  return RESULT_OK;
}

/* ---- Counts ---- */

double ray_bins_quantum(const struct ray_bins *bins, size_t cell, int channel) {
  int at[SLAB_AXES];
  size_t block = 0;
  slab_locate(&bins->page, cell, at);
  for (int axis = 0; axis < SLAB_AXES; ++axis) block = block * BLOCKS + bins->block[axis][at[axis]];
  const double *sum = bins->blocks + (block * (size_t)bins->channels + (size_t)channel) * 2;
  double mean = bins->square[channel] / bins->flux[channel];
  return (sum[1] + MEAN_RAYS * mean * mean) / (sum[0] + MEAN_RAYS * mean);
}

void ray_bins_cells(const struct ray_bins *bins, const double *etendue, int channel, bool all,
                    float *count, float *exposure) {
  size_t numbers = (size_t)bins->channels + 1;
  double share = all ? 1 : 1 - bins->held / bins->flux[bins->luminance];
  for (size_t n = 0; n < slab_sample_count(&bins->page); ++n) {
    const double *sum = bins->sums + n * numbers;
    double quantum = ray_bins_quantum(bins, n, channel);
    double flux = sum[channel] - (all ? 0 : sum[bins->channels]);
    count[n] = (float)((flux > 0 ? flux : 0) / quantum);
    exposure[n] = (float)(share * etendue[n] / quantum);
  }
}
