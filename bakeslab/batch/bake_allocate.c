/* bake_allocate.c - how many passes each tile gets; see bake_plan.h.
 *
 * Neyman's optimal allocation of samples to strata, which are tiles:
 *
 * 1. Take the deviation of each tile from the pilot, but at least half that of its noisiest
 *    neighbour, since the tile may hold what the pilot missed there.
 * 2. For a scale f, a tile of the deviation d gets f d passes, rounded to a step of the ladder
 *    pilot, 2 pilot, 4 pilot, ..., most.
 * 3. Bisect f between "the pilot everywhere" and "most wherever there is noise", for the largest
 *    cost that is within the budget.
 *
 * J. Neyman, "On the two different aspects of the representative method", Journal of the Royal
 * Statistical Society 97, 1934. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "batch/bake_plan.h"

struct tile_need {
  double deviation;
  double rays; /* of one pass */
};

/* Step 1 for the tile at a place in the grid of its page. */
static double raised_deviation(const struct bake_tiles *tiles, const double *deviation, int page,
                               const int at[SLAB_AXES], const int grid[SLAB_AXES]) {
  double raised = deviation[bake_tile_number(tiles, page, at)];
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    for (int step = -1; step <= 1; step += 2) {
      int beside[SLAB_AXES];
      memcpy(beside, at, sizeof beside);
      beside[axis] += step;
      if (beside[axis] < 0 || beside[axis] >= grid[axis]) continue;
      raised = fmax(raised, 0.5 * deviation[bake_tile_number(tiles, page, beside)]);
    }
  return raised;
}

static void find_needs(const struct bake_tiles *tiles, const double *deviation,
                       struct tile_need *needs) {
  for (int page = 0; page < tiles->pages; ++page) {
    int grid[SLAB_AXES], at[SLAB_AXES] = {0};
    bake_tile_grid(tiles, page, grid);
    do {
      struct bake_box box = bake_tile_box(tiles, page, at);
      needs[bake_tile_number(tiles, page, at)] = (struct tile_need){
          raised_deviation(tiles, deviation, page, at, grid), bake_box_rays(&box)};
    } while (bake_tile_next(grid, at));
  }
}

/* The step of the ladder that is nearest, in ratio, to scale * deviation. */
static int ladder(double deviation, double scale, int pilot, int most) {
  int passes = pilot;
  while (passes < most && deviation * scale > 1.4142135623730951 * passes) passes *= 2;
  return passes < most ? passes : most;
}

static double cost(const struct tile_need *needs, int count, double scale, int pilot, int most) {
  double rays = 0;
  for (int n = 0; n < count; ++n)
    rays += needs[n].rays * ladder(needs[n].deviation, scale, pilot, most);
  return rays;
}

enum result bake_plan_allocate(const struct bake_tiles *tiles, const double *deviation, int pilot,
                               int budget, int most, int *passes, struct error *error) {
  int count = bake_tile_count(tiles);
  struct tile_need *needs = calloc((size_t)count, sizeof *needs);
  if (!needs) return result_no_memory(error);
  find_needs(tiles, deviation, needs);
  double all = 0, smallest = 0, largest = 0;
  for (int n = 0; n < count; ++n) {
    double d = needs[n].deviation;
    all += needs[n].rays;
    largest = fmax(largest, d);
    if (d > 0 && (smallest == 0 || d < smallest)) smallest = d;
  }
  double low = largest > 0 ? pilot / largest : 0, high = smallest > 0 ? 2 * most / smallest : 0;
  if (cost(needs, count, high, pilot, most) <= budget * all) low = high;
  for (int step = 0; step < 100 && low < high; ++step) {
    double middle = 0.5 * (low + high);
    if (cost(needs, count, middle, pilot, most) <= budget * all)
      low = middle;
    else
      high = middle;
  }
  for (int n = 0; n < count; ++n) passes[n] = ladder(needs[n].deviation, low, pilot, most);
  free(needs);
  return RESULT_OK;
}
