#include "batch/bake_sum.h"

#include <math.h>
#include <stdlib.h>

/* Of one sample, over the pairs so far; a ray without its antithesis counts as a pair. */
struct cell {
  double rgb[3]; /* sum over rays */
  double y, yy;  /* sum of the pairs' mean luminances, and of their squares */
  double first;  /* luminance of the last ray of an even pass */
  float found;   /* luminance of the ray that looked for light; not in the sums */
  int rays, pairs;
};

/* A page's cells, and what they share along its axes: looked up for each ray. */
struct page {
  struct cell *cells;          /* in the raster's order; owned */
  double area;                 /* product of the axes' spacings */
  double *position[SLAB_AXES]; /* of each index; owned */
  int *tile[SLAB_AXES];        /* what each index adds to the tile's number; owned */
};

struct bake_sum {
  const struct bake_tiles *tiles; /* not owned */
  struct page *pages;             /* owned */
  int most_pairs;
  double *flux;     /* [tile][pair]: luminous flux of the tile by that pair */
  int *tile_pairs;  /* pairs that each tile got */
  double brightest; /* luminance of a ray */
  bool searched;    /* each sample had a ray that looked for light */
};

static bool fill_page(const struct bake_tiles *tiles, int number, struct page *page) {
  const struct slab *slab = &tiles->slabs[number];
  page->cells = calloc(slab_sample_count(slab), sizeof *page->cells);
  page->area = 1;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    size_t count = (size_t)slab->samples[axis];
    page->position[axis] = malloc(count * sizeof *page->position[axis]);
    page->tile[axis] = malloc(count * sizeof *page->tile[axis]);
    if (!page->position[axis] || !page->tile[axis]) return false;
    page->area *= slab_spacing(slab, axis);
    for (int at[SLAB_AXES] = {0}, n = 0; n < slab->samples[axis]; ++n) {
      at[axis] = n;
      page->position[axis][n] = slab_position(slab, axis, n);
      page->tile[axis][n] = bake_tile_at(tiles, number, at) - tiles->first_tile[number];
    }
  }
  return page->cells != NULL;
}

static void free_page(struct page *page) {
  free(page->cells);
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    free(page->position[axis]);
    free(page->tile[axis]);
  }
}

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
  for (int page = 0; good && page < tiles->pages; ++page)
    good = fill_page(tiles, page, &sum->pages[page]);
  if (good) return RESULT_OK;
  return result_fail(error, RESULT_MEMORY,
                     "not enough memory for the samples; choose fewer with --uv or --st");
}

void bake_sum_free(struct bake_sum *sum) {
  if (!sum) return;
  for (int page = 0; sum->pages && page < sum->tiles->pages; ++page) free_page(&sum->pages[page]);
  free(sum->pages);
  free(sum->flux);
  free(sum->tile_pairs);
  free(sum);
}

/* cos(theta) d(omega) dA of a sample's cell, up to the kernel's change within it. */
static double cell_weight(const struct bake_sum *sum, int number, const int at[SLAB_AXES]) {
  const struct page *page = &sum->pages[number];
  double kappa = slab_kappa(&sum->tiles->slabs[number]);
  double x = page->position[SLAB_S][at[SLAB_S]] - kappa * page->position[SLAB_U][at[SLAB_U]];
  double y = page->position[SLAB_T][at[SLAB_T]] - kappa * page->position[SLAB_V][at[SLAB_V]];
  double r = 1 + x * x + y * y;
  return page->area / (r * r);
}

/* The tile that holds a sample. */
static int tile_of(const struct bake_sum *sum, int number, const int at[SLAB_AXES]) {
  int tile = sum->tiles->first_tile[number];
  for (int axis = 0; axis < SLAB_AXES; ++axis) tile += sum->pages[number].tile[axis][at[axis]];
  return tile;
}

static void add_ray(struct bake_sum *sum, int page, const int at[SLAB_AXES], int pass,
                    const float *rgb) {
  const struct slab *slab = &sum->tiles->slabs[page];
  struct cell *cell = &sum->pages[page].cells[slab_pixel(slab, at)];
  double y = slab_luminance(rgb), before = 0; /* of the pair, without this ray */
  sum->brightest = fmax(sum->brightest, y);
  if (pass == BAKE_SEARCH) {
    cell->found = (float)y;
    sum->searched = true;
    return;
  }
  for (int c = 0; c < 3; ++c) cell->rgb[c] += (double)rgb[c];
  if (pass % 2) {
    before = cell->first;
    y = 0.5 * (before + y);
  } else {
    cell->first = y;
    ++cell->pairs;
  }
  cell->y += y - before;
  cell->yy += y * y - before * before;
  ++cell->rays;
  int tile = tile_of(sum, page, at), pair = pass / 2;
  sum->flux[(size_t)tile * (size_t)sum->most_pairs + (size_t)pair] +=
      (y - before) * cell_weight(sum, page, at);
  if (sum->tile_pairs[tile] <= pair) sum->tile_pairs[tile] = pair + 1;
}

