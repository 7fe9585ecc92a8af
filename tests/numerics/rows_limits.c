/* rows_limits.c - where something vanishes or meets: at the uv plane and at the st plane, at the
 * tangent plane, at the window's edge, on the lines of the grids. Slabs lie along the axes here,
 * so that receivers are where they are meant to be, to the last bit. */
#include <math.h>

#include "numerics.h"

enum { EACH = 4 };

static const int grid[SLAB_AXES] = {4, 3, 6, 5};
static const double ordinary[4] = {-0.7, 1.1, -0.9, 0.6};

static double any_distance(struct trial *trial) {
  double finite = trial_random_log(trial, 0.3, 10);
  return trial_choose(trial, 2) ? INFINITY : finite;
}

static void open_plain(struct trial *trial, double distance, struct lamp *lamp) {
  enum fill fill = trial_choose(trial, 2) ? FILL_UNIFORM : FILL_EXTREME;
  struct slab slab = rough_slab(grid, distance, ordinary, FRAME_PLAIN, fill, trial->seed);
  lamp_open(lamp, &slab);
}

/* 0, or of either sign from `least` on. */
static double any_offset(struct trial *trial, double least, double most) {
  double offset = trial_random_log(trial, least, most);
  int sign = trial_choose(trial, 3) - 1;
  return sign * offset;
}

/* An end of the aperture, or a line of its samples. */
static double any_line(struct trial *trial, int axis) {
  int half = trial_choose(trial, grid[axis] + 2);
  if (half == 0) return -0.5;
  return half > grid[axis] ? 0.5 : (half - 0.5) / grid[axis] - 0.5;
}

static void face_away(struct test_receiver *receiver, struct trial *trial) {
  random_direction(&trial->seed, receiver->n);
  if (receiver->n[2] > 0)
    for (int c = 0; c < 3; ++c) receiver->n[c] = -receiver->n[c];
}

