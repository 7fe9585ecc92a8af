/* rows_sweep.c - hard cases by how far a number is taken: distance, angles, aspect, the distance
 * of the st plane, ranges of samples, offsets. Each seed is a lamp and a few receivers. */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "numerics.h"

enum { EACH = 4 };

static const int grids[][SLAB_AXES] = {{4, 4, 6, 6}, {5, 3, 7, 4}, {2, 3, 5, 6}, {1, 3, 4, 1},
                                       {6, 5, 2, 3}, {1, 1, 8, 8}, {3, 4, 1, 1}, {2, 2, 2, 2}};
enum { GRIDS = sizeof grids / sizeof grids[0] };

static const double windows[][4] = {
    {-0.7, 1.1, -0.9, 0.6}, {-5, 5, -5, 5}, {-0.02, 0.03, -0.05, 0.01}, {0.2, 1.5, -1.4, -0.3}};
enum { WINDOWS = sizeof windows / sizeof windows[0] };

/* Any of the usual lamps. */
static struct slab any_slab(struct trial *trial, double distance, enum fill fill) {
  enum frame frame = (enum frame)random_choose(&trial->seed, 3);
  const double *window = windows[random_choose(&trial->seed, WINDOWS)];
  const int *grid = grids[random_choose(&trial->seed, GRIDS)];
  return rough_slab(grid, distance, window, frame, fill, trial->seed);
}

static enum fill any_fill(struct trial *trial) {
  return random_choose(&trial->seed, 2) ? FILL_UNIFORM : FILL_EXTREME;
}

