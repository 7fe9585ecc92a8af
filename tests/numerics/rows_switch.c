/* rows_switch.c - no step where a method takes another rule, node, level or micro light; and
 * the mean of the published algorithm. */
#include <math.h>
#include <stdio.h>

#include "base/vector.h"
#include "numerics.h"

static const double ordinary[4] = {-0.7, 1.1, -0.9, 0.6}, tolerance = 1e-3;

/* A way for a receiver: from one to another, evenly in the logarithm of the height. */
struct way {
  const struct slab *slab;
  struct surfel ends[2];
  double z[2], slope[2][2];
};

static struct way any_way(struct trial *trial, const struct slab *slab) {
  struct way way = {.slab = slab};
  for (int k = 0; k < 2; ++k) {
    way.z[k] = random_log(&trial->seed, 0.03, 300);
    way.ends[k] = aimed_receiver(slab, way.z[k], RECEIVER_GENERAL, &trial->seed);
    for (int axis = 0; axis < 2; ++axis) way.slope[k][axis] = way.ends[k].p[axis] / way.z[k];
  }
  return way;
}

static struct surfel along(const struct way *way, double t) {
  struct surfel at = {{0}, {0}};
  at.p[2] = way->z[0] * pow(way->z[1] / way->z[0], t);
  for (int axis = 0; axis < 2; ++axis)
    at.p[axis] = at.p[2] * (way->slope[0][axis] + t * (way->slope[1][axis] - way->slope[0][axis]));
  for (int c = 0; c < 3; ++c) at.n[c] = way->ends[0].n[c] * (1 - t) + way->ends[1].n[c] * t;
  vector_normalise(at.n);
  return at;
}

/* What was done: it changes where a method takes another rule, node, level or micro light. */
struct done {
  uint64_t microlights, nodes;
  struct gathered got;
};

static struct done sum(const struct lamp *lamp, enum gather_method method, const struct way *way,
                       double t) {
  const struct surfel at = along(way, t);
  struct gather_counts counts;
  struct done done;
  lamp_sum(lamp, method, tolerance, &at, &done.got, &counts);
  done.microlights = counts.microlights;
  done.nodes = counts.nodes;
  return done;
}

static bool same(const struct done *a, const struct done *b) {
  return a->microlights == b->microlights && a->nodes == b->nodes;
}

static double claimed(enum gather_method method, const struct done *a, const struct done *b) {
  if (method == GATHER_REFERENCE || method == GATHER_CLOSED) return 1e-9;
  if (method == GATHER_AUTO || method == GATHER_CUT) return tolerance;
  return fmax(a->got.error, b->got.error);
}

/* Halves the step in which something changes, down to two doubles side by side. */
static void find_step(struct trial *trial, const struct lamp *lamp, enum gather_method method,
                      const struct way *way, double t[2], struct done done[2]) {
  for (int k = 0; k < 60; ++k) {
    double middle = (t[0] + t[1]) / 2;
    if (!(middle > t[0] && middle < t[1])) break;
    struct done between = sum(lamp, method, way, middle);
    int side = same(&between, &done[0]) ? 0 : 1;
    t[side] = middle;
    done[side] = between;
  }
  const double *a = done[0].got.irradiance, *b = done[1].got.irradiance;
  double step = 0, most = NUMERICS_DARK * lamp->hemisphere, spread[2][3];
  struct oracle_value exact[2];
  for (int c = 0; c < 3; ++c) most = fmax(most, fmax(fabs(a[c]), fabs(b[c])));
  if (method == GATHER_CUT) {
    double z = way->z[0] * pow(way->z[1] / way->z[0], t[0]);
    most = fmax(most, 1e-4 * fmin(lamp->most / (z * z), lamp->hemisphere));
  }
  for (int k = 0; k < 2; ++k) {
    const struct surfel at = along(way, t[k]);
    exact[k] = oracle_irradiance(&lamp->slab, at.p, at.n);
    oracle_spread(&lamp->slab, &at, spread[k]);
  }
  const struct surfel at = along(way, t[0]);
  if (trial->verbose)
    printf("  receiver %.17g %.17g %.17g  %.17g %.17g %.17g: %.17g beside %.17g\n", at.p[0],
           at.p[1], at.p[2], at.n[0], at.n[1], at.n[2], a[0], b[0]);
  for (int c = 0; c < 3; ++c) {
    double off = fabs(a[c] - b[c] - (double)(exact[0].e[c] - exact[1].e[c]));
    step = larger(step, off - spread[0][c] - spread[1][c]);
  }
  trial_note(trial, method, step <= 0 ? 0 : step / most, claimed(method, &done[0], &done[1]));
}

void row_switches(struct trial *trial) {
  enum { STEPS = 12 };
  static const int grid[SLAB_AXES] = {4, 4, 6, 6};
  static const enum gather_method methods[] = {GATHER_AUTO,   GATHER_REFERENCE, GATHER_PI,
                                               GATHER_CLOSED, GATHER_LEVELS,    GATHER_CUT};
  const enum gather_method method = methods[trial->start % 6];
  const double distance =
      random_choose(&trial->seed, 2) ? INFINITY : random_log(&trial->seed, 0.3, 10);
  struct slab slab = rough_slab(grid, distance, ordinary, FRAME_PLAIN, FILL_UNIFORM, trial->seed);
  struct lamp lamp = lamp_open(&slab);
  const struct way way = any_way(trial, &slab);
  struct done before = sum(&lamp, method, &way, 0);
  for (int k = 1; k <= STEPS; ++k) {
    struct done next = sum(&lamp, method, &way, (double)k / STEPS);
    if (!same(&before, &next))
      find_step(trial, &lamp, method, &way, (double[2]){(k - 1.0) / STEPS, (double)k / STEPS},
                (struct done[2]){before, next});
    before = next;
  }
  lamp_close(&lamp);
}

/* ---- The published algorithm: its mean is the integral, to 6 standard errors. */

void row_random(struct trial *trial) {
  enum { SAMPLES = 400 };
  static const int grid[SLAB_AXES] = {2, 3, 4, 3};
  struct slab slab = rough_slab(grid, INFINITY, ordinary, FRAME_TURNED, FILL_EXTREME, trial->seed);
  struct lamp lamp = lamp_open(&slab);
  const struct surfel at =
      aimed_receiver(&slab, random_log(&trial->seed, 0.05, 100), RECEIVER_GENERAL, &trial->seed);
  const struct receiver receiver = receiver_at(&at);
  const struct oracle_value exact = oracle_irradiance(&slab, at.p, at.n);
  double sum = 0, square = 0;
  for (int k = 0; k < SAMPLES; ++k) {
    struct gathered got;
    const struct gather_settings settings = {
        .method = GATHER_PAPER, .tolerance = 1e-6, .seed = (uint64_t)k};
    lamp_sum_many(&lamp, &settings, &receiver, 1, &got);
    double offset = (double)((long double)got.irradiance[1] - exact.e[1]);
    sum += offset;
    square += offset * offset;
  }
  const double mean = sum / SAMPLES;
  const double error = sqrt(fmax(0, square / SAMPLES - mean * mean) / SAMPLES);
  if (!(exact.e[1] <= 0))
    trial_note(trial, GATHER_PAPER, fabs(mean) / (double)exact.e[1],
               6 * error / (double)exact.e[1] + 1e-12);
  lamp_close(&lamp);
}
