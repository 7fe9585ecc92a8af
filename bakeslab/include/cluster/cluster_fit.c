/* cluster_fit.c - all numbers of the lights, by least squares (Levenberg and
 * Marquardt), against the target's irradiance.
 *
 * The colours enter linearly: for each trial of the other numbers they are
 * solved for, not negative, in each channel. A channel's derivatives are
 * those of the light's irradiance times its colour, so that all channels share
 * one table of derivatives. Colours follow the other numbers; that
 * they do is told to the step by one more unknown a light, its gain. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "include/cluster/cluster.h"
#include "include/cluster/nnls.h"

/* Beside what cluster_gradient knows, a step has the light's gain. */
enum {
  CENTER = CLUSTER_CENTER,
  SCALE = CLUSTER_SCALE,
  AXIS = CLUSTER_AXIS,
  TIGHTNESS = CLUSTER_TIGHTNESS,
  FALLOFF = CLUSTER_FALLOFF,
  SOFTNESS = CLUSTER_SOFTNESS,
  GAIN = CLUSTER_NUMBERS,
  NUMBERS
};

enum { MOST_STEPS = 60 };

/* A fit ends when a step gains less than this of the squared error. */
static const double least_gain = 3e-4;

/* Cones are at least so many times the narrowest lobe that the receivers see, their soft
 * edges so many. */
static const double least_cone = 2, least_edge = 0.25;

/* One light as the fit sees it. */
struct numbers {
  double x[NUMBERS];
};

struct fit {
  const struct cluster_target *target;
  int count; /* of lights */
  int rows;  /* of receivers and the flux */
  const struct cluster_light *seeds;
  struct numbers *now, *trial; /* owned, as all below */
  double *base, *base_now;     /* rows x count: irradiance of rgb 1 */
  double *slopes;              /* rows x count x NUMBERS */
  struct cluster_system system;
  double (*rgb_now)[3];
  double *normal, *damped, *gradient; /* (count * NUMBERS)^2, twice, and count * NUMBERS */
};

static struct numbers to_numbers(const struct cluster_light *light) {
  struct numbers n = {{0}};
  for (int k = 0; k < 2; ++k) {
    n.x[CENTER + k] = light->center[k];
    n.x[AXIS + k] = light->axis[k];
  }
  n.x[TIGHTNESS] = log1p(light->tightness);
  n.x[FALLOFF] = light->cos_falloff;
  n.x[SOFTNESS] = (light->cos_radius - light->cos_falloff) / (1 - light->cos_falloff);
  return n;
}

static void to_light(const struct numbers *n, const struct cluster_light *seed,
                     struct cluster_light *light) {
  *light = *seed;
  double tilt = hypot(n->x[AXIS], n->x[AXIS + 1]);
  for (int k = 0; k < 2; ++k) {
    light->center[k] = n->x[CENTER + k];
    light->axis[k] = n->x[AXIS + k];
    for (int c = 0; c < 2; ++c) light->edge[k][c] = seed->edge[k][c] * exp(n->x[SCALE + k]);
  }
  light->tightness = expm1(n->x[TIGHTNESS]);
  light->cos_falloff = fmax(n->x[FALLOFF], tilt / sqrt(1 + tilt * tilt));
  light->cos_radius = light->cos_falloff + n->x[SOFTNESS] * (1 - light->cos_falloff);
}

static double between(double x, double low, double high) {
  return x < low ? low : x > high ? high : x;
}

/* Keeps a lobe wide and soft enough to be seen, and before the aperture: cos_falloff is at
 * least `behind`. */
static void limit_lobe(double narrowest, double behind, struct numbers *n) {
  n->x[TIGHTNESS] = between(n->x[TIGHTNESS], 0, log1p(1 / (narrowest * narrowest)));
  n->x[FALLOFF] = fmax(fmin(n->x[FALLOFF], cos(least_cone * narrowest)), behind);
  double falloff = acos(n->x[FALLOFF]), radius = fmax(falloff - least_edge * narrowest, 0);
  n->x[SOFTNESS] = between(n->x[SOFTNESS], (cos(radius) - n->x[FALLOFF]) / (1 - n->x[FALLOFF]), 1);
}

