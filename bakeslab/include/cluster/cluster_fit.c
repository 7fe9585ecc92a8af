/* cluster_fit.c - all numbers of the lights, by least squares (Levenberg and
 * Marquardt), against the target's irradiance.
 *
 * The colours enter linearly: for each trial of the other numbers they are
 * solved for, not negative, in each channel. A channel's derivatives are
 * those of the light's irradiance times its colour, so that all channels share
 * one table of derivatives. Colours follow the other numbers; that
 * they do is told to the step by one more unknown a light, its gain. */
#include "include/cluster/cluster_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "include/cluster/cluster_colours.h"
#include "include/cluster/nnls.h"

/* Unknowns of a light: its numbers and, last, its gain. */
enum { GAIN = CLUSTER_NUMBERS, NUMBERS, MOST_STEPS = 60 };

/* A fit ends when a step gains less than this of the squared error. */
static const double least_gain = 3e-4;

/* Cones are at least so many times the narrowest lobe that the receivers see, their soft
 * edges so many. */
static const double least_cone = 2, least_edge = 0.25;

/* Of the counted work, what a pair of lights in a row costs in the normal equations, and in the
 * solution for colours. */
static const double pair_work = 1.5, colour_work = 0.05;

struct fit {
  struct cluster_work *work;
  const struct cluster_target *target;
  int count; /* of lights */
  int rows;  /* of receivers and the flux */
  const struct cluster_light *seeds;
  struct cluster_numbers now[CLUSTER_MOST_LIGHTS], trial[CLUSTER_MOST_LIGHTS];
  struct cluster_colours colours; /* of the trial; its rest begins the block of all below; owned */
  double rgb_now[CLUSTER_MOST_LIGHTS][3];
  double *base, *base_now;                    /* rows x count: irradiance of rgb 1 */
  double *jacobian;                           /* rows x count x NUMBERS */
  double *normal, *damped;                    /* (count * NUMBERS)^2 */
  double side[CLUSTER_MOST_LIGHTS * NUMBERS]; /* count * NUMBERS */
};

static double between(double x, double low, double high) {
  return x < low ? low : x > high ? high : x;
}

/* Keeps a lobe wide and soft enough to be seen, and before the aperture: cos_falloff is at
 * least `behind`. */
static void limit_lobe(double narrowest, double behind, struct cluster_numbers *n) {
  n->tightness = between(n->tightness, 0, log1p(1 / (narrowest * narrowest)));
  n->falloff = fmax(fmin(n->falloff, cos(least_cone * narrowest)), behind);
  double radius = fmax(acos(n->falloff) - least_edge * narrowest, 0);
  n->softness = between(n->softness, (cos(radius) - n->falloff) / (1 - n->falloff), 1);
}

/* Of a light along u (0) or v (1). */
static double extent(const struct cluster_light *seed, const struct cluster_numbers *n, int c) {
  return fabs(seed->edge[0][c]) * exp(n->scale[0]) + fabs(seed->edge[1][c]) * exp(n->scale[1]);
}

/* Keeps a light on the aperture, its axis in the window, its lobe a lobe. */
static void limit(const struct cluster_target *target, const struct cluster_light *seed,
                  struct cluster_numbers *n) {
  const double *window = target->window;
  for (int k = 0; k < 2; ++k) {
    n->scale[k] = between(n->scale[k], -5, 5);
    n->axis[k] = between(n->axis[k], window[2 * k], window[2 * k + 1]);
  }
  for (int c = 0; c < 2; ++c) {
    double excess = extent(seed, n, c) / target->edge[c];
    for (int k = 0; k < 2 && excess > 1; ++k) n->scale[k] -= log(excess);
  }
  for (int c = 0; c < 2; ++c) {
    double room = fmax(target->edge[c] - extent(seed, n, c), 0) / 2;
    n->center[c] = between(n->center[c], -room, room);
  }
  double tilt = hypot(n->axis[0], n->axis[1]);
  limit_lobe(target->narrowest, tilt / sqrt(1 + tilt * tilt), n);
}

void cluster_limit(const struct cluster_target *target, struct cluster_light *light) {
  struct cluster_numbers n = cluster_to_numbers(light);
  limit(target, light, &n);
  *light = cluster_from_numbers(&n, light);
}