static void hold_aimed(struct trial *trial, struct slab *slab, double nearest, double farthest) {
  struct lamp lamp = lamp_open(slab);
  for (int k = 0; k < EACH; ++k) {
    double z = random_log(&trial->seed, nearest, farthest);
    enum receiver_kind kind = (enum receiver_kind)random_choose(&trial->seed, RECEIVER_KINDS);
    struct surfel receiver = aimed_receiver(slab, z, kind, &trial->seed);
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}

void row_distance(struct trial *trial) {
  struct slab slab = any_slab(trial, trial_distance(trial), any_fill(trial));
  hold_aimed(trial, &slab, 1e-9, 1e9);
}

void row_sizes(struct trial *trial) {
  static const int thin[][SLAB_AXES] = {{1, 1, 1, 1}, {1, 1, 4, 5}, {4, 5, 1, 1}, {1, 4, 1, 5},
                                        {1, 4, 5, 1}, {1, 1, 1, 3}, {2, 1, 1, 1}};
  const int *grid = thin[random_choose(&trial->seed, sizeof thin / sizeof thin[0])];
  const double *window = windows[random_choose(&trial->seed, WINDOWS)];
  struct slab slab =
      rough_slab(grid, trial_distance(trial), window, (enum frame)random_choose(&trial->seed, 3),
                 FILL_UNIFORM, trial->seed);
  hold_aimed(trial, &slab, 1e-3, 1e3);
}

void row_signed(struct trial *trial) {
  struct slab slab = any_slab(trial, trial_distance(trial), FILL_SIGNED);
  hold_aimed(trial, &slab, 1e-3, 1e3);
}

void row_st_distance(struct trial *trial) {
  double distance = random_log(&trial->seed, 1e-6, 1e9);
  struct slab slab = any_slab(trial, distance, any_fill(trial));
  if (random_choose(&trial->seed, 2))
    hold_aimed(trial, &slab, distance / 10, distance * 10);
  else
    hold_aimed(trial, &slab, 1e-2, 1e2);
}

/* ---- Angles. */

void turn_towards(struct surfel *receiver, const double to_light[3], double angle) {
  double *n = receiver->n, across = vector_dot(n, to_light);
  for (int c = 0; c < 3; ++c) n[c] -= across * to_light[c];
  vector_normalise(n);
  for (int c = 0; c < 3; ++c) n[c] = n[c] * cos(angle) + to_light[c] * sin(angle);
}

/* Light comes in at 90 degrees to 1e-9 over the receiver's horizon. */
void row_grazing_receiver(struct trial *trial) {
  struct slab slab = any_slab(trial, trial_distance(trial), any_fill(trial));
  struct lamp lamp = lamp_open(&slab);
  for (int k = 0; k < EACH; ++k) {
    double z = random_log(&trial->seed, 0.1, 1e6), to_light[3];
    struct surfel receiver = aimed_receiver(&slab, z, RECEIVER_GENERAL, &trial->seed);
    vector_subtract(slab.center, receiver.p, to_light);
    vector_normalise(to_light);
    turn_towards(&receiver, to_light, acos(-1) / 2 * random_log(&trial->seed, 1e-11, 1));
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}

/* Light leaves the lamp at 90 degrees to 1e-9 over the aperture. */
void row_grazing_lamp(struct trial *trial) {
  double slope = random_log(&trial->seed, 3, 1e9), aside = random_log(&trial->seed, 0.3, 30);
  const double window[4] = {-slope, slope, -slope, slope};
  static const int fine[SLAB_AXES] = {24, 24, 2, 2};
  const int *grid =
      random_choose(&trial->seed, 4) ? grids[random_choose(&trial->seed, GRIDS)] : fine;
  struct slab slab = rough_slab(grid, INFINITY, window, (enum frame)random_choose(&trial->seed, 3),
                                any_fill(trial), trial->seed);
  hold_aimed(trial, &slab, aside / slope, 3 * aside / slope);
}

/* ---- Shapes and places. */

/* Apertures and windows a million times as long as they are wide. */
void row_aspect(struct trial *trial) {
  double thin = random_log(&trial->seed, 1e-6, 1), narrow = random_log(&trial->seed, 1e-6, 1);
  struct slab slab = any_slab(trial, trial_distance(trial), any_fill(trial));
  double *edge = random_choose(&trial->seed, 2) ? slab.u : slab.v;
  for (int c = 0; c < 3; ++c) edge[c] *= thin;
  double *window = slab.st_window + 2 * random_choose(&trial->seed, 2);
  if (random_choose(&trial->seed, 2)) window[1] = window[0] + narrow * (window[1] - window[0]);
  hold_aimed(trial, &slab, 1e-3, 1e3);
}

/* Lamps 1e8 from the origin. */
void row_offset(struct trial *trial) {
  struct slab slab = any_slab(trial, trial_distance(trial), any_fill(trial));
  double far = random_log(&trial->seed, 1, 1e8);
  for (int c = 0; c < 3; ++c) slab.center[c] *= far;
  hold_aimed(trial, &slab, 1e-2, 1e3);
}

/* ---- Samples. */

/* Neighbouring samples from 1e-30 to 1e30, or a lamp all of whose samples are as small or large. */
void row_range(struct trial *trial) {
  struct slab slab = any_slab(trial, trial_distance(trial), FILL_UNIFORM);
  size_t count = 3 * slab_sample_count(&slab);
  bool alike = random_choose(&trial->seed, 3) == 0;
  double all = random_log(&trial->seed, 1e-30, 1e30);
  for (size_t k = 0; k < count; ++k)
    slab.rgb[k] =
        (float)(alike ? all * (double)slab.rgb[k] : random_log(&trial->seed, 1e-30, 1e30));
  hold_aimed(trial, &slab, 1e-2, 1e3);
}

/* One sample is lit, of 576 to 16,384, and the receivers are where it shines, or at its rim. */
void row_peak(struct trial *trial) {
  static const int fine[][SLAB_AXES] = {{4, 4, 6, 6}, {4, 4, 16, 16}, {8, 8, 16, 16}};
  const int *grid = fine[random_choose(&trial->seed, 3)];
  struct slab slab = rough_slab(grid, trial_distance(trial), windows[0],
                                (enum frame)random_choose(&trial->seed, 3), FILL_CONSTANT, 1);
  int at[SLAB_AXES];
  size_t floats = 3 * slab_sample_count(&slab);
  for (size_t k = 0; k < floats; ++k) slab.rgb[k] = 0;
  for (int axis = 0; axis < SLAB_AXES; ++axis) at[axis] = random_choose(&trial->seed, grid[axis]);
  float *sample = slab_at(&slab, at[0], at[1], at[2], at[3]);
  sample[0] = 1, sample[1] = 0.5f, sample[2] = 0.25f;
  struct lamp lamp = lamp_open(&slab);
  for (int k = 0; k < 2; ++k) {
    double z = random_log(&trial->seed, 0.1, 1e3), from[2], p[2];
    for (int axis = 0; axis < 2; ++axis) {
      double a = slab_position(&slab, axis, at[axis]),
             s = slab_position(&slab, 2 + axis, at[2 + axis]);
      a += random_between(&trial->seed, -1.1, 1.1) * slab_spacing(&slab, axis);
      s += random_between(&trial->seed, -1.1, 1.1) * slab_spacing(&slab, 2 + axis);
      from[axis] = a;
      p[axis] = a + z * (s - slab_kappa(&slab) * a);
    }
    struct surfel receiver = aimed_receiver(&slab, z, RECEIVER_FACING, &trial->seed);
    slab_point(&slab, p[0], p[1], z, receiver.p);
    if (random_choose(&trial->seed, 2)) {
      double light[3], to_light[3];
      slab_point(&slab, from[0], from[1], 0, light);
      vector_subtract(light, receiver.p, to_light);
      vector_normalise(to_light);
      random_direction(&trial->seed, receiver.n);
      turn_towards(&receiver, to_light, random_between(&trial->seed, 0.1, 1.5));
    }
    trial_hold(trial, &lamp, &receiver);
  }
  lamp_close(&lamp);
}
