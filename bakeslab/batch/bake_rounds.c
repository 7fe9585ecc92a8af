/* bake_rounds.c - the rounds of a bake.
 *
 * 1. Where all samples get the same number of rays: one round, and that is all.
 * 2. Else the pilot: PILOT passes of every tile, summed (bake_sum.h).
 * 3. The standard deviation of each tile, by the scatter of its pairs of passes.
 * 4. The passes of each tile, within the budget (bake_allocate.c); the same of all where the pilot
 *    met the light too seldom to tell.
 * 5. The second round renders what is still missing of them (bake_plan.h).
 *
 * A shard sums all of the pilot, since it plans by that, but of the last round it renders its own
 * part alone and sums nothing. */
#include "batch/bake_rounds.h"

#include <stdlib.h>

enum { PILOT = 4 }; /* with fewer passes, a pilot misses light */

struct bake_effort bake_effort_of(const struct bake_options *options) {
  return (struct bake_effort){.rays = options->rays,
                              .rays_max = options->rays_max,
                              .adaptive = !options->uniform && options->rays > PILOT,
                              .shard = options->shard,
                              .shards = options->shards};
}

int bake_rounds_first(const struct bake_effort *effort) {
  return effort->adaptive ? PILOT : effort->rays;
}

/* Steps 3 and 4. Of a source that few rays meet, a pilot shows the places where it was lucky: what
 * more rays would find elsewhere is missing for good. Then all tiles get the same. */
static enum result plan_rest(const struct bake_work *work, struct bake_rounds *rounds,
                             struct error *error) {
  const struct bake_effort *effort = &work->effort;
  size_t tiles = (size_t)bake_tile_count(&rounds->tiles);
  double *deviation = malloc(tiles * sizeof *deviation);
  int *wanted = malloc(tiles * sizeof *wanted);
  enum result result = deviation && wanted ? RESULT_OK : result_no_memory(error);
  if (result == RESULT_OK) result = bake_sum_deviation(rounds->sum, deviation, error);
  for (size_t n = 0; n < tiles && result == RESULT_OK; ++n) wanted[n] = effort->rays;
  if (result == RESULT_OK && bake_sum_met_light(rounds->sum))
    result = bake_plan_allocate(&rounds->tiles, deviation, PILOT, effort->rays, effort->rays_max,
                                wanted, error);
  if (result == RESULT_OK)
    result = bake_plan_rest(&rounds->tiles, wanted, PILOT, work->look.form, &rounds->rest, error);
  free(deviation);
  free(wanted);
  return result;
}

enum result bake_rounds_run(const struct bake_work *work, const char *label,
                            struct bake_rounds *rounds, struct bake_report *report,
                            struct error *error) {
  const struct bake_effort *effort = &work->effort;
  bool adaptive = effort->adaptive, shard = effort->shards > 1;
  int first = bake_rounds_first(effort), most = adaptive ? effort->rays_max : first;
  *rounds = (struct bake_rounds){0};
  enum result result = bake_tiles_init(&rounds->tiles, work->slabs, work->lamp->slab_count,
                                       work->look.form == BAKE_TRANSPOSED, error);
  if (result == RESULT_OK) result = bake_sum_new(&rounds->tiles, most, &rounds->sum, error);
  if (result == RESULT_OK)
    result = bake_plan_pilot(&rounds->tiles, first, work->look.form, &rounds->pilot, error);
  if (result == RESULT_OK)
    result = bake_run(work, &rounds->pilot, adaptive || !shard ? rounds->sum : NULL,
                      adaptive ? "pilot" : label, report, error);
  if (!adaptive) return result;
  if (result == RESULT_OK) result = plan_rest(work, rounds, error);
  if (result == RESULT_OK)
    result = bake_run(work, &rounds->rest, shard ? NULL : rounds->sum, label, report, error);
  return result;
}

void bake_rounds_free(struct bake_rounds *rounds) {
  bake_sum_free(rounds->sum);
  bake_round_free(&rounds->pilot);
  bake_round_free(&rounds->rest);
  bake_tiles_free(&rounds->tiles);
}
