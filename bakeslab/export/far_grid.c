/* far_grid.c -
 *  1. Draws directions over the pages' windows, and a little beyond, by Roberts' sequence R2 ("The
 *     unreasonable effectiveness of quasirandom sequences", 2018), and takes their intensities.
 *  2. Begins with planes every 15 degrees and angles every 5, and compares what lies between them
 *     with those intensities. Where that is off, the plane's interval is to blame, or the angle's,
 *     or both: whichever is off by itself.
 *  3. Halves the intervals that are to blame for too many directions, and begins step 2 again. */
#include "export/far_grid.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "base/interval.h"

enum {
  PROBES = 20000,         /* of a page */
  MOST_CANDELA = 1 << 18, /* of a table */
};
static const double first_step[2] = {15, 5},
                    least_step[2] = {15.0 / 1024, 5.0 / 1024}; /* degrees */
static const double blamed_part = 0.01; /* of an interval's directions, that may be off */
/* Beyond each end of a window, degrees: every other direction is drawn from as far as a first step
 * may carry its light. */
static const double margin[2] = {1, 15};
static const double radian = M_PI / 180;

/* A direction between planes and angles. */
struct probe {
  double c, gamma, candela, weight, off;
};

struct lamp {
  const struct far_page *pages;
  int count;
  struct probe *probes; /* owned */
  size_t probe_count;
};

static double intensity(const struct lamp *lamp, double c, double gamma) {
  double across = sin(gamma * radian), sum = 0;
  double direction[3] = {across * cos(c * radian), -cos(gamma * radian), across * sin(c * radian)};
  for (int k = 0; k < lamp->count; ++k) sum += far_page_candela(&lamp->pages[k], direction);
  return sum;
}

static double within(double low, double high, double x) {
  return fmin(fmax(x, low), high);
}

/* Probe number n of a page: even in the angles whose tangents its slopes are. */
static struct probe draw(const struct far_page *page, int n) {
  static const double step[2] = {0.7548776662466927, 0.5698402909980532};
  const double *window = page->view.st_window, most = 89.9 * radian;
  const struct slab *slab = page->slab;
  double slope[2], edge[2], jacobian = 1, d[3], r2 = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double *along = axis == 0 ? slab->u : slab->v;
    double low = atan(window[2 * axis]), high = atan(window[2 * axis + 1]),
           part = 0.5 + n * step[axis];
    double more = margin[n % 2] * radian, from = within(-most, most, low - more);
    double range = within(-most, most, high + more) - from;
    slope[axis] = tan(from + range * (part - floor(part)));
    jacobian *= range * (1 + slope[axis] * slope[axis]);
    r2 += slope[axis] * slope[axis];
    edge[axis] = sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
  }
  for (int c = 0; c < 3; ++c)
    d[c] = slab->normal[c] + slope[0] * slab->u[c] / edge[0] + slope[1] * slab->v[c] / edge[1];
  double turn = atan2(d[2], d[0]) / radian;
  return (struct probe){.c = turn < 0 ? fmin(turn + 360, 360) : turn,
                        .gamma = atan2(hypot(d[0], d[2]), -d[1]) / radian,
                        .weight = jacobian / (r2 * sqrt(r2))};
}

static enum result take_probes(struct lamp *lamp, struct error *error) {
  lamp->probes = calloc((size_t)lamp->count * PROBES, sizeof *lamp->probes);
  if (!lamp->probes) return result_no_memory(error);
  for (int k = 0; k < lamp->count; ++k)
    for (int n = 0; n < PROBES; ++n) {
      struct probe probe = draw(&lamp->pages[k], n);
      probe.candela = intensity(lamp, probe.c, probe.gamma);
      lamp->probes[lamp->probe_count++] = probe;
    }
  return RESULT_OK;
}

/* The interval of ascending values that holds x, and where in it, 0 to 1. */
static int interval(const double *values, int count, double x, double *part) {
  int low = interval_find(values, count, x);
  *part = within(0, 1, (x - values[low]) / (values[low + 1] - values[low]));
  return low;
}

static enum result resize(struct far_grid *grid, struct error *error) {
  free(grid->candela);
  grid->candela =
      calloc((size_t)grid->count[FAR_C] * (size_t)grid->count[FAR_GAMMA], sizeof *grid->candela);
  return grid->candela ? RESULT_OK : result_no_memory(error);
}

/* Values from first to last. */
static enum result even_axis(struct far_grid *grid, int axis, double first, double last,
                             struct error *error) {
  int count = (int)lround((last - first) / first_step[axis]) + 1;
  grid->at[axis] = calloc((size_t)count, sizeof *grid->at[axis]);
  if (!grid->at[axis]) return result_no_memory(error);
  for (int k = 0; k < count; ++k) grid->at[axis][k] = first + k * first_step[axis];
  grid->count[axis] = count;
  return RESULT_OK;
}

