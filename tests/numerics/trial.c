/* trial.c - see numerics.h: methods and the oracle side by side. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "numerics.h"

static const double rounding = 1e-15, exact_methods = 1e-9, least_share = 1e-4;

double trial_distance(struct trial *trial) {
  double finite = random_log(&trial->seed, 0.3, 10);
  return random_choose(&trial->seed, 2) ? INFINITY : finite;
}

void trial_note(struct trial *trial, enum gather_method method, double error, double allowed) {
  struct tally *tally = &trial->tally[method];
  double share = isnan(error) || isnan(allowed) ? INFINITY : error > 0 ? error / allowed : 0;
  ++tally->values;
  tally->stated += allowed > 0 && allowed < INFINITY;
  if (share > tally->share || (tally->share == 0 && error > tally->error))
    tally->seed = trial->start;
  if (share > tally->share) tally->share = share;
  if (error > tally->error) tally->error = error;
  if (trial->verbose && share > 1)
    printf("  %s: error %.3g, allowed %.3g\n", gather_methods[method].name, error, allowed);
}

double method_rounding(enum gather_method method) {
  switch (method) {
  case GATHER_REFERENCE:
  case GATHER_CLOSED:
  case GATHER_PAPER:
  case GATHER_PAPER_LEVELS:
    return 1e-12;
  default:
    return 1e-6; /* sums in single precision */
  }
}

/* ---- Lamps. */

static void find_most(const struct slab *slab, struct lamp *lamp) {
  double most = 0, area = 1, square[2] = {0};
  const int *n = slab->samples;
  for (int k = 0; k < n[SLAB_S]; ++k)
    for (int l = 0; l < n[SLAB_T]; ++l)
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int i = 0; i < n[SLAB_U]; ++i)
          for (int j = 0; j < n[SLAB_V]; ++j) sum += (double)slab_at(slab, i, j, k, l)[c];
        most = fmax(most, sum / n[SLAB_U] / n[SLAB_V]);
      }
  for (int c = 0; c < 3; ++c) {
    square[0] += slab->u[c] * slab->u[c];
    square[1] += slab->v[c] * slab->v[c];
  }
  for (int axis = 0; axis < 2; ++axis) area *= sqrt(square[axis]);
  lamp->most = most * area;
  lamp->hemisphere = most * acos(-1);
}

