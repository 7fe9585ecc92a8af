/* rows_limits.c - where something vanishes or meets: at the uv plane and at the st plane, at the
 * tangent plane, at the window's edge, on the lines of the grids. Slabs lie along the axes here,
 * so that receivers are where they are meant to be, to the last bit. */
#include <math.h>

#include "base/vector.h"
#include "numerics.h"

enum { EACH = 4 };

static const int grid[SLAB_AXES] = {4, 3, 6, 5};
static const double ordinary[4] = {-0.7, 1.1, -0.9, 0.6};

static struct lamp open_plain(struct trial *trial, double distance) {
  enum fill fill = random_choose(&trial->seed, 2) ? FILL_UNIFORM : FILL_EXTREME;
  struct slab slab = rough_slab(grid, distance, ordinary, FRAME_PLAIN, fill, trial->seed);
  return lamp_open(&slab);
}

/* 0, or of either sign from `least` on. */
static double any_offset(struct trial *trial, double least, double most) {
  double offset = random_log(&trial->seed, least, most);
  int sign = random_choose(&trial->seed, 3) - 1;
  return sign * offset;
}

/* An end of the aperture, or a line of its samples. */
static double any_line(struct trial *trial, int axis) {
  int half = random_choose(&trial->seed, grid[axis] + 2);
  if (half == 0) return -0.5;
  return half > grid[axis] ? 0.5 : (half - 0.5) / grid[axis] - 0.5;
}

static void face_away(struct surfel *receiver, struct trial *trial) {
  random_direction(&trial->seed, receiver->n);
  if (receiver->n[2] > 0)
    for (int c = 0; c < 3; ++c) receiver->n[c] = -receiver->n[c];
}

/* Down to the uv plane and on it: inside, on the border, outside. */
void row_touching(struct trial *trial) {
  struct lamp lamp = open_plain(trial, trial_distance(trial));
  for (int k = 0; k < EACH; ++k) {
    struct surfel receiver = {{0}, {0}};
    const double heights[] = {0, 1e-300, random_log(&trial->seed, 1e-30, 0.1)};
    for (int axis = 0; axis < 2; ++axis)
      receiver.p[axis] = random_choose(&trial->seed, 3)
                             ? random_between(&trial->seed, -0.49, 0.49)
                             : any_line(trial, axis) + any_offset(trial, 1e-12, 0.1);
    receiver.p[2] = heights[random_choose(&trial->seed, 3)];
    face_away(&receiver, trial);
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}

/* Through the st plane: where the order of the st lines reverses, and on it. */
void row_st_plane(struct trial *trial) {
  double distance = random_log(&trial->seed, 0.1, 10);
  struct lamp lamp = open_plain(trial, distance);
  for (int k = 0; k < EACH; ++k) {
    double z = distance * (1 + any_offset(trial, 1e-16, 0.1));
    struct surfel receiver = aimed_receiver(
        &lamp.slab, z, (enum receiver_kind)random_choose(&trial->seed, RECEIVER_KINDS),
        &trial->seed);
    receiver.p[2] = z;
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}

/* An end of the window, or a line of st samples, seen through an end of the aperture or one of
 * its lines, or beside it. */
void row_window(struct trial *trial) {
  double distance = trial_distance(trial);
  struct lamp lamp = open_plain(trial, distance);
  for (int k = 0; k < EACH; ++k) {
    double z = random_log(&trial->seed, 1e-3, 1e6);
    struct surfel receiver = {{0, 0, z}, {0}};
    for (int axis = 0; axis < 2; ++axis) {
      double a = any_line(trial, axis), s;
      int half = random_choose(&trial->seed, 2 * grid[2 + axis] + 1);
      const double *window = ordinary + 2 * axis;
      s = window[0] + (window[1] - window[0]) * half / (2 * grid[2 + axis]);
      if (random_choose(&trial->seed, 2)) s = window[random_choose(&trial->seed, 2)];
      receiver.p[axis] = a + z * (s - a / distance) + any_offset(trial, 1e-16, 0.3) * fmax(z, 1);
    }
    face_away(&receiver, trial);
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}

/* The receiver's tangent plane through a corner of the aperture, along an edge or a line of
 * samples, or beside them. */
void row_tangent(struct trial *trial) {
  double distance = trial_distance(trial);
  struct lamp lamp = open_plain(trial, distance);
  for (int k = 0; k < EACH; ++k) {
    double z = random_log(&trial->seed, 1e-2, 1e4), to_light[3], along[3] = {0};
    struct surfel receiver = aimed_receiver(&lamp.slab, z, RECEIVER_GENERAL, &trial->seed);
    for (int c = 0; c < 3; ++c) {
      double point = c < 2 ? any_line(trial, c) : 0;
      to_light[c] = point - receiver.p[c];
    }
    vector_normalise(to_light);
    if (random_choose(&trial->seed, 2))
      along[random_choose(&trial->seed, 2)] = 1;
    else
      random_direction(&trial->seed, along);
    vector_cross(to_light, along, receiver.n);
    vector_normalise(receiver.n);
    double offset = any_offset(trial, 1e-17, 1), sign = random_choose(&trial->seed, 2) ? 1 : -1;
    for (int c = 0; c < 3; ++c) receiver.n[c] = sign * receiver.n[c] + offset * to_light[c];
    vector_normalise(receiver.n);
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
  const double tolerance = 1e-3, distance = random_choose(&trial->seed, 2) ? INFINITY : 16;
  struct slab slab = rough_slab(even, distance, window, FRAME_PLAIN, FILL_EXTREME, trial->seed);
  struct lamp lamp = lamp_open(&slab);
  struct surfel on = {{(random_choose(&trial->seed, 9) - 4) / 16.0,
                       (random_choose(&trial->seed, 7) - 3) / 16.0,
                       ldexp(1, random_choose(&trial->seed, 12) - 6)},
                      {0}};
  face_away(&on, trial);
  struct surfel beside = on;
  for (int c = 0; c < 3; ++c)
    beside.p[c] = nextafter(on.p[c], random_choose(&trial->seed, 2) ? 99 : -99);
  for (int k = 0; k < GATHER_METHODS; ++k) {
    if (gather_methods[k].sum == METHOD_OPENGL) continue;
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
  const double distance = random_log(&trial->seed, 10, 1e15);
  struct slab slabs[2];
  struct lamp lamps[2];
  uint64_t fill = trial->seed;
  for (int k = 0; k < 2; ++k) {
    slabs[k] = rough_slab(grid, k ? INFINITY : distance, ordinary, FRAME_PLAIN, FILL_UNIFORM, fill);
    lamps[k] = lamp_open(&slabs[k]);
  }
  for (int k = 0; k < EACH; ++k) {
    double z = random_log(&trial->seed, 1e-2, 10);
    struct surfel receiver = aimed_receiver(&slabs[1], z, RECEIVER_GENERAL, &trial->seed);
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
        if (off != 0) worst = larger(worst, fabs(off) / (double)exact[1].magnitude[c]);
      }
      trial_note(trial, closed ? GATHER_CLOSED : GATHER_REFERENCE, worst, 1e-9);
    }
  }
  for (int k = 0; k < 2; ++k) lamp_close(&lamps[k]);
}
