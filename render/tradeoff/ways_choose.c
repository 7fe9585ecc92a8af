/* ways_choose.c - the cheapest way to each error, tried before it is advised.
 *
 * For each rung, in POV-Ray and in renderslab:
 * 1. Leave out the ways whose predicted error is more than `doubt` times the rung: predictions
 *    are somewhat off, both ways. Where another way from the same slab has been tried, what that
 *    erred by over its prediction is taken into the prediction, and the doubt is less.
 * 2. Try the others from the cheapest on, until one reaches the rung.
 * 3. Where the first `most_tries` do not, advise the one that came closest. */
#include <math.h>

#include "tradeoff/ways.h"

static const double doubt = 1.2, less_doubt = 1.02;
enum { most_tries = 6 };

double ways_first(const struct ways *ways, int bake, int picture) {
  const struct ways_made *made = &ways->made[bake][picture];
  return ways->bakes[bake].cpu + made->include_cpu + made->cpu;
}

double ways_cost(const struct ways_settings *settings, const struct ways *ways, int bake,
                 int picture) {
  return ways_first(ways, bake, picture) + (settings->pictures - 1) * ways->made[bake][picture].cpu;
}

/* What is left to try for a rung: the cheapest with at least so much cost, and after those of the
 * same cost that come before. */
struct search {
  double error;
  bool povray;
  bool seen[WAYS_MOST_BAKES][WAYS_PICTURES];
};

/* The least error that a way may have. */
static double likely(const struct ways *ways, int bake, int picture) {
  const struct ways_made *made = &ways->made[bake][picture], *tried = NULL;
  if (made->tried) return made->measured;
  for (int p = 0; p < WAYS_PICTURES; ++p) {
    const struct ways_made *other = &ways->made[bake][p];
    if (other->tried && (!tried || other->error < tried->error)) tried = other;
  }
  return tried ? made->predicted * tried->measured / tried->predicted / less_doubt
               : made->predicted / doubt;
}

static bool next(const struct ways_settings *settings, struct ways *ways, struct search *search,
                 struct ways_advice *advice, int *bake, int *picture) {
  double least = INFINITY;
  for (int b = 0; b < ways->bake_count; ++b)
    for (int p = 0; p < WAYS_PICTURES; ++p) {
      const struct ways_made *made = &ways->made[b][p];
      double cost = ways_cost(settings, ways, b, p), first = ways_first(ways, b, p);
      if (search->seen[b][p] || made->refused || ways_in_povray(p) != search->povray ||
          likely(ways, b, p) > search->error)
        continue;
      if (settings->time_limit > 0 && first > settings->time_limit) {
        if (advice->cheapest == 0 || first < advice->cheapest) advice->cheapest = first;
        continue;
      }
      if (cost >= least) continue;
      least = cost;
      *bake = b;
      *picture = p;
    }
  return isfinite(least);
}

static enum result choose_one(const struct ways_settings *settings, struct ways *ways,
                              struct search *search, struct ways_advice *advice,
                              struct error *error) {
  double closest = INFINITY;
  int bake = 0, picture = 0;
  enum result result = RESULT_OK;
  while (advice->tried < most_tries && next(settings, ways, search, advice, &bake, &picture)) {
    result = ways_try(settings, ways, bake, picture, error);
    if (result != RESULT_OK) return result;
    const struct ways_made *made = &ways->made[bake][picture];
    search->seen[bake][picture] = true;
    ++advice->tried;
    if (made->refused || made->measured >= closest) continue;
    closest = made->measured;
    advice->found = true;
    advice->bake = bake;
    advice->picture = picture;
    advice->missed = made->measured > search->error;
    if (!advice->missed) break;
  }
  return RESULT_OK;
}

/* More than this share of the error left by four times the rays is no noise. */
static const double noise_share = 0.75;

/* Seconds of the whole lamp's picture at that error: between the two pictures around it, or, finer
 * than all, reckoned: noise falls with the root of the rays, for each of which POV-Ray takes as
 * long as between the last two pictures. */
static void whole_lamp(const struct ways *ways, double error, struct ways_advice *advice) {
  int count = ways->lamp_count, k = 0;
  while (k < count && ways->lamp[k].error > error) ++k;
  const struct ways_lamp *after = &ways->lamp[k < count ? k : count - 1], *before = after - 1;
  if (count > 0 && k == 0) advice->whole = after->cpu;
  if (count < 2 || k == 0) return;
  if (k < count) {
    double part = log(before->error / error) / log(before->error / after->error);
    advice->whole = before->cpu * pow(after->cpu / before->cpu, part);
  } else if (after->error <= noise_share * before->error) {
    double ray = (after->cpu - before->cpu) / (after->rays - before->rays);
    double fewer = after->error / error;
    advice->whole = after->cpu + ray * after->rays * (fewer * fewer - 1);
    advice->reckoned = true;
  }
}

/* bake + include + n pictures < n pictures of the whole lamp. */
static void break_even(const struct ways *ways, double error, struct ways_advice *advice) {
  if (!advice->found) return;
  const struct ways_made *made = &ways->made[advice->bake][advice->picture];
  double once = ways->bakes[advice->bake].cpu + made->include_cpu;
  whole_lamp(ways, error, advice);
  if (advice->whole > made->cpu) {
    double pictures = floor(once / (advice->whole - made->cpu)) + 1;
    advice->pays_from = pictures < 1e6 ? (int)pictures : 0;
  }
}

/* Tries what costs less than the advice: was it right to leave that out? */
static enum result try_cheaper(const struct ways_settings *settings, struct ways *ways,
                               const struct search *search, struct ways_advice *advice,
                               struct error *error) {
  double cost = ways_cost(settings, ways, advice->bake, advice->picture);
  advice->best = cost;
  for (int b = 0; b < ways->bake_count; ++b)
    for (int p = 0; p < WAYS_PICTURES; ++p) {
      struct ways_made *made = &ways->made[b][p];
      if (made->refused || ways_in_povray(p) != search->povray ||
          ways_cost(settings, ways, b, p) >= cost)
        continue;
      enum result result = ways_try(settings, ways, b, p, error);
      if (result != RESULT_OK) return result;
      ++advice->cheaper;
      if (!made->refused && made->measured <= search->error)
        advice->best = fmin(advice->best, ways_cost(settings, ways, b, p));
    }
  return RESULT_OK;
}

enum result ways_choose(const struct ways_settings *settings, struct ways *ways,
                        struct error *error) {
  double floor_error = ways->bakes[ways->bake_count - 1].error;
  for (int rung = 0; rung < settings->error_count; ++rung)
    for (int renderer = 0; renderer < 2; ++renderer) {
      struct search search = {.error = settings->errors[rung], .povray = renderer == 0};
      struct ways_advice *advice = &ways->advice[rung][renderer];
      if (search.error < floor_error) continue;
      enum result result = choose_one(settings, ways, &search, advice, error);
      if (result == RESULT_OK && settings->all && advice->found && !advice->missed)
        result = try_cheaper(settings, ways, &search, advice, error);
      if (result != RESULT_OK) return result;
      break_even(ways, search.error, advice);
    }
  return RESULT_OK;
}