/* All planes begin, and end, in one direction. */
static void fill(const struct lamp *lamp, struct far_grid *grid) {
  int angles = grid->count[FAR_GAMMA], planes = grid->count[FAR_C];
  for (int p = 0; p < planes; ++p)
    for (int k = 0; k < angles; ++k) {
      double gamma = grid->at[FAR_GAMMA][k], c = grid->at[FAR_C][p == planes - 1 ? 0 : p];
      double candela = intensity(lamp, gamma == 0 || gamma == 180 ? 0 : c, gamma);
      grid->candela[(size_t)p * (size_t)angles + (size_t)k] = candela;
      grid->peak = fmax(grid->peak, candela);
    }
}

/* Directions that are off by more than allowed, and all lit ones, by interval. */
struct blame {
  double *off[2], *all[2];
};

static void blame_free(struct blame *blame) {
  for (int axis = 0; axis < 2; ++axis) {
    free(blame->off[axis]);
    free(blame->all[axis]);
  }
}

static enum result blame_make(const struct far_grid *grid, struct blame *blame,
                              struct error *error) {
  for (int axis = 0; axis < 2; ++axis) {
    size_t count = (size_t)grid->count[axis];
    blame->off[axis] = calloc(count, sizeof(double));
    blame->all[axis] = calloc(count, sizeof(double));
    if (blame->off[axis] && blame->all[axis]) continue;
    (void)result_no_memory(error);
    return RESULT_MEMORY;
  }
  return RESULT_OK;
}

/* By how much a probe is off where interpolation is along one axis alone. */
static double off_along(const struct lamp *lamp, const struct far_grid *grid,
                        const struct probe *probe, int axis, int cell, double part) {
  double ends[2];
  for (int k = 0; k < 2; ++k) {
    double at = grid->at[axis][cell + k];
    ends[k] = axis == FAR_C ? intensity(lamp, at, probe->gamma) : intensity(lamp, probe->c, at);
  }
  return fabs((1 - part) * ends[0] + part * ends[1] - probe->candela);
}

static void try_probe(const struct lamp *lamp, const struct far_grid *grid, double allowed,
                      struct probe *probe, struct blame *blame) {
  double x, y, along[2];
  int p = interval(grid->at[FAR_C], grid->count[FAR_C], probe->c, &x);
  int k = interval(grid->at[FAR_GAMMA], grid->count[FAR_GAMMA], probe->gamma, &y);
  const double *a = grid->candela + (size_t)p * (size_t)grid->count[FAR_GAMMA] + k;
  const double *b = a + grid->count[FAR_GAMMA];
  double between = (1 - x) * ((1 - y) * a[0] + y * a[1]) + x * ((1 - y) * b[0] + y * b[1]);
  probe->off = -1;
  if (between == 0 && probe->candela == 0) return;
  probe->off = fabs(between - probe->candela);
  blame->all[FAR_C][p] += probe->weight;
  blame->all[FAR_GAMMA][k] += probe->weight;
  if (probe->off <= allowed) return;
  along[FAR_C] = off_along(lamp, grid, probe, FAR_C, p, x);
  along[FAR_GAMMA] = off_along(lamp, grid, probe, FAR_GAMMA, k, y);
  if (along[FAR_C] >= along[FAR_GAMMA] / 2) blame->off[FAR_C][p] += probe->weight;
  if (along[FAR_GAMMA] >= along[FAR_C] / 2) blame->off[FAR_GAMMA][k] += probe->weight;
}

static bool is_blamed(const struct far_grid *grid, const struct blame *blame, int axis, int cell) {
  double step = grid->at[axis][cell + 1] - grid->at[axis][cell];
  return blame->off[axis][cell] > blamed_part * blame->all[axis][cell] &&
         step > 1.5 * least_step[axis];
}

static int count_blamed(const struct far_grid *grid, const struct blame *blame, int axis) {
  int count = 0;
  for (int k = 0; k + 1 < grid->count[axis]; ++k) count += is_blamed(grid, blame, axis, k);
  return count;
}

static enum result halve(struct far_grid *grid, const struct blame *blame, int axis, int more,
                         struct error *error) {
  double *old = grid->at[axis], *new = calloc((size_t)(grid->count[axis] + more), sizeof *new);
  int count = 0;
  if (!new) return result_no_memory(error);
  for (int k = 0; k < grid->count[axis]; ++k) {
    new[count++] = old[k];
    if (k + 1 < grid->count[axis] && is_blamed(grid, blame, axis, k))
      new[count++] = (old[k] + old[k + 1]) / 2;
  }
  free(old);
  grid->at[axis] = new;
  grid->count[axis] = count;
  return RESULT_OK;
}