struct lamp lamp_open(const struct slab *slab) {
  struct error error = {{0}};
  const size_t floats = 3 * slab_sample_count(slab);
  struct lamp lamp = {.slab = *slab, .positive = true};
  find_most(slab, &lamp);
  for (size_t k = 0; k < floats; ++k) lamp.positive = lamp.positive && slab->rgb[k] >= 0;
  lamp.light = load_light(slab, 1);
  if (gather_prepare(&lamp.light, 1, GATHER_LEVELS, 0, 1, &lamp.levels, &error) != RESULT_OK ||
      gather_prepare(&lamp.light, 1, GATHER_CUT, 0, 1, &lamp.trees, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  return lamp;
}

void lamp_close(struct lamp *lamp) {
  gl_gather_free(lamp->gl);
  gather_prepared_free(&lamp->levels);
  gather_prepared_free(&lamp->trees);
  light_free(&lamp->light);
  slab_free(&lamp->slab);
}

struct gather_counts lamp_sum_many(const struct lamp *lamp, const struct gather_settings *wanted,
                                   const struct receiver *receivers, int count,
                                   struct gathered *gathered) {
  struct gather_settings settings = *wanted;
  settings.lights = &lamp->light;
  settings.light_count = 1;
  settings.level = -1;
  const enum method_makes makes = gather_methods[settings.method].makes;
  if (makes == METHOD_LEVELS) settings.prepared = &lamp->levels;
  if (makes == METHOD_TREES) settings.prepared = &lamp->trees;
  return sum_light(&settings, receivers, count, gathered);
}

void lamp_sum(const struct lamp *lamp, enum gather_method method, double tolerance,
              const struct surfel *from, struct gathered *gathered, struct gather_counts *counts) {
  const struct receiver receiver = receiver_at(from);
  const struct gather_settings settings = {.method = method, .tolerance = tolerance};
  struct gather_counts work = lamp_sum_many(lamp, &settings, &receiver, 1, gathered);
  if (counts) *counts = work;
}

/* ---- The oracle. */

/* Coordinates along the axes of scene space are exact where the slab lies along them. */
static bool is_plain(const struct slab *slab) {
  return slab->u[1] == 0 && slab->u[2] == 0 && slab->v[0] == 0 && slab->v[2] == 0;
}

static void add_change(const struct slab *slab, const struct surfel *receiver,
                       const struct oracle_value *middle, const double shift[3],
                       const double turn[3], double spread[3]) {
  double largest[3] = {0};
  for (int sign = -1; sign <= 1; sign += 2) {
    struct surfel moved = *receiver;
    for (int c = 0; c < 3; ++c) {
      moved.p[c] += sign * shift[c];
      moved.n[c] += sign * turn[c];
    }
    const struct oracle_value value = oracle_irradiance(slab, moved.p, moved.n);
    for (int c = 0; c < 3; ++c)
      largest[c] = larger(largest[c], (double)fabsl(value.e[c] - middle->e[c]));
  }
  for (int c = 0; c < 3; ++c) spread[c] += largest[c];
}

void oracle_spread(const struct slab *slab, const struct surfel *receiver, double spread[3]) {
  static const double none[3];
  const struct oracle_value middle = oracle_irradiance(slab, receiver->p, receiver->n);
  const double *frame[3] = {slab->u, slab->v, slab->normal};
  double from[3], far;
  for (int c = 0; c < 3; ++c) {
    from[c] = receiver->p[c] - slab->center[c];
    spread[c] = 0;
  }
  far = vector_length(from);
  for (int axis = 0; axis < 3; ++axis) {
    double shift[3] = {0}, turn[3] = {0};
    double by = rounding * (is_plain(slab) ? fabs(from[axis]) : far) / vector_length(frame[axis]);
    for (int c = 0; c < 3; ++c) shift[c] = by * frame[axis][c];
    turn[axis] = rounding * (is_plain(slab) ? fabs(receiver->n[axis]) : 1);
    if (by > 0) add_change(slab, receiver, &middle, shift, none, spread);
    if (turn[axis] > 0) add_change(slab, receiver, &middle, none, turn, spread);
  }
}

/* ---- Side by side. */

static double largest(const long double rgb[3]) {
  return (double)fmaxl(fmaxl(rgb[0], rgb[1]), rgb[2]);
}

/* What an error in a channel is relative to. */
static double find_scale(const struct look *look, enum gather_method method, int channel) {
  const struct oracle_value *exact = look->exact;
  const double dark = NUMERICS_DARK * look->lamp->hemisphere;
  if (method == GATHER_REFERENCE || method == GATHER_CLOSED)
    return fmax((double)exact->magnitude[channel], dark);
  double scale = fmax(largest(exact->magnitude), dark);
  if (method == GATHER_CUT)
    scale = fmax(scale, least_share * fmin(look->lamp->most / (look->height * look->height),
                                           look->lamp->hemisphere));
  return scale;
}

double look_error(struct look *look, enum gather_method method, const double rgb[3], double allowed,
                  double error[3]) {
  const double tried = allowed > exact_methods ? allowed : allowed / 100;
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    const double beside = (double)((long double)rgb[c] - look->exact->e[c]);
    double off = fabs(beside);
    error[c] = 0;
    if (!isfinite(rgb[c]) || isnan(off) || (rgb[c] < 0 && look->lamp->positive)) return NAN;
    if (off == 0) continue;
    double scale = find_scale(look, method, c);
    if (off > tried * scale && !look->has_spread) {
      oracle_spread(&look->lamp->slab, look->receiver, look->spread);
      look->has_spread = true;
    }
    if (look->has_spread) off = larger(0, off - look->spread[c]);
    worst = larger(worst, off / scale);
    error[c] = copysign(off / scale, beside);
  }
  return worst;
}

static void print_receiver(const struct surfel *receiver, const struct oracle_value *exact) {
  const double *p = receiver->p, *n = receiver->n;
  printf("receiver %.17g %.17g %.17g  %.17g %.17g %.17g: %.17Lg %.17Lg %.17Lg\n", p[0], p[1], p[2],
         n[0], n[1], n[2], exact->e[0], exact->e[1], exact->e[2]);
}

static double find_height(const struct slab *slab, const double p[3]) {
  double height = 0;
  for (int c = 0; c < 3; ++c) height += (p[c] - slab->center[c]) * slab->normal[c];
  return height;
}

struct look look_at(const struct lamp *lamp, const struct surfel *receiver,
                    const struct oracle_value *exact) {
  return (struct look){lamp, receiver, exact, find_height(&lamp->slab, receiver->p), {0}, false};
}

void trial_hold_value(struct trial *trial, const struct lamp *lamp, const struct surfel *receiver,
                      const struct oracle_value *exact) {
  static const double tolerances[] = {1e-2, 1e-3, 1e-4, 1e-6, 1e-8};
  struct look look = look_at(lamp, receiver, exact);
  const double asked = tolerances[random_choose(&trial->seed, 5)];
  if (trial->verbose) print_receiver(receiver, exact);
  for (int k = 0; k < GATHER_METHODS; ++k) {
    if (gather_methods[k].sum == METHOD_OPENGL) continue;
    const enum gather_method method = (enum gather_method)k;
    struct gathered got = {{0}, {0}, 0};
    double error[3];
    bool asks = method == GATHER_AUTO || method == GATHER_CUT;
    lamp_sum(lamp, method, asks ? asked : 1e-6, receiver, &got, NULL);
    double allowed = asks ? asked : got.error;
    if (method == GATHER_REFERENCE || method == GATHER_CLOSED) allowed = exact_methods;
    trial_note(trial, method, look_error(&look, method, got.irradiance, allowed, error), allowed);
    if (trial->verbose)
      printf("  %-12s %.17g %.17g %.17g, predicted %g\n", gather_methods[method].name,
             got.irradiance[0], got.irradiance[1], got.irradiance[2], got.error);
  }
}

void trial_hold(struct trial *trial, struct lamp *lamp, const struct surfel *receiver) {
  const struct oracle_value exact = oracle_irradiance(&lamp->slab, receiver->p, receiver->n);
  trial_hold_value(trial, lamp, receiver, &exact);
  trial_hold_views(trial, lamp, receiver);
}
