/* bake_allocate.c - how many passes each tile gets; see bake_plan.h. */
#include <stdlib.h>
#include <string.h>

#include "batch/bake_plan.h"

/* Of a tile and its neighbours along every axis of the grid of tiles. */
static double neighbourhood(const struct bake_tiles *tiles, const double *deviation, int page,
                            const int at[SLAB_AXES], const int grid[SLAB_AXES]) {
  double most = deviation[bake_tile_number(tiles, page, at)];
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    for (int step = -1; step <= 1; step += 2) {
      int beside[SLAB_AXES];
      memcpy(beside, at, sizeof beside);
      beside[axis] += step;
      if (beside[axis] < 0 || beside[axis] >= grid[axis]) continue;
      double half = 0.5 * deviation[bake_tile_number(tiles, page, beside)];
      if (half > most) most = half;
    }
  return most;
}

struct tile_need {
  double deviation; /* of the neighbourhood */
  double rays;      /* of one pass */
};

static void find_needs(const struct bake_tiles *tiles, const double *deviation,
                       struct tile_need *needs) {
  for (int page = 0; page < tiles->pages; ++page) {
    int grid[SLAB_AXES], at[SLAB_AXES];
    bake_tile_grid(tiles, page, grid);
    for (at[SLAB_V] = 0; at[SLAB_V] < grid[SLAB_V]; ++at[SLAB_V])
      for (at[SLAB_U] = 0; at[SLAB_U] < grid[SLAB_U]; ++at[SLAB_U])
        for (at[SLAB_T] = 0; at[SLAB_T] < grid[SLAB_T]; ++at[SLAB_T])
          for (at[SLAB_S] = 0; at[SLAB_S] < grid[SLAB_S]; ++at[SLAB_S]) {
            struct bake_box box = bake_tile_box(tiles, page, at);
            needs[bake_tile_number(tiles, page, at)] = (struct tile_need){
                neighbourhood(tiles, deviation, page, at, grid), bake_box_rays(&box)};
          }
  }
}

/* The step of the ladder pilot, 2 pilot, 4 pilot ... most that is nearest, in ratio, to
 * scale * deviation. */
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
  if (!needs) return result_fail(error, RESULT_MEMORY, "out of memory");
  find_needs(tiles, deviation, needs);
  double all = 0, smallest = 0, largest = 0;
  for (int n = 0; n < count; ++n) {
    double d = needs[n].deviation;
    all += needs[n].rays;
    if (d > largest) largest = d;
    if (d > 0 && (smallest == 0 || d < smallest)) smallest = d;
  }
  /* The cost grows with the scale: bisect between "pilot everywhere" and "most
   * wherever there is any noise". */
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
