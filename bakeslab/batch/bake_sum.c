#include "batch/bake_sum.h"

#include <math.h>
#include <stdlib.h>

/* Of one sample, over the pairs so far. */
struct cell {
  double rgb[3]; /* sum over rays */
  double y, yy;  /* sum of the pairs' mean luminances, and of their squares */
  int rays, pairs;
};

struct bake_sum {
  const struct bake_tiles *tiles; /* not owned */
  struct cell **pages;            /* one array a page, in the raster's order */
  int most_pairs;
  double *flux;    /* [tile][pair]: luminous flux of the tile by that pair */
  int *tile_pairs; /* pairs that each tile got */
};

enum result bake_sum_new(const struct bake_tiles *tiles, int most_passes, struct bake_sum **out,
                         struct error *error) {
  struct bake_sum *sum = calloc(1, sizeof *sum);
  *out = sum;
  if (!sum) return result_no_memory(error);
  sum->tiles = tiles;
  sum->most_pairs = (most_passes + 1) / 2;
  sum->pages = calloc((size_t)tiles->pages, sizeof *sum->pages);
  sum->flux = calloc((size_t)bake_tile_count(tiles) * (size_t)sum->most_pairs, sizeof *sum->flux);
  sum->tile_pairs = calloc((size_t)bake_tile_count(tiles), sizeof *sum->tile_pairs);
  bool good = sum->pages && sum->flux && sum->tile_pairs;
  for (int page = 0; good && page < tiles->pages; ++page) {
    sum->pages[page] = calloc(slab_sample_count(&tiles->slabs[page]), sizeof **sum->pages);
    good = sum->pages[page] != NULL;
  }
  if (good) return RESULT_OK;
  return result_fail(error, RESULT_MEMORY,
                     "not enough memory for the samples; choose fewer with --uv or --st");
}

void bake_sum_free(struct bake_sum *sum) {
  if (!sum) return;
  for (int page = 0; sum->pages && page < sum->tiles->pages; ++page) free(sum->pages[page]);
  free(sum->pages);
  free(sum->flux);
  free(sum->tile_pairs);
  free(sum);
}

/* cos(theta) d(omega) dA of a sample's cell, up to the kernel's change within it. */
static double cell_weight(const struct slab *slab, const int at[SLAB_AXES]) {
  double kappa = slab_kappa(slab), position[SLAB_AXES], weight = 1;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    position[axis] = slab_position(slab, axis, at[axis]);
    weight *= slab_spacing(slab, axis);
  }
  double x = position[SLAB_S] - kappa * position[SLAB_U];
  double y = position[SLAB_T] - kappa * position[SLAB_V];
  double r = 1 + x * x + y * y;
  return weight / (r * r);
}

static void add_ray(struct bake_sum *sum, int page, const int at[SLAB_AXES], int pair,
                    const float *rgb, const float *mirrored) {
  const struct slab *slab = &sum->tiles->slabs[page];
  const int *n = slab->samples;
  size_t row = (size_t)at[SLAB_V] * (size_t)n[SLAB_T] + (size_t)at[SLAB_T];
  size_t column = (size_t)at[SLAB_U] * (size_t)n[SLAB_S] + (size_t)at[SLAB_S];
  struct cell *cell = &sum->pages[page][row * (size_t)slab_width(slab) + column];
  double y = slab_luminance(rgb);
  for (int c = 0; c < 3; ++c) cell->rgb[c] += (double)rgb[c];
  if (mirrored) {
    y = 0.5 * (y + slab_luminance(mirrored));
    for (int c = 0; c < 3; ++c) cell->rgb[c] += (double)mirrored[c];
  }
  cell->y += y;
  cell->yy += y * y;
  cell->rays += mirrored ? 2 : 1;
  ++cell->pairs;
  int tile = bake_tile_at(sum->tiles, page, at);
  sum->flux[(size_t)tile * (size_t)sum->most_pairs + (size_t)pair] += y * cell_weight(slab, at);
  if (sum->tile_pairs[tile] <= pair) sum->tile_pairs[tile] = pair + 1;
}

/* The rays of one box in a pass and, unless NULL, in its antithesis. */
static void add_box(struct bake_sum *sum, const struct bake_box *box, int pass, const float *rgb,
                    const float *mirrored) {
  const int *first = box->first, *size = box->size;
  int at[SLAB_AXES];
  for (at[1] = first[1]; at[1] < first[1] + size[1]; ++at[1])
    for (at[3] = first[3]; at[3] < first[3] + size[3]; ++at[3])
      for (at[0] = first[0]; at[0] < first[0] + size[0]; ++at[0])
        for (at[2] = first[2]; at[2] < first[2] + size[2]; ++at[2]) {
          add_ray(sum, box->page, at, pass / 2, rgb, mirrored);
          rgb += 3;
          if (mirrored) mirrored += 3;
        }
}

