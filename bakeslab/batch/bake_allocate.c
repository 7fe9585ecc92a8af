/* bake_allocate.c - how many passes each tile gets; see bake_plan.h.
 *
 * Neyman's optimal allocation of samples to strata, which are tiles:
 *
 * 1. Take the mean variance of each tile and its neighbours along all axes. Were it the tile's own,
 *    tiles whose first rays missed light by chance would get no more, and the sum of all too little
 *    light (Kirk and Arvo 1991). Rays of other views are independent; but a source that is smaller
 *    than a view's cell shows in no other, and elsewhere in its own.
 * 2. For a scale f, a tile of the deviation d gets f d passes, rounded to a step of the ladder n,
 *    2 n, 4 n, ..., most, where n are those that it has.
 * 3. Bisect f between nothing more and "most wherever there is noise", for the largest that is
 *    within the budget and no more than the limit of variance asks for.
 *
 * J. Neyman, "On the two different aspects of the representative method", Journal of the Royal
 * Statistical Society 97, 1934. D. Kirk and J. Arvo, "Unbiased sampling techniques for image
 * synthesis", Computer Graphics 25 (Proc. SIGGRAPH), 1991. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "batch/bake_plan.h"

struct tile_need {
  double deviation;
  double rays; /* of one pass */
  int done;
};

struct needs {
  struct tile_need *tiles;
  int count;
  double rays; /* of a pass of all tiles */
};

/* Step 1 for the tile at a place in the grid of its page. */
static double smooth_deviation(const struct bake_tiles *tiles, const double *deviation, int page,
                               const int at[SLAB_AXES], const int grid[SLAB_AXES]) {
  int count = 1;
  double sum = pow(deviation[bake_tile_number(tiles, page, at)], 2);
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    for (int side = -1; side <= 1; side += 2) {
      int beside[SLAB_AXES];
      memcpy(beside, at, sizeof beside);
      beside[axis] += side;
      if (beside[axis] < 0 || beside[axis] >= grid[axis]) continue;
      sum += pow(deviation[bake_tile_number(tiles, page, beside)], 2);
      ++count;
    }
  return sqrt(sum / count);
}

static void find_needs(const struct bake_tiles *tiles, const double *deviation, const int *passes,
                       struct needs *needs) {
  for (int page = 0; page < tiles->pages; ++page) {
    int grid[SLAB_AXES], at[SLAB_AXES] = {0};
    bake_tile_grid(tiles, page, grid);
    do {
      struct bake_box box = bake_tile_box(tiles, page, at);
      int n = bake_tile_number(tiles, page, at);
      needs->tiles[n] = (struct tile_need){smooth_deviation(tiles, deviation, page, at, grid),
                                           bake_box_rays(&box), passes[n]};
      needs->rays += bake_box_rays(&box);
    } while (bake_tile_next(grid, at));
  }
}

/* Step 2: the step of the ladder that is nearest, in ratio, to scale * deviation. */
static int ladder(const struct tile_need *need, double scale, int most) {
  int passes = need->done;
  while (passes > 0 && passes < most && need->deviation * scale > 1.4142135623730951 * passes)
    passes *= 2;
  return passes < most ? passes : most;
}

/* Whether a scale asks for more than the limits allow, or is more than enough. */
static bool is_too_much(const struct needs *needs, double scale, const struct bake_limits *limits) {
  double rays = 0, before = 0, after = 0;
  for (int n = 0; n < needs->count; ++n) {
    const struct tile_need *need = &needs->tiles[n];
    int passes = ladder(need, scale, limits->rays_max);
    if (passes == 0) continue;
    double variance = need->rays * need->deviation * need->deviation; /* of one pass */
    rays += need->rays * passes;
    before += variance / need->done;
    after += variance / passes;
  }
  return rays > limits->rays * needs->rays || after < limits->variance * before;
}

/* Step 3. The bounds are those of the scale at which the noisiest tile gets more, and all get
 * most. */
static double find_scale(const struct needs *needs, const struct bake_limits *limits) {
  double low = INFINITY, high = 0;
  for (int n = 0; n < needs->count; ++n) {
    const struct tile_need *need = &needs->tiles[n];
    if (!(need->deviation > 0)) continue;
    low = fmin(low, need->done / need->deviation);
    high = fmax(high, 2 * limits->rays_max / need->deviation);
  }
  if (high == 0) return 0;
  if (!is_too_much(needs, high, limits)) return high;
  for (int step = 0; step < 100 && low < high; ++step) {
    double middle = 0.5 * (low + high);
    if (is_too_much(needs, middle, limits))
      high = middle;
    else
      low = middle;
  }
  return low;
}

enum result bake_plan_allocate(const struct bake_tiles *tiles, const double *deviation,
                               const struct bake_limits *limits, int *passes, struct error *error) {
  struct needs needs = {.count = bake_tile_count(tiles)};
  needs.tiles = calloc((size_t)needs.count, sizeof *needs.tiles);
  if (!needs.tiles) return result_no_memory(error);
  find_needs(tiles, deviation, passes, &needs);
  double scale = find_scale(&needs, limits);
  for (int n = 0; n < needs.count; ++n)
    passes[n] = ladder(&needs.tiles[n], scale, limits->rays_max);
  free(needs.tiles);
  return RESULT_OK;
}
