/* rows_symmetry.c - what must not matter: units, mirrors, turns, names of axes; and what is
 * linear. No oracle is needed but the method itself. */
#include <math.h>
#include <string.h>

#include "numerics.h"

static const int grid[SLAB_AXES] = {4, 3, 6, 5};
static const double ordinary[4] = {-0.7, 1.1, -0.9, 0.6}, tolerance = 1e-3;

static struct slab any_slab(struct trial *trial, enum frame frame) {
  double distance = trial_distance(trial);
  return rough_slab(grid, distance, ordinary, frame, FILL_UNIFORM, trial->seed);
}

static struct surfel any_receiver(struct trial *trial, const struct slab *slab) {
  return aimed_receiver(slab, random_log(&trial->seed, 1e-2, 1e4),
                        (enum receiver_kind)random_choose(&trial->seed, RECEIVER_KINDS),
                        &trial->seed);
}

/* The largest difference to `by` a, relative to the largest of it, or to `most`. */
static double differ(const double a[3], double by, const double b[3], double most) {
  double off = 0;
  for (int c = 0; c < 3; ++c) {
    if (!isfinite(a[c]) || !isfinite(b[c])) return NAN;
    off = fmax(off, fabs(by * a[c] - b[c]));
    most = fmax(most, fabs(by * a[c]));
  }
  return off > 0 ? off / most : 0;
}