void bake_sum_add(struct bake_sum *sum, const struct bake_round *round,
                  const struct bake_batch *batch, const float *rgb) {
  const struct bake_unit *unit = round->units + batch->first, *end = unit + batch->count;
  while (unit < end) {
    const struct bake_box *box = &round->boxes[unit->box];
    size_t floats = 3 * (size_t)bake_box_rays(box);
    bool pair = unit + 1 < end && unit[1].box == unit->box && unit[1].pass == unit->pass + 1;
    add_box(sum, box, unit->pass, rgb, pair ? rgb + floats : NULL);
    rgb += pair ? 2 * floats : floats;
    unit += pair ? 2 : 1;
  }
}

/* Variance of a pair's mean at one sample. */
static double variance(const struct cell *cell) {
  if (cell->pairs < 2) return 0;
  double mean = cell->y / cell->pairs;
  double v = (cell->yy - cell->y * mean) / (cell->pairs - 1);
  return v > 0 ? v : 0;
}

enum result bake_sum_deviation(const struct bake_sum *sum, double *deviation, struct error *error) {
  size_t tiles = (size_t)bake_tile_count(sum->tiles);
  int *count = calloc(tiles, sizeof *count);
  if (!count) return result_no_memory(error);
  for (size_t n = 0; n < tiles; ++n) deviation[n] = 0;
  for (int page = 0; page < sum->tiles->pages; ++page) {
    const struct slab *slab = &sum->tiles->slabs[page];
    for (size_t n = 0; n < slab_sample_count(slab); ++n) {
      int at[SLAB_AXES];
      slab_locate(slab, n, at);
      int tile = bake_tile_at(sum->tiles, page, at);
      deviation[tile] += variance(&sum->pages[page][n]);
      ++count[tile];
    }
  }
  for (size_t n = 0; n < tiles; ++n) deviation[n] = sqrt(deviation[n] / count[n]);
  free(count);
  return RESULT_OK;
}

/* Relative. All samples of a pair share its offset, so that errors of tiles are correlated:
 * residuals are summed over tiles before they are squared. NAN without memory. */
static double flux_error(const struct bake_sum *sum) {
  double total = 0, squares = 0;
  size_t most = (size_t)sum->most_pairs;
  double *residual = calloc(most, sizeof *residual);
  if (!residual) return NAN;
  for (int tile = 0; tile < bake_tile_count(sum->tiles); ++tile) {
    const double *flux = sum->flux + (size_t)tile * most;
    int n = sum->tile_pairs[tile];
    double mean = 0;
    for (int pair = 0; pair < n; ++pair) mean += flux[pair] / n;
    total += mean;
    for (int pair = 0; pair < n; ++pair)
      residual[pair] += (flux[pair] - mean) / sqrt(n * (n - 1.0));
  }
  for (size_t pair = 0; pair < most; ++pair) squares += residual[pair] * residual[pair];
  free(residual);
  return total != 0 ? sqrt(squares) / fabs(total) : 0;
}

void bake_sum_noise(const struct bake_sum *sum, double gain, struct bake_noise *noise) {
  double squares = 0, luminance = 0, rays = 0, samples = 0;
  *noise = (struct bake_noise){.known = true};
  for (int page = 0; page < sum->tiles->pages; ++page)
    for (size_t n = 0; n < slab_sample_count(&sum->tiles->slabs[page]); ++n) {
      const struct cell *cell = &sum->pages[page][n];
      squares += variance(cell) / cell->pairs;
      luminance += cell->y / cell->pairs;
      rays += cell->rays;
      samples += 1;
      noise->known &= cell->pairs > 1;
    }
  noise->mean = luminance / samples / gain;
  noise->rays = rays / samples;
  if (!noise->known) return;
  noise->sample = sqrt(squares / samples) / gain;
  noise->flux = flux_error(sum);
}

enum result bake_sum_finish(const struct bake_sum *sum, double gain, struct slab *pages,
                            struct error *error) {
  for (int page = 0; page < sum->tiles->pages; ++page) {
    enum result result = slab_alloc(&pages[page], error);
    if (result != RESULT_OK) return result;
    const struct cell *cell = sum->pages[page];
    float *rgb = pages[page].rgb;
    for (size_t n = 0; n < slab_sample_count(&pages[page]); ++n, ++cell)
      for (int c = 0; c < 3; ++c) *rgb++ = (float)(cell->rgb[c] / cell->rays / gain);
  }
  return RESULT_OK;
}
