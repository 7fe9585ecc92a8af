/* bake_rounds.c - the rounds of a bake.
 *
 * 1. Where all samples get the same number of rays: one round, and that is all.
 * 2. Else a pass that looks for light, and meets every beam that is a sample wide (bake_rays.h).
 *    With photons or interreflection, which cost as much in each POV-Ray process as many rays do,
 *    FIRST passes of every tile instead, and step 3 is left out.
 * 3. Where it found some, and beside it, tiles get FIRST passes; so on until nothing new shows
 *    (bake_grow.h). What stays dark gets no more.
 * 4. The standard deviation of each tile, by the scatter of its pairs of passes.
 * 5. The passes of each tile: as few as leave no more noise than matters (bake_need.h), within the
 *    budget (bake_allocate.c). The same of all, where the search found no beams.
 * 6. The last round renders what is still missing of them (bake_plan.h).
 *
 * A shard sums all rounds but the last, since it plans by them; of that it renders its own part
 * alone and sums nothing. */
#include "batch/bake_rounds.h"

#include <stdlib.h>
#include <string.h>

#include "batch/bake_grow.h"
#include "batch/bake_need.h"

/* With fewer passes, the scatter of their pairs says nothing. */
enum { FIRST = 4 };
/* Sides of tiles: what a search finds is narrow, but a camera costs as much as 256 rays. */
enum { BEAM_TILE = 8, TILE = 16 };

struct bake_effort bake_effort_of(const struct bake_options *options) {
  return (struct bake_effort){.rays = options->rays,
                              .rays_max = options->rays_max,
                              .adaptive = !options->uniform && options->rays > FIRST,
                              .shard = options->shard,
                              .shards = options->shards};
}

/* Whether each POV-Ray process costs as much as many rays do. */
static bool is_dear(const struct bake_work *work) {
  const int *setting = work->look.effects->setting;
  return setting[INTERREFLECTION] || setting[CAUSTICS];
}

/* Whether a bake begins with a search. */
static bool searches(const struct bake_work *work) {
  return work->effort.adaptive && !is_dear(work);
}

int bake_rounds_first(const struct bake_work *work) {
  return searches(work) ? 1 : work->effort.adaptive ? FIRST : work->effort.rays;
}

/* What rounds are planned by. */
struct plan {
  int *done, *wanted; /* passes, by tile; owned */
  double *deviation;  /* owned */
  size_t tiles;
};

static enum result make_plan(const struct bake_tiles *tiles, int done, struct plan *plan,
                             struct error *error) {
  size_t count = plan->tiles = (size_t)bake_tile_count(tiles);
  plan->done = malloc(count * sizeof *plan->done);
  plan->wanted = malloc(count * sizeof *plan->wanted);
  plan->deviation = malloc(count * sizeof *plan->deviation);
  if (!plan->done || !plan->wanted || !plan->deviation) return result_no_memory(error);
  for (size_t n = 0; n < count; ++n) plan->done[n] = plan->wanted[n] = done;
  return RESULT_OK;
}

static void free_plan(struct plan *plan) {
  free(plan->done);
  free(plan->wanted);
  free(plan->deviation);
}

/* Renders what tiles lack of plan->wanted. */
static enum result run_rest(const struct bake_work *work, struct bake_rounds *rounds,
                            struct plan *plan, struct bake_sum *sum, const char *label,
                            struct bake_report *report, struct error *error) {
  struct bake_round round;
  enum result result =
      bake_plan_rest(&rounds->tiles, plan->done, plan->wanted, work->look.form, &round, error);
  if (result == RESULT_OK) result = bake_run(work, &round, sum, label, report, error);
  memcpy(plan->done, plan->wanted, plan->tiles * sizeof *plan->done);
  bake_round_free(&round);
  return result;
}

/* Step 5. */
static enum result find_passes(const struct bake_work *work, const struct bake_rounds *rounds,
                               struct plan *plan, struct error *error) {
  const struct bake_effort *effort = &work->effort;
  struct bake_limits limits = {.rays = effort->rays - searches(work), .rays_max = effort->rays_max};
  enum result result = bake_sum_deviation(rounds->sum, plan->deviation, error);
  if (result == RESULT_OK) result = bake_need(work, rounds->sum, &limits.variance, error);
  if (result == RESULT_OK)
    result = bake_plan_allocate(&rounds->tiles, plan->deviation, &limits, plan->wanted, error);
  return result;
}

/* Steps 3 to 6. */
static enum result run_adaptive(const struct bake_work *work, const char *label,
                                struct bake_rounds *rounds, struct bake_report *report,
                                struct error *error) {
  struct plan plan = {0};
  enum result result = make_plan(&rounds->tiles, searches(work) ? 0 : FIRST, &plan, error);
  bool beams = bake_grow_has_beams(&rounds->tiles, rounds->sum);
  while (result == RESULT_OK && beams &&
         bake_grow(&rounds->tiles, rounds->sum, FIRST, plan.wanted) > 0)
    result = run_rest(work, rounds, &plan, rounds->sum, "pilot", report, error);
  for (size_t n = 0; n < plan.tiles && result == RESULT_OK && !beams; ++n)
    plan.wanted[n] = work->effort.rays;
  if (result == RESULT_OK && beams) result = find_passes(work, rounds, &plan, error);
  if (result == RESULT_OK)
    result = run_rest(work, rounds, &plan, work->effort.shards > 1 ? NULL : rounds->sum, label,
                      report, error);
  free_plan(&plan);
  return result;
}

enum result bake_rounds_run(const struct bake_work *work, const char *label,
                            struct bake_rounds *rounds, struct bake_report *report,
                            struct error *error) {
  const struct bake_effort *effort = &work->effort;
  bool adaptive = effort->adaptive, shard = effort->shards > 1;
  int from = searches(work) ? BAKE_SEARCH : 0, most = adaptive ? effort->rays_max : effort->rays;
  struct bake_round whole = {0};
  *rounds = (struct bake_rounds){0};
  enum result result =
      bake_tiles_init(&rounds->tiles, work->slabs, work->lamp->slab_count,
                      work->look.form == BAKE_TRANSPOSED, searches(work) ? BEAM_TILE : TILE, error);
  rounds->tiles.dear = is_dear(work);
  if (result == RESULT_OK) result = bake_sum_new(&rounds->tiles, most, &rounds->sum, error);
  if (result == RESULT_OK)
    result = bake_plan_whole(&rounds->tiles, from, from + bake_rounds_first(work), work->look.form,
                             &whole, error);
  if (result == RESULT_OK)
    result = bake_run(work, &whole, adaptive || !shard ? rounds->sum : NULL,
                      from == BAKE_SEARCH ? "search"
                      : adaptive          ? "pilot"
                                          : label,
                      report, error);
  bake_round_free(&whole);
  if (result == RESULT_OK && adaptive) result = run_adaptive(work, label, rounds, report, error);
  return result;
}

void bake_rounds_free(struct bake_rounds *rounds) {
  bake_sum_free(rounds->sum);
  bake_tiles_free(&rounds->tiles);
}