/* Of the flux, weighted, by differences: only the lobe changes it. */
static struct cluster_numbers flux_gradient(const struct fit *f, int k) {
  enum { LOBE = CLUSTER_NUMBERS - 3 };
  static const double apart = 1e-5;
  struct cluster_numbers gradient = {.x = {0}};
  double weight = f->target->weight[f->target->count];
  struct cluster_light light = cluster_from_numbers(&f->now[k], &f->seeds[k]);
  for (int p = LOBE; p < CLUSTER_NUMBERS; ++p) {
    struct cluster_numbers n = f->now[k];
    double step = p == LOBE ? apart : -apart * (1 - n.falloff);
    n.x[p] += step;
    struct cluster_light moved = cluster_from_numbers(&n, &f->seeds[k]);
    gradient.x[p] = weight * (cluster_flux(&moved) - cluster_flux(&light)) / step;
  }
  return gradient;
}

static void fill_jacobian(struct fit *f) {
  size_t width = (size_t)f->count * NUMBERS;
  for (int k = 0; k < f->count; ++k) {
    struct cluster_light light = cluster_from_numbers(&f->now[k], &f->seeds[k]);
    for (int r = 0; r < f->rows; ++r) {
      double *row = f->jacobian + (size_t)r * width + (size_t)k * NUMBERS;
      struct cluster_numbers gradient;
      if (r == f->target->count) {
        gradient = flux_gradient(f, k);
      } else {
        gradient = cluster_gradient(&light, f->target->at[r]);
        for (int p = 0; p < GAIN; ++p) gradient.x[p] *= f->target->weight[r];
      }
      memcpy(row, gradient.x, sizeof gradient.x);
      row[GAIN] = f->base_now[(size_t)r * (size_t)f->count + (size_t)k];
    }
  }
}

static double try_numbers(struct fit *f, const struct cluster_numbers *numbers) {
  for (int k = 0; k < f->count; ++k) {
    struct cluster_light light = cluster_from_numbers(&numbers[k], &f->seeds[k]);
    cluster_rows(f->target, &light, f->base + k, f->count);
  }
  return cluster_solve(f->target, f->count, f->base, &f->colours);
}

/* Adds one pair of lights of one row to the normal equations. */
static void add_pair(struct fit *f, int k, int m, const double *row) {
  int width = f->count * NUMBERS;
  double colours = 0;
  for (int c = 0; c < 3; ++c) colours += f->rgb_now[k][c] * f->rgb_now[m][c];
  if (colours == 0) return;
  for (int p = 0; p < NUMBERS; ++p) {
    double *to = f->normal + (size_t)(k * NUMBERS + p) * (size_t)width + m * NUMBERS;
    double value = colours * row[k * NUMBERS + p];
    for (int q = 0; q < NUMBERS; ++q) to[q] += value * row[m * NUMBERS + q];
  }
}

/* Normal equations of the step, from the derivatives and what is left. */
static void make_normal(struct fit *f) {
  size_t width = (size_t)f->count * NUMBERS;
  int lit[CLUSTER_MOST_LIGHTS];
  memset(f->normal, 0, width * width * sizeof *f->normal);
  memset(f->side, 0, width * sizeof *f->side);
  for (int r = 0; r < f->rows; ++r) {
    const double *row = f->jacobian + (size_t)r * width;
    int count = 0;
    for (int k = 0; k < f->count; ++k) /* the gain's derivative is the light itself */
      if (row[k * NUMBERS + GAIN] > 0) lit[count++] = k;
    for (int i = 0; i < count; ++i) {
      double rest = 0;
      for (int c = 0; c < 3; ++c) rest += f->rgb_now[lit[i]][c] * f->colours.rest[r][c];
      for (int p = 0; p < NUMBERS; ++p)
        f->side[lit[i] * NUMBERS + p] += rest * row[lit[i] * NUMBERS + p];
      for (int j = 0; j <= i; ++j) add_pair(f, lit[i], lit[j], row);
    }
    cluster_work_add(f->work, pair_work * count * count / 2);
  }
}

/* One damped step into `trial`. */
static bool step(struct fit *f, double damping) {
  int width = f->count * NUMBERS;
  memcpy(f->damped, f->normal, (size_t)width * (size_t)width * sizeof *f->damped);
  double largest = 0;
  for (int i = 0; i < width; ++i)
    largest = fmax(largest, f->normal[(size_t)i * (size_t)width + (size_t)i]);
  double move[CLUSTER_MOST_LIGHTS * NUMBERS];
  for (int i = 0; i < width; ++i) {
    double *diagonal = &f->damped[(size_t)i * (size_t)width + (size_t)i];
    *diagonal += damping * *diagonal + 1e-9 * largest;
    move[i] = f->side[i];
  }
  if (!nnls_cholesky(width, f->damped, move)) return false;
  for (int k = 0; k < f->count; ++k) {
    for (int p = 0; p < GAIN; ++p) f->trial[k].x[p] = f->now[k].x[p] + move[k * NUMBERS + p];
    limit(f->target, &f->seeds[k], &f->trial[k]);
  }
  return true;
}