/* Keeps a light on the aperture, its axis in the window, its lobe a lobe. */
static void limit(const struct cluster_target *target, const struct cluster_light *seed,
                  struct numbers *n) {
  double tilt = 0;
  for (int k = 0; k < 2; ++k) {
    n->x[SCALE + k] = between(n->x[SCALE + k], -5, 5);
    n->x[AXIS + k] = between(n->x[AXIS + k], target->slopes[2 * k], target->slopes[2 * k + 1]);
    tilt = hypot(tilt, n->x[AXIS + k]);
  }
  for (int c = 0; c < 2; ++c) {
    double extent =
        fabs(seed->edge[0][c]) * exp(n->x[SCALE]) + fabs(seed->edge[1][c]) * exp(n->x[SCALE + 1]);
    double excess = extent / target->edge[c];
    if (excess > 1)
      for (int k = 0; k < 2; ++k) n->x[SCALE + k] -= log(excess);
  }
  for (int c = 0; c < 2; ++c) {
    double extent =
        fabs(seed->edge[0][c]) * exp(n->x[SCALE]) + fabs(seed->edge[1][c]) * exp(n->x[SCALE + 1]);
    double room = fmax(target->edge[c] - extent, 0) / 2;
    n->x[CENTER + c] = between(n->x[CENTER + c], -room, room);
  }
  limit_lobe(target->narrowest, tilt / sqrt(1 + tilt * tilt), n);
}

void cluster_limit(const struct cluster_target *target, struct cluster_light *light) {
  const struct cluster_light seed = *light;
  struct numbers n = to_numbers(&seed);
  limit(target, &seed, &n);
  to_light(&n, &seed, light);
}

/* What light `k` gives to each row, `step` apart in the table. */
static void fill(const struct fit *f, int k, const struct numbers *n, double *table, int step) {
  struct cluster_light light;
  to_light(n, &f->seeds[k], &light);
  cluster_rows(f->target, &light, table, (size_t)step);
}

/* Of the flux, which only the lobe changes, by differences. */
static void flux_slopes(const struct fit *f, int k, double slopes[GAIN]) {
  static const double apart = 1e-5;
  double weight = f->target->weight[f->target->count];
  struct cluster_light light, moved;
  to_light(&f->now[k], &f->seeds[k], &light);
  memset(slopes, 0, GAIN * sizeof *slopes);
  for (int p = TIGHTNESS; p < GAIN; ++p) {
    struct numbers n = f->now[k];
    double step = p == TIGHTNESS ? apart : -apart * (1 - n.x[FALLOFF]);
    n.x[p] += step;
    to_light(&n, &f->seeds[k], &moved);
    slopes[p] = weight * (cluster_flux(&moved) - cluster_flux(&light)) / step;
  }
}

static void fill_slopes(struct fit *f) {
  size_t width = (size_t)f->count * NUMBERS;
  for (int k = 0; k < f->count; ++k) {
    struct cluster_light light;
    to_light(&f->now[k], &f->seeds[k], &light);
    for (int r = 0; r < f->rows; ++r) {
      double *row = f->slopes + (size_t)r * width + (size_t)k * NUMBERS;
      row[GAIN] = f->base_now[(size_t)r * (size_t)f->count + (size_t)k];
      if (r == f->target->count) {
        flux_slopes(f, k, row);
        continue;
      }
      cluster_gradient(&light, f->target->at[r], row);
      for (int p = 0; p < GAIN; ++p) row[p] *= f->target->weight[r];
    }
  }
}