/* The rays of one box in a pass. */
static void add_box(struct bake_sum *sum, const struct bake_box *box, int pass, const float *rgb) {
  const int *first = box->first, *size = box->size;
  int at[SLAB_AXES];
  for (at[1] = first[1]; at[1] < first[1] + size[1]; ++at[1])
    for (at[3] = first[3]; at[3] < first[3] + size[3]; ++at[3])
      for (at[0] = first[0]; at[0] < first[0] + size[0]; ++at[0])
        for (at[2] = first[2]; at[2] < first[2] + size[2]; ++at[2], rgb += 3)
          add_ray(sum, box->page, at, pass, rgb);
}

void bake_sum_add(struct bake_sum *sum, const struct bake_round *round,
                  const struct bake_batch *batch, const float *rgb) {
  const struct bake_unit *unit = round->units + batch->first, *end = unit + batch->count;
  for (; unit < end; ++unit) {
    const struct bake_box *box = &round->boxes[unit->box];
    add_box(sum, box, unit->pass, rgb);
    rgb += 3 * (size_t)bake_box_rays(box);
  }
}

static double mean_luminance(const struct cell *cell) {
  return cell->pairs ? cell->y / cell->pairs : 0;
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
      int tile = tile_of(sum, page, at);
      deviation[tile] += variance(&sum->pages[page].cells[n]) * pow(cell_weight(sum, page, at), 2);
      ++count[tile];
    }
  }
  for (size_t n = 0; n < tiles; ++n) deviation[n] = sqrt(deviation[n] / count[n]);
  free(count);
  return RESULT_OK;
}

bool bake_sum_is_lit(const struct bake_sum *sum, int page, size_t sample) {
  const struct cell *cell = &sum->pages[page].cells[sample];
  return cell->yy > 0 || cell->found != 0;
}

double bake_sum_light(const struct bake_sum *sum, int page, size_t sample) {
  const struct cell *cell = &sum->pages[page].cells[sample];
  int at[SLAB_AXES];
  slab_locate(&sum->tiles->slabs[page], sample, at);
  return fabs((double)cell->found + cell->y) * cell_weight(sum, page, at);
}

/* ---- The error of the flux ---- */

/* Fewer second differences than this say nothing. */
enum { ENOUGH_BENDS = 16 };

/* The cameras of a page, in a grid along the axes that none of them covers: the flux of each, and
 * what each pair of passes is off it. */
struct cameras {
  int size[2], most_pairs;
  double *flux, *residual; /* [camera], [camera][pair]; owned */
};

static bool find_cameras(const struct bake_sum *sum, int page, struct cameras *cameras) {
  int first = sum->tiles->transposed ? SLAB_S : SLAB_U, grid[SLAB_AXES], at[SLAB_AXES] = {0};
  size_t most = (size_t)sum->most_pairs;
  bake_tile_grid(sum->tiles, page, grid);
  size_t count = (size_t)grid[first] * (size_t)grid[first + 1];
  *cameras = (struct cameras){.size = {grid[first], grid[first + 1]},
                              .most_pairs = sum->most_pairs,
                              .flux = calloc(count, sizeof *cameras->flux),
                              .residual = calloc(count * most, sizeof *cameras->residual)};
  if (!cameras->flux || !cameras->residual) return false;
  do {
    size_t tile = (size_t)bake_tile_number(sum->tiles, page, at);
    size_t camera = (size_t)at[first + 1] * (size_t)grid[first] + (size_t)at[first];
    const double *flux = sum->flux + tile * most;
    double *residual = cameras->residual + camera * most, mean = 0;
    int n = sum->tile_pairs[tile];
    for (int pair = 0; pair < n; ++pair) mean += flux[pair] / n;
    cameras->flux[camera] += mean;
    for (int pair = 0; pair < n && n > 1; ++pair)
      residual[pair] += (flux[pair] - mean) / sqrt(n * (n - 1.0));
  } while (bake_tile_next(grid, at));
  return true;
}

static void free_cameras(struct cameras *cameras) {
  free(cameras->flux);
  free(cameras->residual);
}

static double squared_scatter(const struct cameras *cameras) {
  double squares = 0;
  for (int n = 0; n < cameras->size[0] * cameras->size[1] * cameras->most_pairs; ++n)
    squares += cameras->residual[n] * cameras->residual[n];
  return squares;
}

/* By second differences of cameras in a row, whose variance is six times that of one flux. What
 * bends by itself adds to it. INFINITY where there are few. */