/* One round: *finer where intervals were halved. */
static enum result refine(struct lamp *lamp, double tolerance, struct far_grid *grid, bool *finer,
                          struct error *error) {
  struct blame blame = {0};
  enum result result = resize(grid, error);
  *finer = false;
  if (result == RESULT_OK) result = blame_make(grid, &blame, error);
  if (result == RESULT_OK) {
    fill(lamp, grid);
    for (size_t n = 0; n < lamp->probe_count; ++n)
      try_probe(lamp, grid, tolerance * grid->peak, &lamp->probes[n], &blame);
    int more[2] = {count_blamed(grid, &blame, FAR_C), count_blamed(grid, &blame, FAR_GAMMA)};
    double next = (double)(grid->count[FAR_C] + more[0]) * (grid->count[FAR_GAMMA] + more[1]);
    *finer = more[0] + more[1] > 0 && next <= MOST_CANDELA;
    if (*finer) result = halve(grid, &blame, FAR_C, more[0], error);
    if (*finer && result == RESULT_OK) result = halve(grid, &blame, FAR_GAMMA, more[1], error);
  }
  blame_free(&blame);
  return result;
}

static int by_error(const void *left, const void *right) {
  double a = ((const struct probe *)left)->off, b = ((const struct probe *)right)->off;
  return (a > b) - (a < b);
}

/* From the probes' last errors. */
static void judge(struct lamp *lamp, double tolerance, struct far_grid *grid) {
  double all = 0, squares = 0, beyond = 0, below = 0;
  qsort(lamp->probes, lamp->probe_count, sizeof *lamp->probes, by_error);
  for (size_t n = 0; n < lamp->probe_count; ++n) {
    const struct probe *probe = &lamp->probes[n];
    if (probe->off < 0) continue;
    all += probe->weight;
    squares += probe->weight * probe->off * probe->off;
    beyond += probe->off > tolerance * grid->peak ? probe->weight : 0;
    grid->most = probe->off / grid->peak;
  }
  for (size_t n = 0; n < lamp->probe_count && below < 0.95 * all; ++n) {
    below += lamp->probes[n].off < 0 ? 0 : lamp->probes[n].weight;
    grid->most95 = fmax(0, lamp->probes[n].off / grid->peak);
  }
  grid->rms = all > 0 ? sqrt(squares / all) / grid->peak : 0;
  grid->beyond = all > 0 ? beyond / all : 0;
}

/* Whether any page sends light up, or down. */
static bool shines(const struct lamp *lamp, double sign) {
  for (int k = 0; k < lamp->count; ++k) {
    const double *n = lamp->pages[k].slab->normal;
    if (sign * n[1] > 1e-6 || fabs(n[1]) < 1 - 1e-6) return true;
  }
  return false;
}

enum result far_grid_make(const struct far_page *pages, int count, double tolerance,
                          struct far_grid *grid, struct error *error) {
  struct lamp lamp = {.pages = pages, .count = count};
  bool up = shines(&lamp, 1), down = shines(&lamp, -1), finer = true;
  *grid = (struct far_grid){0};
  enum result result = take_probes(&lamp, error);
  for (size_t n = 0; n < lamp.probe_count; ++n)
    grid->peak = fmax(grid->peak, lamp.probes[n].candela);
  if (result == RESULT_OK) result = even_axis(grid, FAR_C, 0, 360, error);
  if (result == RESULT_OK) result = even_axis(grid, FAR_GAMMA, down ? 0 : 90, up ? 180 : 90, error);
  while (result == RESULT_OK && finer) result = refine(&lamp, tolerance, grid, &finer, error);
  if (result == RESULT_OK && grid->peak > 0) judge(&lamp, tolerance, grid);
  free(lamp.probes);
  return result;
}

void far_grid_free(struct far_grid *grid) {
  free(grid->at[FAR_C]);
  free(grid->at[FAR_GAMMA]);
  free(grid->candela);
  *grid = (struct far_grid){0};
}

double far_grid_flux(const struct far_grid *grid) {
  const double *c = grid->at[FAR_C], *gamma = grid->at[FAR_GAMMA];
  double sum = 0;
  for (int p = 0; p + 1 < grid->count[FAR_C]; ++p) {
    const double *a = grid->candela + (size_t)p * (size_t)grid->count[FAR_GAMMA];
    const double *b = a + grid->count[FAR_GAMMA];
    for (int k = 0; k + 1 < grid->count[FAR_GAMMA]; ++k) {
      double g0 = gamma[k] * radian, g1 = gamma[k + 1] * radian;
      double from = (a[k] + b[k]) / 2, to = (a[k + 1] + b[k + 1]) / 2;
      sum += (c[p + 1] - c[p]) * radian *
             (from * cos(g0) - to * cos(g1) + (to - from) * (sin(g1) - sin(g0)) / (g1 - g0));
    }
  }
  return sum;
}