/* Down to the uv plane and on it: inside, on the border, outside. */
void row_touching(struct trial *trial) {
  struct lamp lamp;
  open_plain(trial, any_distance(trial), &lamp);
  for (int k = 0; k < EACH; ++k) {
    struct test_receiver receiver = {{0}, {0}};
    const double heights[] = {0, 1e-300, trial_random_log(trial, 1e-30, 0.1)};
    for (int axis = 0; axis < 2; ++axis)
      receiver.p[axis] = trial_choose(trial, 3)
                             ? trial_random(trial, -0.49, 0.49)
                             : any_line(trial, axis) + any_offset(trial, 1e-12, 0.1);
    receiver.p[2] = heights[trial_choose(trial, 3)];
    face_away(&receiver, trial);
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}

/* Through the st plane: where the order of the st lines reverses, and on it. */
void row_st_plane(struct trial *trial) {
  double distance = trial_random_log(trial, 0.1, 10);
  struct lamp lamp;
  open_plain(trial, distance, &lamp);
  for (int k = 0; k < EACH; ++k) {
    double z = distance * (1 + any_offset(trial, 1e-16, 0.1));
    struct test_receiver receiver = aimed_receiver(
        &lamp.slab, z, (enum receiver_kind)trial_choose(trial, RECEIVER_KINDS), &trial->seed);
    receiver.p[2] = z;
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}

/* An end of the window, or a line of st samples, seen through an end of the aperture or one of
 * its lines, or beside it. */
void row_window(struct trial *trial) {
  double distance = any_distance(trial);
  struct lamp lamp;
  open_plain(trial, distance, &lamp);
  for (int k = 0; k < EACH; ++k) {
    double z = trial_random_log(trial, 1e-3, 1e6);
    struct test_receiver receiver = {{0, 0, z}, {0}};
    for (int axis = 0; axis < 2; ++axis) {
      double a = any_line(trial, axis), s;
      int half = trial_choose(trial, 2 * grid[2 + axis] + 1);
      const double *window = ordinary + 2 * axis;
      s = window[0] + (window[1] - window[0]) * half / (2 * grid[2 + axis]);
      if (trial_choose(trial, 2)) s = window[trial_choose(trial, 2)];
      receiver.p[axis] = a + z * (s - a / distance) + any_offset(trial, 1e-16, 0.3) * fmax(z, 1);
    }
    face_away(&receiver, trial);
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}

static void cross(const double a[3], const double b[3], double c[3]) {
  for (int k = 0; k < 3; ++k)
    c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void normalise(double a[3]) {
  double length = hypot(hypot(a[0], a[1]), a[2]);
  for (int c = 0; c < 3; ++c) a[c] /= length;
}

/* The receiver's tangent plane through a corner of the aperture, along an edge or a line of
 * samples, or beside them. */
void row_tangent(struct trial *trial) {
  double distance = any_distance(trial);
  struct lamp lamp;
  open_plain(trial, distance, &lamp);
  for (int k = 0; k < EACH; ++k) {
    double z = trial_random_log(trial, 1e-2, 1e4), to_light[3], along[3] = {0};
    struct test_receiver receiver = aimed_receiver(&lamp.slab, z, RECEIVER_GENERAL, &trial->seed);
    for (int c = 0; c < 3; ++c) {
      double point = c < 2 ? any_line(trial, c) : 0;
      to_light[c] = point - receiver.p[c];
    }
    normalise(to_light);
    if (trial_choose(trial, 2))
      along[trial_choose(trial, 2)] = 1;
    else
      random_direction(&trial->seed, along);
    cross(to_light, along, receiver.n);
    normalise(receiver.n);
    double offset = any_offset(trial, 1e-17, 1), sign = trial_choose(trial, 2) ? 1 : -1;
    for (int c = 0; c < 3; ++c) receiver.n[c] = sign * receiver.n[c] + offset * to_light[c];
    normalise(receiver.n);
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}

/* ---- Small steps make small differences. */

static double difference(const struct gathered *a, const struct gathered *b) {
  double off = 0, most = 0;
  for (int c = 0; c < 3; ++c) {
    off = fmax(off, fabs(a->irradiance[c] - b->irradiance[c]));
    most = fmax(most, fmax(fabs(a->irradiance[c]), fabs(b->irradiance[c])));
    if (!isfinite(a->irradiance[c] + b->irradiance[c])) return NAN;
  }
  return off > 0 ? off / most : 0;
}

/* On lines of both grids, which meet: cells of 1/8 in uv and in st; and the next double beside. */
void row_lines(struct trial *trial) {
  static const double window[4] = {-0.5, 0.5, -0.5, 0.5};
  static const int even[SLAB_AXES] = {8, 8, 8, 8};
  const double tolerance = 1e-3, distance = trial_choose(trial, 2) ? INFINITY : 16;
  struct slab slab = rough_slab(even, distance, window, FRAME_PLAIN, FILL_EXTREME, trial->seed);
  struct lamp lamp;
  lamp_open(&lamp, &slab);
  struct test_receiver on = {{(trial_choose(trial, 9) - 4) / 16.0,
                              (trial_choose(trial, 7) - 3) / 16.0,
                              ldexp(1, trial_choose(trial, 12) - 6)},
                             {0}};
  face_away(&on, trial);
  struct test_receiver beside = on;
  for (int c = 0; c < 3; ++c) beside.p[c] = nextafter(on.p[c], trial_choose(trial, 2) ? 99 : -99);
  for (int k = 0; k < GATHER_METHODS; ++k) {
    const enum gather_method method = (enum gather_method)k;
    struct gathered first, second;
    lamp_sum(&lamp, method, tolerance, &on, &first, NULL);
    lamp_sum(&lamp, method, tolerance, &beside, &second, NULL);
    double allowed = method == GATHER_PAPER || method == GATHER_VIEWS || method == GATHER_LEVELS ||
                             method == GATHER_PAPER_LEVELS
                         ? INFINITY
                     : method == GATHER_CUT ? tolerance
                                            : method_rounding(method);
    trial_note(trial, method, difference(&first, &second), allowed);
  }
  trial_hold(trial, &lamp, &on);
  lamp_close(&lamp);
}

/* From an infinitely far st plane to one at 1 to 1e15: linear in 1/D. */
void row_st_infinity(struct trial *trial) {
  const double distance = trial_random_log(trial, 10, 1e15);
  struct slab slabs[2];
  struct lamp lamps[2];
  uint32_t fill = trial->seed;
  for (int k = 0; k < 2; ++k) {
    slabs[k] = rough_slab(grid, k ? INFINITY : distance, ordinary, FRAME_PLAIN, FILL_UNIFORM, fill);
    lamp_open(&lamps[k], &slabs[k]);
  }
  for (int k = 0; k < EACH; ++k) {
    double z = trial_random_log(trial, 1e-2, 10);
    struct test_receiver receiver = aimed_receiver(&slabs[1], z, RECEIVER_GENERAL, &trial->seed);
    struct oracle_value exact[2];
    trial_hold(trial, &lamps[0], &receiver);
    for (int far = 0; far < 2; ++far)
      exact[far] = oracle_irradiance(&slabs[far], receiver.p, receiver.n);
    for (int closed = 0; closed < 2; ++closed) {
      struct gathered got[2];
      double worst = 0;
      for (int far = 0; far < 2; ++far)
        lamp_sum(&lamps[far], closed ? GATHER_CLOSED : GATHER_REFERENCE, 1e-6, &receiver, &got[far],
                 NULL);
      for (int c = 0; c < 3; ++c) {
        double off =
            got[0].irradiance[c] - got[1].irradiance[c] - (double)(exact[0].e[c] - exact[1].e[c]);
        if (off != 0) worst = fmax(worst, fabs(off) / (double)exact[1].magnitude[c]);
      }
      trial_note(trial, closed ? GATHER_CLOSED : GATHER_REFERENCE, worst, 1e-9);
    }
  }
  for (int k = 0; k < 2; ++k) lamp_close(&lamps[k]);
}