static double squared_bends(const struct cameras *cameras) {
  int nx = cameras->size[0], ny = cameras->size[1], count = 0;
  double squares = 0;
  for (int n = 0; n < nx * ny; ++n) {
    const double *flux = cameras->flux + n;
    const bool inside[2] = {n % nx > 0 && n % nx<nx - 1, n / nx> 0 && n / nx < ny - 1};
    for (int k = 0; k < 2; ++k) {
      if (!inside[k]) continue;
      int step = k ? nx : 1;
      squares += pow(flux[-step] - 2 * flux[0] + flux[step], 2) / 6;
      ++count;
    }
  }
  return count < ENOUGH_BENDS ? INFINITY : squares / count * nx * ny;
}

/* What it would be worth if one ray more had been as bright as the brightest, where that counts
 * most. */
static double brightest_ray(const struct bake_sum *sum, int page) {
  const struct slab *slab = &sum->tiles->slabs[page];
  double most = 0;
  for (size_t n = 0; n < slab_sample_count(slab); ++n) {
    int at[SLAB_AXES];
    slab_locate(slab, n, at);
    const struct cell *cell = &sum->pages[page].cells[n];
    double more = sum->brightest - mean_luminance(cell);
    most = fmax(most, cell_weight(sum, page, at) * more / fmax(1, cell->rays));
  }
  return most;
}

/* Relative. Errors of cameras with offsets of their own are independent: the lesser counts of the
 * scatter of their pairs, as if those were random, and of the differences between neighbours.
 * Where all share the offsets of a pair, residuals are summed before they are squared. Each page
 * may have missed a ray of a small source: without that, one that met none would be without error.
 * NAN without memory, or where nothing tells it. */
static double flux_error(const struct bake_sum *sum, enum bake_offsets offsets, bool pairs) {
  double total = 0, squares = 0, *shared = calloc((size_t)sum->most_pairs, sizeof *shared);
  bool good = shared != NULL;
  for (int page = 0; page < sum->tiles->pages && good; ++page) {
    struct cameras cameras;
    good = find_cameras(sum, page, &cameras);
    for (int n = 0; good && n < cameras.size[0] * cameras.size[1]; ++n) {
      total += cameras.flux[n];
      for (int pair = 0; pair < sum->most_pairs; ++pair)
        shared[pair] += cameras.residual[(size_t)n * (size_t)sum->most_pairs + (size_t)pair];
    }
    if (good && offsets == BAKE_OWN)
      squares += fmin(pairs ? squared_scatter(&cameras) : INFINITY, squared_bends(&cameras));
    free_cameras(&cameras);
    squares += pow(brightest_ray(sum, page), 2);
  }
  for (int pair = 0; good && offsets != BAKE_OWN && pair < sum->most_pairs; ++pair)
    squares += pow(shared[pair], 2);
  free(shared);
  if (!good || isinf(squares) || (offsets != BAKE_OWN && !pairs)) return NAN;
  return total != 0 ? sqrt(squares) / fabs(total) : 0;
}

void bake_sum_noise(const struct bake_sum *sum, double gain, enum bake_offsets offsets,
                    struct bake_noise *noise) {
  double squares = 0, luminance = 0, rays = 0, samples = 0;
  bool pairs = false;
  *noise = (struct bake_noise){.known = true};
  for (int page = 0; page < sum->tiles->pages; ++page)
    for (size_t n = 0; n < slab_sample_count(&sum->tiles->slabs[page]); ++n) {
      const struct cell *cell = &sum->pages[page].cells[n];
      squares += variance(cell) / fmax(1, cell->pairs);
      luminance += mean_luminance(cell);
      rays += cell->rays + sum->searched;
      samples += 1;
      noise->known &= cell->pairs > 1 || cell->yy == 0;
      pairs |= cell->pairs > 1;
    }
  noise->known &= pairs;
  noise->mean = luminance / samples / gain;
  noise->rays = rays / samples;
  noise->flux = flux_error(sum, offsets, noise->known);
  if (noise->known) noise->sample = sqrt(squares / samples) / gain;
}

enum result bake_sum_finish(const struct bake_sum *sum, double gain, struct slab *pages,
                            struct error *error) {
  for (int page = 0; page < sum->tiles->pages; ++page) {
    enum result result = slab_alloc(&pages[page], error);
    if (result != RESULT_OK) return result;
    const struct cell *cell = sum->pages[page].cells;
    float *rgb = pages[page].rgb;
    for (size_t n = 0; n < slab_sample_count(&pages[page]); ++n, ++cell)
      for (int c = 0; c < 3; ++c) *rgb++ = (float)(cell->rgb[c] / fmax(1, cell->rays) / gain);
  }
  return RESULT_OK;
}