static void accept_trial(struct fit *f) {
  memcpy(f->now, f->trial, (size_t)f->count * sizeof *f->now);
  memcpy(f->rgb_now, f->colours.rgb, (size_t)f->count * sizeof *f->rgb_now);
  memcpy(f->base_now, f->base, (size_t)f->rows * (size_t)f->count * sizeof *f->base);
}

void cluster_work_add(struct cluster_work *work, double more) {
  work->done += more;
  if (work->progress && isfinite(work->most))
    progress_show(work->progress, work->begun + work->part * fmin(work->done / work->most, 1),
                  "fitting lights");
}

/* Of one table of the lights' rows, and of solving for their colours. */
static double trial_work(const struct fit *f) {
  double points = 0, n = f->count;
  for (int k = 0; k < f->count; ++k) points += f->seeds[k].size[0] * f->seeds[k].size[1];
  return f->rows * (points + colour_work * n * n);
}

static void refine(struct fit *f) {
  memcpy(f->trial, f->now, (size_t)f->count * sizeof *f->now);
  double squares = try_numbers(f, f->trial), damping = 1e-2, trial = trial_work(f);
  accept_trial(f);
  for (int steps = 0, idle = 0; steps < MOST_STEPS && idle < 4; ++steps) {
    if (f->work->done > f->work->most) break;
    cluster_work_add(f->work, 2 * trial);
    fill_jacobian(f);
    make_normal(f);
    double before = squares;
    for (int tries = 0; tries < 12; ++tries, damping *= 4) {
      if (!step(f, damping)) continue;
      cluster_work_add(f->work, trial);
      double after = try_numbers(f, f->trial);
      if (after >= squares) continue;
      squares = after;
      accept_trial(f);
      damping = fmax(damping / 6, 1e-7);
      break;
    }
    if (squares == before) break;
    idle = before - squares < least_gain * before ? idle + 1 : 0;
  }
}

static bool allocate(struct fit *f) {
  size_t n = (size_t)f->count, rows = (size_t)f->rows, width = n * NUMBERS;
  double *room = calloc(rows * (3 + 2 * n + width) + 2 * width * width, sizeof *room);
  if (!room) return false;
  f->colours.rest = (double(*)[3])room;
  f->base = room + 3 * rows;
  f->base_now = f->base + rows * n;
  f->jacobian = f->base_now + rows * n;
  f->normal = f->jacobian + rows * width;
  f->damped = f->normal + width * width;
  return true;
}

/* Leaves out lights that shine nothing; returns how many remain. */
static int drop_dark(struct cluster_light *lights, int count) {
  int kept = 0;
  for (int k = 0; k < count; ++k)
    if (lights[k].rgb[0] + lights[k].rgb[1] + lights[k].rgb[2] > 0) lights[kept++] = lights[k];
  return kept;
}

/* The last share of a percent of the flux, which the fit only weighs. */
static void correct_flux(const struct cluster_target *target, struct cluster_light *lights,
                         int count) {
  for (int c = 0; c < 3; ++c) {
    double flux = 0, wanted = target->rgb[target->count][c];
    for (int k = 0; k < count; ++k) flux += lights[k].rgb[c] * cluster_flux(&lights[k]);
    for (int k = 0; k < count; ++k) lights[k].rgb[c] *= flux > 0 ? wanted / flux : 0;
  }
}

enum result cluster_fit(const struct cluster_target *target, struct cluster_light *lights,
                        int *count, struct cluster_work *work, struct error *error) {
  struct fit f = {
      .work = work, .target = target, .count = *count, .rows = target->count + 1, .seeds = lights};
  if (!allocate(&f)) return result_no_memory(error);
  for (int k = 0; k < *count; ++k) {
    f.now[k] = cluster_to_numbers(&lights[k]);
    limit(target, &lights[k], &f.now[k]);
  }
  refine(&f);
  for (int k = 0; k < *count; ++k) {
    lights[k] = cluster_from_numbers(&f.now[k], &lights[k]);
    memcpy(lights[k].rgb, f.rgb_now[k], sizeof lights[k].rgb);
  }
  *count = drop_dark(lights, *count);
  correct_flux(target, lights, *count);
  free(f.colours.rest);
  return RESULT_OK;
}
