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
 * Rounds before the last, the pilots, are summed by all processes at work, since they plan by them.
 * The last is by the one that holds the claim on the slab (bake_claim.h), or gets it since that one
 * died; the others wait for the slab. A shard renders its own part of the last round alone and sums
 * nothing of it; in waves, the same of a pilot that is not whole, and then it ends. */
#include "batch/bake_rounds.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "batch/bake_claim.h"
#include "batch/bake_grow.h"
#include "batch/bake_ledger.h"
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
                              .shards = options->shards,
                              .wave = options->wave};
}

bool bake_rounds_are_dear(const struct bake_work *work) {
  const int *setting = work->look.effects->setting;
  return setting[INTERREFLECTION] || setting[CAUSTICS];
}

/* Whether a bake begins with a search. */
static bool searches(const struct bake_work *work) {
  return work->effort.adaptive && !bake_rounds_are_dear(work);
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

/* ---- Who renders what of a round ---- */

/* Batches of a round that the store has not. */
static size_t count_missing(const struct bake_work *work, const struct bake_round *round) {
  size_t missing = 0;
  for (size_t n = 0; n < round->batch_count; ++n) {
    char *folder = bake_store_path(work->store, round->batches[n].key);
    missing += folder && access(folder, F_OK) != 0;
    free(folder);
  }
  return missing;
}

/* A pilot, in waves of shards that share no folder. Who goes on with what is next ends after its
 * part, even where that was all, since others wait for it. */
static enum result run_wave(const struct bake_work *work, struct bake_rounds *rounds,
                            const struct bake_round *round, struct bake_report *report,
                            struct error *error) {
  size_t missing = count_missing(work, round);
  enum result result = RESULT_OK;
  if (missing > 0 && work->effort.wave == BAKE_WAVE_REST)
    return result_fail(error, RESULT_IO,
                       "%s: %zu of the %zu batches of pilot %d are missing; bring the folders of "
                       "all shards together (bakeslab gather), and bake with --round pilot first",
                       work->store->directory, missing, round->batch_count, rounds->number);
  if (missing > 0) result = bake_run(work, round, true, NULL, report, error);
  rounds->waits = result != RESULT_OK || count_missing(work, round) > 0 ||
                  (missing > 0 && work->effort.wave == BAKE_WAVE_NEXT);
  if (rounds->waits) return result;
  return bake_run(work, round, false, rounds->sum, report, error);
}

/* Waits until the slab is written, or its claim is ours to take. */
static enum result await_slab(const struct bake_work *work, struct bake_rounds *rounds,
                              struct error *error) {
  const struct bake_store *store = work->store;
  enum result result = RESULT_OK;
  while (result == RESULT_OK && !bake_store_is_done(store)) {
    if (*work->stop) return bake_run_stopped(work, error);
    result = bake_worker_renew(store->worker, error);
    if (result == RESULT_OK)
      result = bake_claim_take(store->worker, work->plan, &rounds->claim, error);
    if (rounds->claim != BAKE_CLAIM_OTHERS) break;
    nanosleep(&(struct timespec){.tv_nsec = 200000000}, NULL);
  }
  rounds->whole = result == RESULT_OK && !bake_store_is_done(store);
  return result;
}

/* The last round: who has the claim on the slab sums it on the way. */
static enum result run_last(const struct bake_work *work, struct bake_rounds *rounds,
                            const struct bake_round *round, struct bake_report *report,
                            struct error *error) {
  enum result result = bake_claim_take(work->store->worker, work->plan, &rounds->claim, error);
  bool whole = rounds->claim != BAKE_CLAIM_OTHERS;
  if (result == RESULT_OK)
    result = bake_run(work, round, false, whole ? rounds->sum : NULL, report, error);
  rounds->whole = whole;
  if (result != RESULT_OK || whole) return result;
  result = await_slab(work, rounds, error);
  struct bake_report all = {0}; /* counts what was rendered here once more */
  if (result == RESULT_OK && rounds->whole)
    result = bake_run(work, round, false, rounds->sum, &all, error);
  report->rays += all.rays;
  report->cpu += all.cpu;
  memcpy(report->photons_lost, all.photons_lost, sizeof report->photons_lost);
  return result;
}

static enum result run_round(const struct bake_work *work, struct bake_rounds *rounds,
                             struct bake_round *round, const char *label, bool last,
                             struct bake_report *report, struct error *error) {
  round->label = label;
  ++rounds->number;
  enum result result = bake_run_keys(work, round, error);
  if (result == RESULT_OK && work->plan[0])
    result = bake_ledger_list(work->store, rounds->number, round, error);
  if (result != RESULT_OK) return result;
  if (!work->plan[0] || (!last && work->effort.wave == BAKE_WAVE_ALL))
    return bake_run(work, round, false, rounds->sum, report, error);
  if (!last) return run_wave(work, rounds, round, report, error);
  if (work->effort.wave == BAKE_WAVE_PILOT) return RESULT_OK;
  if (work->effort.shards > 1) return bake_run(work, round, true, NULL, report, error);
  return run_last(work, rounds, round, report, error);
}

/* ---- The rounds ---- */

/* Renders what tiles lack of plan->wanted. */
static enum result run_rest(const struct bake_work *work, struct bake_rounds *rounds,
                            struct plan *plan, const char *label, bool last,
                            struct bake_report *report, struct error *error) {
  struct bake_round round;
  enum result result =
      bake_plan_rest(&rounds->tiles, plan->done, plan->wanted, work->look.form, &round, error);
  if (result == RESULT_OK) result = run_round(work, rounds, &round, label, last, report, error);
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
  while (result == RESULT_OK && beams && !rounds->waits &&
         bake_grow(&rounds->tiles, rounds->sum, FIRST, plan.wanted) > 0)
    result = run_rest(work, rounds, &plan, "pilot", false, report, error);
  for (size_t n = 0; n < plan.tiles && result == RESULT_OK && !beams; ++n)
    plan.wanted[n] = work->effort.rays;
  if (result == RESULT_OK && beams && !rounds->waits)
    result = find_passes(work, rounds, &plan, error);
  if (result == RESULT_OK && !rounds->waits)
    result = run_rest(work, rounds, &plan, label, true, report, error);
  free_plan(&plan);
  return result;
}

enum result bake_rounds_run(const struct bake_work *work, const char *label,
                            struct bake_rounds *rounds, struct bake_report *report,
                            struct error *error) {
  const struct bake_effort *effort = &work->effort;
  bool adaptive = effort->adaptive;
  int from = searches(work) ? BAKE_SEARCH : 0, most = adaptive ? effort->rays_max : effort->rays;
  struct bake_round whole = {0};
  *rounds = (struct bake_rounds){.claim = BAKE_CLAIM_OTHERS, .grows = searches(work)};
  enum result result =
      bake_tiles_init(&rounds->tiles, work->slabs, work->lamp->slab_count,
                      work->look.form == BAKE_TRANSPOSED, searches(work) ? BEAM_TILE : TILE, error);
  rounds->tiles.dear = bake_rounds_are_dear(work);
  if (result == RESULT_OK) result = bake_sum_new(&rounds->tiles, most, &rounds->sum, error);
  if (result == RESULT_OK)
    result = bake_plan_whole(&rounds->tiles, from, from + bake_rounds_first(work), work->look.form,
                             &whole, error);
  if (result == RESULT_OK)
    result = run_round(work, rounds, &whole,
                       from == BAKE_SEARCH ? "search"
                       : adaptive          ? "pilot"
                                           : label,
                       !adaptive, report, error);
  bake_round_free(&whole);
  if (result == RESULT_OK && adaptive && !rounds->waits)
    result = run_adaptive(work, label, rounds, report, error);
  return result;
}

void bake_rounds_free(struct bake_rounds *rounds) {
  bake_sum_free(rounds->sum);
  bake_tiles_free(&rounds->tiles);
}