static void copy_slab(const struct slab *from, struct slab *to) {
  struct error error = {{0}};
  if (slab_copy_geometry(from, to, &error) != RESULT_OK || slab_alloc(to, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  memcpy(to->rgb, from->rgb, 3 * slab_sample_count(from) * sizeof *to->rgb);
}

static void scale_lengths(struct slab *slab, struct surfel *receiver, double by) {
  for (int c = 0; c < 3; ++c) {
    slab->center[c] *= by;
    slab->u[c] *= by;
    slab->v[c] *= by;
    receiver->p[c] *= by;
  }
  slab->st_distance *= by;
}

/* Lengths and samples times powers of two: the same bits. */
void row_powers(struct trial *trial) {
  struct slab slab = any_slab(trial, (enum frame)random_choose(&trial->seed, 3)), scaled;
  struct surfel receiver = any_receiver(trial, &slab), far = receiver;
  int lengths = random_choose(&trial->seed, 601) - 300,
      samples = random_choose(&trial->seed, 121) - 60;
  struct lamp lamps[2];
  copy_slab(&slab, &scaled);
  scale_lengths(&scaled, &far, ldexp(1, lengths));
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k)
    scaled.rgb[k] = ldexpf(scaled.rgb[k], samples);
  lamps[0] = lamp_open(&slab);
  lamps[1] = lamp_open(&scaled);
  for (int k = 0; k < NUMERICS_METHODS; ++k) {
    double once[3], more[3];
    if (lamp_sum_any(&lamps[0], k, &receiver, once) && lamp_sum_any(&lamps[1], k, &far, more))
      trial_note(trial, (enum gather_method)k, differ(once, ldexp(1, samples), more, 0), 1e-300);
  }
  lamp_close(&lamps[0]);
  lamp_close(&lamps[1]);
}

/* Lengths of 1e-150 and 1e150. */
void row_units(struct trial *trial) {
  struct slab slab = any_slab(trial, (enum frame)random_choose(&trial->seed, 3));
  struct surfel receiver = any_receiver(trial, &slab);
  scale_lengths(&slab, &receiver, pow(10, random_between(&trial->seed, -150, 150)));
  struct lamp lamp = lamp_open(&slab);
  trial_hold(trial, &lamp, &receiver);
  lamp_close(&lamp);
}

/* Samples in another order: to[i][j][k][l] is from[...]. */
static void reorder(const struct slab *from, struct slab *to, bool swap, bool mirror) {
  const int *n = to->samples;
  for (int i = 0; i < n[SLAB_U]; ++i)
    for (int j = 0; j < n[SLAB_V]; ++j)
      for (int k = 0; k < n[SLAB_S]; ++k)
        for (int l = 0; l < n[SLAB_T]; ++l) {
          int a = mirror ? n[SLAB_U] - 1 - i : i, s = mirror ? n[SLAB_S] - 1 - k : k;
          const float *sample = swap ? slab_at(from, j, a, l, s) : slab_at(from, a, j, s, l);
          memcpy(slab_at(to, i, j, k, l), sample, 3 * sizeof *sample);
        }
}

static void swap_numbers(double *a, double *b) {
  double c = *a;
  *a = *b;
  *b = c;
}

/* A mirror of x, x and y swapped, or both: a turn by 90 degrees. */
static void transform(const struct slab *from, bool swap, bool mirror, struct slab *to,
                      struct surfel *receiver) {
  *to = *from;
  to->rgb = NULL;
  to->json = NULL;
  if (swap) {
    for (int axis = 0; axis < SLAB_AXES; ++axis) to->samples[axis] = from->samples[axis ^ 1];
    for (int k = 0; k < 2; ++k) swap_numbers(&to->st_window[k], &to->st_window[2 + k]);
    swap_numbers(&receiver->p[0], &receiver->p[1]);
    swap_numbers(&receiver->n[0], &receiver->n[1]);
  }
  if (mirror) {
    swap_numbers(&to->st_window[0], &to->st_window[1]);
    for (int k = 0; k < 2; ++k) to->st_window[k] = -to->st_window[k];
    receiver->p[0] = -receiver->p[0];
    receiver->n[0] = -receiver->n[0];
  }
  struct error error = {{0}};
  if (slab_alloc(to, &error) != RESULT_OK) fail_msg("%s", error.text);
  reorder(from, to, swap, mirror);
}

/* What sums in another order, and other nodes of a cut, may do. */
static double allowed(enum gather_method method) {
  switch (method) {
  case GATHER_PAPER:
  case GATHER_PAPER_LEVELS:
    return INFINITY; /* other random numbers */
  case GATHER_CUT:
    return tolerance;
  case GATHER_REFERENCE:
  case GATHER_CLOSED:
    return 1e-9;
  default:
    return 1e-5;
  }
}

void row_symmetry(struct trial *trial) {
  struct slab slab = any_slab(trial, FRAME_PLAIN), turned;
  struct surfel receiver = any_receiver(trial, &slab), other = receiver;
  const int which = 1 + random_choose(&trial->seed, 3);
  struct lamp lamps[2];
  transform(&slab, which & 1, which & 2, &turned, &other);
  lamps[0] = lamp_open(&slab);
  lamps[1] = lamp_open(&turned);
  for (int k = 0; k < NUMERICS_METHODS; ++k) {
    const enum gather_method method = (enum gather_method)k;
    double a[3], b[3];
    if (lamp_sum_any(&lamps[0], k, &receiver, a) && lamp_sum_any(&lamps[1], k, &other, b))
      trial_note(trial, method, differ(a, 1, b, 0),
                 method == GATHER_GL ? 2 * gl_allowed(&lamps[0], &receiver) : allowed(method));
  }
  lamp_close(&lamps[0]);
  lamp_close(&lamps[1]);
}

/* a - 2 b in the samples, exactly: 24 bits hold multiples of 1/1024. */
void row_superposition(struct trial *trial) {
  struct slab slabs[3];
  struct lamp lamps[3];
  slabs[0] = any_slab(trial, (enum frame)random_choose(&trial->seed, 3));
  struct surfel receiver = any_receiver(trial, &slabs[0]);
  for (int k = 1; k < 3; ++k) copy_slab(&slabs[0], &slabs[k]);
  fill_slab(&slabs[1], FILL_EXTREME, trial->seed + 1);
  for (size_t k = 0; k < 3 * slab_sample_count(&slabs[0]); ++k) {
    slabs[0].rgb[k] = rintf(1024 * slabs[0].rgb[k]) / 1024;
    slabs[2].rgb[k] = slabs[0].rgb[k] - 2 * slabs[1].rgb[k];
  }
  for (int k = 0; k < 3; ++k) lamps[k] = lamp_open(&slabs[k]);
  for (int k = 0; k < NUMERICS_METHODS; ++k) {
    const enum gather_method method = (enum gather_method)k;
    double got[3][3], sum[3], most = 0;
    bool here = true;
    for (int s = 0; s < 3; ++s) here = lamp_sum_any(&lamps[s], k, &receiver, got[s]) && here;
    for (int c = 0; here && c < 3; ++c) {
      sum[c] = got[0][c] - 2 * got[1][c];
      most = fmax(most, got[0][c] + 2 * got[1][c]);
    }
    if (here)
      trial_note(trial, method, differ(sum, 1, got[2], most),
                 method == GATHER_CUT ? tolerance : method_rounding(method));
  }
  for (int k = 0; k < 3; ++k) lamp_close(&lamps[k]);
}
