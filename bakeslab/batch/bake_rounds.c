/* bake_rounds.c - see bake_rounds.h. */
#include "batch/bake_rounds.h"

#include <stdlib.h>

/* Passes everywhere before tiles are told apart: with fewer, a pilot misses light. */
enum { PILOT = 4 };

bool bake_is_adaptive(const struct bake_options *options) {
  return !options->uniform && options->rays > PILOT;
}

/* The second round. A shard needs the whole pilot's sums to plan by, but renders only its
 * own part of the round after that. */
static enum result run_rest(const struct bake_work *work, const char *label,
                            struct bake_rounds *rounds, struct bake_report *report,
                            struct error *error) {
  const struct bake_options *options = work->options;
  size_t tiles = (size_t)bake_tile_count(&rounds->tiles);
  double *deviation = malloc(tiles * sizeof *deviation);
  int *wanted = malloc(tiles * sizeof *wanted);
  enum result result =
      deviation && wanted ? RESULT_OK : result_fail(error, RESULT_MEMORY, "out of memory");
  if (result == RESULT_OK) result = bake_sum_deviation(rounds->sum, deviation, error);
  if (result == RESULT_OK)
    result = bake_plan_allocate(&rounds->tiles, deviation, PILOT, options->rays, options->rays_max,
                                wanted, error);
  if (result == RESULT_OK)
    result = bake_plan_rest(&rounds->tiles, wanted, PILOT, work->look.form, &rounds->rest, error);
  free(deviation);
  free(wanted);
  if (result == RESULT_OK)
    result = bake_run(work, &rounds->rest, options->shards > 1 ? NULL : rounds->sum, label, report,
                      error);
  return result;
}

enum result bake_rounds_run(const struct bake_work *work, const char *label,
                            struct bake_rounds *rounds, struct bake_report *report,
                            struct error *error) {
  const struct bake_options *options = work->options;
  bool adaptive = bake_is_adaptive(options), shard = options->shards > 1;
  int passes = adaptive ? PILOT : options->rays;
  *rounds = (struct bake_rounds){0};
  enum result result = bake_tiles_init(&rounds->tiles, work->slabs, work->lamp->slab_count,
                                       work->look.form == BAKE_TRANSPOSED, error);
  if (result == RESULT_OK)
    result =
        bake_sum_new(&rounds->tiles, adaptive ? options->rays_max : passes, &rounds->sum, error);
  if (result == RESULT_OK)
    result = bake_plan_pilot(&rounds->tiles, passes, work->look.form, &rounds->pilot, error);
  if (result == RESULT_OK)
    result = bake_run(work, &rounds->pilot, adaptive || !shard ? rounds->sum : NULL,
                      adaptive ? "pilot" : label, report, error);
  if (result == RESULT_OK && adaptive) result = run_rest(work, label, rounds, report, error);
  return result;
}

void bake_rounds_free(struct bake_rounds *rounds) {
  bake_sum_free(rounds->sum);
  bake_round_free(&rounds->pilot);
  bake_round_free(&rounds->rest);
  bake_tiles_free(&rounds->tiles);
}
