/* simulate.c - how long bakes take that many workers share, past what there are machines for.
 *
 * simulate TIMES: a table by columns, for the plot; simulate TIMES LAMP: what was fitted to it.
 *
 * 1. Costs of batches come from TIMES (costs.h).
 * 2. Batches are those that the product plans: a pilot of all samples and a last round of those
 *    tiles in the middle of each view (bake_plan.h), or, of a lamp that is searched for beams, the
 *    search, two pilots around what it found, and the last round.
 * 3. Workers share them (farm.h): equal, of speeds between 0.5 and 1.5, and equal with a tenth of
 *    them dying, as processes and with their machines. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch/bake_plan.h"
#include "simulate/costs.h"
#include "simulate/farm.h"

enum { POSITIONS = 64, DIRECTIONS = 64, TILE = 16, BEAM_TILE = 8, MACHINE = 16 };

/* Of n tiles a side, the middle ones from `cut` on. */
static bool is_middle(int tile, int n, int cut) {
  return tile >= cut && tile < n - cut;
}

/* Adds a planned round, with its times. */
static bool add_round(const struct costs *costs, struct bake_round *planned, bool last,
                      struct farm_lamp *lamp) {
  struct farm_round *round = &lamp->rounds[lamp->round_count];
  round->batches = malloc((planned->batch_count + 1) * sizeof *round->batches);
  if (!round->batches) return false;
  ++lamp->round_count;
  for (round->count = 0; round->count < planned->batch_count; ++round->count) {
    const struct bake_batch *batch = &planned->batches[round->count];
    round->batches[round->count] = (struct farm_batch){
        costs_batch(costs, last, (double)batch->rays, (double)batch->count, round->count),
        (double)batch->rays};
  }
  bake_round_free(planned);
  return true;
}

/* Renders `to` passes of the middle tiles, of which some are done. */
static bool add_rest(const struct costs *costs, const struct bake_tiles *tiles, int cut, int to,
                     int *done, bool last, struct farm_lamp *lamp) {
  int grid[SLAB_AXES], at[SLAB_AXES] = {0};
  int *wanted = malloc((size_t)bake_tile_count(tiles) * sizeof *wanted);
  struct bake_round round;
  if (!wanted) return false;
  bake_tile_grid(tiles, 0, grid);
  do {
    int tile = bake_tile_number(tiles, 0, at);
    bool middle =
        is_middle(at[SLAB_S], grid[SLAB_S], cut) && is_middle(at[SLAB_T], grid[SLAB_T], cut);
    wanted[tile] = middle && to > done[tile] ? to : done[tile];
  } while (bake_tile_next(grid, at));
  bool good = bake_plan_rest(tiles, done, wanted, BAKE_MESH, &round, NULL) == RESULT_OK &&
              add_round(costs, &round, last, lamp);
  memcpy(done, wanted, (size_t)bake_tile_count(tiles) * sizeof *done);
  free(wanted);
  return good;
}

/* The rounds of a bake of so many rays a sample, which the last one brings it to. */
static bool plan_lamp(const struct costs *costs, int rays, struct farm_lamp *lamp) {
  const struct slab slab = {.st_distance = INFINITY,
                            .samples = {POSITIONS, POSITIONS, DIRECTIONS, DIRECTIONS}};
  bool search = !strcmp(costs->kind, "none");
  double samples = (double)slab_sample_count(&slab);
  struct bake_tiles tiles;
  struct bake_round round;
  *lamp = (struct farm_lamp){.join = costs->join,
                             .read = costs->read,
                             .plan = costs->plan * samples,
                             .finish = costs->finish};
  if (bake_tiles_init(&tiles, &slab, 1, false, search ? BEAM_TILE : TILE, NULL) != RESULT_OK)
    return false;
  tiles.dear = !search;
  int from = search ? BAKE_SEARCH : 0, first = search ? 1 : 4;
  int *done = malloc((size_t)bake_tile_count(&tiles) * sizeof *done);
  for (int n = 0; done && n < bake_tile_count(&tiles); ++n) done[n] = search ? 0 : 4;
  bool good = done &&
              bake_plan_whole(&tiles, from, from + first, BAKE_MESH, &round, NULL) == RESULT_OK &&
              add_round(costs, &round, false, lamp);
  /* Of 8 x 8 tiles 2 x 2 and then 4 x 4, and the last round of these; else of 4 x 4 tiles 2 x 2:
   * a quarter of the samples. */
  for (int cut = 3; search && good && cut >= 2; --cut)
    good = add_rest(costs, &tiles, cut, 4, done, false, lamp);
  int to = search ? 4 * (rays - 1) : 4 * (rays - 4) + 4;
  good = good && add_rest(costs, &tiles, search ? 2 : 1, to, done, true, lamp);
  free(done);
  bake_tiles_free(&tiles);
  return good;
}

