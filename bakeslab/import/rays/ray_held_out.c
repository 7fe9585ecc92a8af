/* ray_held_out.c - an unbiased estimate of the squared error, on several grids.
 *
 * 1. Estimate the luminance of all cells by the rays that were not held out.
 * 2. Those held out give, in each cell, the true flux F with the variance V of their number, and
 * the estimate gives f. (f - F)^2 - V is then an unbiased estimate of its squared error; over the
 *    etendue it is one of that of radiance. Their sum has the variance 2 V^2 + 4 V (f - F)^2.
 * 3. The same on coarser grids: the means over larger cells err less, but noise hides less of it.
 *    The grid on which most shows in spite of three standard deviations counts. */
#include "import/rays/ray_held_out.h"

#include <math.h>
#include <stdlib.h>

#include "import/rays/ray_partition.h"

enum { DEVIATIONS = 3 };

struct cell {
  double estimate, held; /* flux */
  double variance;       /* of `held`, by its own rays */
  double expected;       /* the same by the estimate */
  double etendue;
};

struct grid {
  int samples[SLAB_AXES];
  struct cell *cells;
};

/* ---- Step 1 ---- */

static enum result estimate(const struct ray_bins *bins, const double *etendue, double *density,
                            struct error *error) {
  size_t count = slab_sample_count(&bins->page);
  float *counts = malloc(2 * count * sizeof *counts);
  struct ray_posterior posterior;
  if (!counts) return result_no_memory(error);
  struct ray_cells cells = {.count = counts, .exposure = counts + count, .threads = bins->threads};
  for (int axis = 0; axis < SLAB_AXES; ++axis) cells.samples[axis] = bins->page.samples[axis];
  ray_bins_cells(bins, etendue, bins->luminance, false, counts, counts + count);
  enum result result = ray_partition(&cells, density, &posterior, error);
  free(counts);
  return result;
}

/* ---- Step 2 ---- */

static void fill(const struct ray_bins *bins, const double *etendue, const double *density,
                 struct grid *grid) {
  double share = bins->held / bins->flux[bins->luminance];
  size_t numbers = (size_t)bins->channels + 1;
  for (int axis = 0; axis < SLAB_AXES; ++axis) grid->samples[axis] = bins->page.samples[axis];
  for (size_t n = 0; n < slab_sample_count(&bins->page); ++n) {
    double per_flux = ray_bins_quantum(bins, n, bins->luminance) / share;
    double flux = density[n] * etendue[n];
    double held = bins->sums[n * numbers + numbers - 1] / share;
    grid->cells[n] = (struct cell){flux, held, per_flux * held, per_flux * flux, etendue[n]};
  }
}

static size_t cell_count(const struct grid *grid) {
  size_t count = 1;
  for (int axis = 0; axis < SLAB_AXES; ++axis) count *= (size_t)grid->samples[axis];
  return count;
}

static void judge(const struct grid *grid, struct ray_held_out *held_out) {
  double square = 0, variance = 0;
  for (size_t n = 0; n < cell_count(grid); ++n) {
    const struct cell *cell = &grid->cells[n];
    double difference = cell->estimate - cell->held, area = cell->etendue;
    double known = difference * difference - cell->variance, noise = cell->expected;
    square += known / area;
    variance += noise * (2 * noise + 4 * fmax(known, 0)) / (area * area);
  }
  double least = square - DEVIATIONS * sqrt(variance);
  if (!(least > held_out->least)) return;
  held_out->least = least;
  held_out->likely = square;
}

/* ---- Step 3 ---- */

static void add(struct cell *to, const struct cell *from) {
  to->estimate += from->estimate;
  to->held += from->held;
  to->variance += from->variance;
  to->expected += from->expected;
  to->etendue += from->etendue;
}

static size_t cell_number(const int samples[SLAB_AXES], const int at[SLAB_AXES]) {
  size_t row = (size_t)at[SLAB_V] * (size_t)samples[SLAB_T] + (size_t)at[SLAB_T];
  return (row * (size_t)samples[SLAB_U] + (size_t)at[SLAB_U]) * (size_t)samples[SLAB_S] +
         (size_t)at[SLAB_S];
}

/* Adds up pairs of cells along some axes, in place: a pair's first comes before its second, and no
 * sum comes after what is summed. */
static void coarsen(struct grid *grid, const bool halved[SLAB_AXES]) {
  struct slab fine = {.rgb = NULL}, coarse = {.rgb = NULL};
  size_t count = cell_count(grid);
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    fine.samples[axis] = grid->samples[axis];
    coarse.samples[axis] = grid->samples[axis] =
        (fine.samples[axis] + halved[axis]) >> halved[axis];
  }
  for (size_t n = 0; n < count; ++n) {
    int at[SLAB_AXES] = {0};
    bool first = true;
    slab_locate(&fine, n, at);
    for (int axis = 0; axis < SLAB_AXES; ++axis) {
      first &= !(halved[axis] && at[axis] % 2 == 1);
      at[axis] >>= halved[axis];
    }
    struct cell *cell = &grid->cells[cell_number(coarse.samples, at)], one = grid->cells[n];
    if (first)
      *cell = one;
    else
      add(cell, &one);
  }
}

/* Halves until a single cell is left; `whole` axes (or none) are at their end first. */
static void judge_grids(struct grid *grid, int whole, struct ray_held_out *held_out) {
  while (cell_count(grid) > 1) {
    bool halved[SLAB_AXES], ending = false;
    for (int axis = 0; axis < SLAB_AXES; ++axis)
      ending |= whole >= 0 && axis / 2 == whole / 2 && grid->samples[axis] > 1;
    for (int axis = 0; axis < SLAB_AXES; ++axis)
      halved[axis] = grid->samples[axis] > 1 && (!ending || axis / 2 == whole / 2);
    coarsen(grid, halved);
    judge(grid, held_out);
  }
}

enum result ray_held_out(const struct ray_bins *bins, const double *etendue,
                         struct ray_held_out *held_out, struct error *error) {
  static const int wholes[] = {-1, SLAB_U, SLAB_S}; /* by pairs of axes */
  size_t count = slab_sample_count(&bins->page);
  double *density = calloc(count, sizeof *density);
  *held_out = (struct ray_held_out){.likely = NAN};
  if (!density) return result_no_memory(error);
  bool enough = bins->held > 0 && bins->held < bins->flux[bins->luminance];
  enum result result = enough ? estimate(bins, etendue, density, error) : RESULT_OK;
  struct grid grid = {.cells = NULL};
  if (enough && result == RESULT_OK) {
    grid.cells = malloc(count * sizeof *grid.cells);
    if (!grid.cells) result = result_no_memory(error);
  }
  for (int n = 0; grid.cells && n < (int)(sizeof wholes / sizeof *wholes); ++n) {
    fill(bins, etendue, density, &grid);
    if (n == 0) judge(&grid, held_out);
    judge_grids(&grid, wholes[n], held_out);
  }
  free(grid.cells);
  free(density);
  return result;
}