static double try_numbers(struct fit *f, const struct numbers *numbers) {
  for (int k = 0; k < f->count; ++k) fill(f, k, &numbers[k], f->base + k, f->count);
  return cluster_solve(f->target, &f->system, f->base);
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
  memset(f->gradient, 0, width * sizeof *f->gradient);
  for (int r = 0; r < f->rows; ++r) {
    const double *row = f->slopes + (size_t)r * width;
    int count = 0;
    for (int k = 0; k < f->count; ++k) /* the gain's derivative is the light itself */
      if (row[k * NUMBERS + GAIN] > 0) lit[count++] = k;
    for (int i = 0; i < count; ++i) {
      double rest = 0;
      for (int c = 0; c < 3; ++c) rest += f->rgb_now[lit[i]][c] * f->system.rest[r][c];
      for (int p = 0; p < NUMBERS; ++p)
        f->gradient[lit[i] * NUMBERS + p] += rest * row[lit[i] * NUMBERS + p];
      for (int j = 0; j <= i; ++j) add_pair(f, lit[i], lit[j], row);
    }
  }
}

/* One damped step into `trial`. */
static bool step(struct fit *f, double damping) {
  int width = f->count * NUMBERS;
  memcpy(f->damped, f->normal, (size_t)width * (size_t)width * sizeof *f->damped);
  double largest = 0;
  for (int i = 0; i < width; ++i)
    largest = fmax(largest, f->normal[(size_t)i * (size_t)width + (size_t)i]);
  double *move = f->damped + (size_t)width * (size_t)width;
  for (int i = 0; i < width; ++i) {
    double *diagonal = &f->damped[(size_t)i * (size_t)width + (size_t)i];
    *diagonal += damping * *diagonal + 1e-9 * largest;
    move[i] = f->gradient[i];
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
  memcpy(f->rgb_now, f->system.rgb, (size_t)f->count * sizeof *f->rgb_now);
  memcpy(f->base_now, f->base, (size_t)f->rows * (size_t)f->count * sizeof *f->base);
}

static void refine(struct fit *f) {
  memcpy(f->trial, f->now, (size_t)f->count * sizeof *f->now);
  double squares = try_numbers(f, f->trial), damping = 1e-2;
  accept_trial(f);
  for (int steps = 0, idle = 0; steps < MOST_STEPS && idle < 4; ++steps) {
    fill_slopes(f);
    make_normal(f);
    double before = squares;
    for (int tries = 0; tries < 12; ++tries, damping *= 4) {
      if (!step(f, damping)) continue;
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
  f->now = calloc(n, sizeof *f->now);
  f->trial = calloc(n, sizeof *f->trial);
  f->base = calloc(rows * n, sizeof *f->base);
  f->base_now = calloc(rows * n, sizeof *f->base_now);
  f->slopes = calloc(rows * width, sizeof *f->slopes);
  f->rgb_now = calloc(n, sizeof *f->rgb_now);
  f->normal = calloc(width * width, sizeof *f->normal);
  f->damped = calloc(width * width + width, sizeof *f->damped);
  f->gradient = calloc(width, sizeof *f->gradient);
  return f->now && f->trial && f->base && f->base_now && f->slopes && f->rgb_now && f->normal &&
         f->damped && f->gradient && cluster_system_make(f->count, f->rows, &f->system);
}

static void release(struct fit *f) {
  free(f->now);
  free(f->trial);
  free(f->base);
  free(f->base_now);
  free(f->slopes);
  free(f->rgb_now);
  free(f->normal);
  free(f->damped);
  free(f->gradient);
  cluster_system_free(&f->system);
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
                        int *count, struct error *error) {
  struct fit f = {.target = target, .count = *count, .rows = target->count + 1, .seeds = lights};
  enum result result = RESULT_OK;
  if (allocate(&f)) {
    for (int k = 0; k < *count; ++k) {
      f.now[k] = to_numbers(&lights[k]);
      limit(target, &lights[k], &f.now[k]);
    }
    refine(&f);
    for (int k = 0; k < *count; ++k) {
      struct cluster_light light;
      to_light(&f.now[k], &lights[k], &light);
      memcpy(light.rgb, f.rgb_now[k], sizeof light.rgb);
      lights[k] = light;
    }
    *count = cluster_drop_dark(lights, *count);
    correct_flux(target, lights, *count);
  } else {
    result = result_fail(error, RESULT_MEMORY, "out of memory");
  }
  release(&f);
  return result;
}