/* ---- The tables ---- */

/* Lamps that are baked together. */
struct bakes {
  const char *name;
  int rays, copies; /* of each lamp */
  const char *lamps[4];
};

enum { MOST_LAMPS = 12 };

static bool plan_bakes(const char *times, const struct bakes *bakes, struct farm_lamp *lamps,
                       int *count) {
  *count = 0;
  for (int n = 0; n < 4 && bakes->lamps[n]; ++n) {
    struct costs costs;
    bool good = costs_read(times, bakes->lamps[n], &costs);
    for (int k = 0; good && k < bakes->copies; ++k)
      good = plan_lamp(&costs, bakes->rays, &lamps[(*count)++]);
    costs_free(&costs);
    if (!good) return false;
  }
  return true;
}

/* A line: workers; seconds, speedup and idle part of equal ones; those of uneven ones, to the mean
 * speed; how much longer it takes with a tenth dying, by themselves and with their machines. */
static bool print_line(const struct farm_lamp *lamps, int count, int workers, double *alone) {
  struct farm_workers farm = {.count = workers, .machine = MACHINE};
  struct farm_result equal, uneven, dying, lost;
  if (!farm_run(lamps, count, &farm, &equal)) return false;
  if (workers == 1) *alone = equal.wall;
  farm.unevenness = workers > 1 ? 0.5 : 0;
  if (!farm_run(lamps, count, &farm, &uneven)) return false;
  farm = (struct farm_workers){workers, MACHINE, 0, workers > 1 ? 0.1 : 0, equal.wall};
  if (!farm_run(lamps, count, &farm, &dying)) return false;
  farm.machine = 1;
  if (!farm_run(lamps, count, &farm, &lost)) return false;
  printf("%4d %9.1f %7.2f %6.3f %9.1f %7.2f %6.3f %6.3f %6.3f\n", workers, equal.wall,
         *alone / equal.wall, equal.idle, uneven.wall, *alone / uneven.wall, uneven.idle,
         dying.wall / equal.wall - 1, lost.wall / equal.wall - 1);
  return true;
}

static bool print_bakes(const char *times, const struct bakes *bakes) {
  struct farm_lamp lamps[MOST_LAMPS] = {0};
  int count;
  double alone = 0, largest = 0;
  size_t batches = 0;
  bool good = plan_bakes(times, bakes, lamps, &count);
  for (int n = 0; good && n < count; ++n)
    for (int r = 0; r < lamps[n].round_count; ++r)
      for (size_t k = 0; k < lamps[n].rounds[r].count; ++k, ++batches)
        largest = fmax(largest, lamps[n].rounds[r].batches[k].seconds);
  if (good)
    printf("# %s: %zu batches of at most %.0f s; rays %d\n"
           "# workers seconds speedup idle, uneven: seconds speedup idle, a tenth dies, with its "
           "machines\n",
           bakes->name, batches, largest, bakes->rays);
  for (int workers = 1; good && workers <= 1024; workers *= 2)
    good = print_line(lamps, count, workers, &alone);
  if (good) printf("\n\n"); /* gnuplot's end of a data set */
  for (int n = 0; n < count; ++n) farm_lamp_free(&lamps[n]);
  return good;
}

int main(int argc, char **argv) {
  static const struct bakes bakes[] = {
      {"parabolic", 64, 1, {"parabolic"}},
      {"torch", 64, 1, {"torch"}},
      {"headlight", 64, 1, {"headlight"}},
      {"shelf of twelve", 64, 4, {"parabolic", "torch", "headlight"}},
      {"parabolic, the default rays", 8, 1, {"parabolic"}},
      {"shelf of twelve, the default rays", 8, 4, {"parabolic", "torch", "headlight"}}};
  bool good = argc > 1;
  if (argc > 2) {
    struct costs costs;
    good = costs_read(argv[1], argv[2], &costs);
    if (good)
      printf("%s: %.3g s a process, %.3g us a ray, the last round x %.2f\n", argv[2], costs.process,
             1e6 * costs.ray, costs.last);
    costs_free(&costs);
    return !good;
  }
  for (size_t n = 0; good && n < sizeof bakes / sizeof *bakes; ++n)
    good = print_bakes(argv[1], &bakes[n]);
  return !good;
}
