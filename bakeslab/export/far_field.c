/* far_field.c - 1. A page's intensity: where its st plane is at infinity, a direction has the same
 * slope everywhere, and the mean over positions is a slab of one view; else a sum over positions.
 * 2. The grid: steps are halved until interpolation at the middles of its cells is good enough.
 * 3. Its flux: linear in gamma, times sin(gamma), in closed form. */
#include "export/far_field.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "slab/plane.h"
#include "slab/slab_resample.h"

enum { FINEST = 6, LEAST_POINTS = 32 };
static const double most_work = 2e8; /* samples that a grid may cost */
static const double first_plane_step = 15, first_step = 5, radian = M_PI / 180;
static const double told_distance = 4;

/* A page of which intensities are asked. */
struct page {
  const struct slab *slab;
  struct slab mean; /* over positions, or zero; owned */
  double scale;     /* to cd/m2, times the square of a lamp unit in metres */
  int points[2];    /* of the sum over positions */
};

struct lamp {
  struct page *pages; /* owned */
  int count;
};

static double luminance(const double rgb[3]) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double page_intensity(const struct page *page, const double direction[3]) {
  const struct slab *slab = page->slab;
  double edge[2] = {plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V)}, rgb[3], sum = 0;
  double cosine = dot(direction, slab->normal), kappa = slab_kappa(slab);
  if (!(cosine > 0)) return 0;
  double s = dot(direction, slab->u) / edge[0] / cosine;
  double t = dot(direction, slab->v) / edge[1] / cosine;
  const double *window = slab->st_window;
  double reach[2] = {kappa * edge[0] / 2, kappa * edge[1] / 2};
  if (s < window[0] - reach[0] || s > window[1] + reach[0] || t < window[2] - reach[1] ||
      t > window[3] + reach[1])
    return 0;
  if (page->mean.rgb) {
    slab_lookup(&page->mean, 0, 0, s, t, rgb);
    return page->scale * cosine * edge[0] * edge[1] * luminance(rgb);
  }
  const int *n = page->points;
  for (int j = 0; j < n[1]; ++j)
    for (int i = 0; i < n[0]; ++i) {
      double a = ((i + 0.5) / n[0] - 0.5) * edge[0], b = ((j + 0.5) / n[1] - 0.5) * edge[1];
      slab_lookup(slab, a, b, s + kappa * a, t + kappa * b, rgb);
      sum += luminance(rgb);
    }
  return page->scale * cosine * edge[0] * edge[1] * sum / n[0] / n[1];
}

static double intensity(const struct lamp *lamp, double c, double gamma) {
  double across = sin(gamma * radian), sum = 0;
  double direction[3] = {across * cos(c * radian), -cos(gamma * radian), across * sin(c * radian)};
  for (int k = 0; k < lamp->count; ++k) sum += page_intensity(&lamp->pages[k], direction);
  return sum;
}

static enum result open_page(const struct slab *slab, struct page *page, struct error *error) {
  const int one[SLAB_AXES] = {1, 1, slab->samples[SLAB_S], slab->samples[SLAB_T]};
  double unit = strcmp(slab->radiance_unit, "W/(sr m2)") ? 1 : SLAB_WATT_LUMENS;
  *page =
      (struct page){.slab = slab, .scale = unit * slab->metres_per_unit * slab->metres_per_unit};
  for (int k = 0; k < 2; ++k) page->points[k] = (int)fmax(2 * slab->samples[k], LEAST_POINTS);
  return slab_kappa(slab) == 0 ? slab_resample(slab, one, &page->mean, error) : RESULT_OK;
}

/* Whether any page sends light up, or down. */
static bool shines(const struct lamp *lamp, double sign) {
  for (int k = 0; k < lamp->count; ++k) {
    const double *n = lamp->pages[k].slab->normal;
    if (sign * n[1] > 1e-6 || fabs(n[1]) < 1 - 1e-6) return true;
  }
  return false;
}

/* Samples that an intensity costs. */
static double lookups(const struct lamp *lamp) {
  double sum = 0;
  for (int k = 0; k < lamp->count; ++k) {
    const struct page *page = &lamp->pages[k];
    sum += page->mean.rgb ? 1 : (double)page->points[0] * page->points[1];
  }
  return sum;
}

static void free_grid(struct far_field *field) {
  free(field->candela);
  free(field->c);
  free(field->gamma);
  field->candela = field->c = field->gamma = NULL;
}

static double *row(const struct far_field *field, int plane) {
  return field->candela + (size_t)(plane % field->planes) * (size_t)field->angles;
}

static enum result make_grid(const struct lamp *lamp, const int halvings[2],
                             struct far_field *field, struct error *error) {
  bool down = shines(lamp, -1), up = shines(lamp, 1);
  free_grid(field);
  field->plane_step = first_plane_step / (1 << halvings[0]);
  field->step = first_step / (1 << halvings[1]);
  field->planes = (int)lround(360 / field->plane_step);
  field->angles = (int)lround((up && down ? 180 : 90) / field->step) + 1;
  size_t planes = (size_t)field->planes, angles = (size_t)field->angles;
  field->candela = calloc(planes * angles, sizeof *field->candela);
  field->c = calloc(planes, sizeof *field->c);
  field->gamma = calloc(angles, sizeof *field->gamma);
  if (!field->candela || !field->c || !field->gamma) return result_no_memory(error);
  for (int k = 0; k < field->planes; ++k) field->c[k] = k * field->plane_step;
  for (int k = 0; k < field->angles; ++k) field->gamma[k] = (down ? 0 : 90) + k * field->step;
  return RESULT_OK;
}

static void fill(const struct lamp *lamp, struct far_field *field) {
  int last = field->angles - 1;
  field->peak = 0;
  for (int plane = 0; plane < field->planes; ++plane)
    for (int k = 0; k <= last; ++k) {
      double candela = intensity(lamp, field->c[plane], field->gamma[k]);
      row(field, plane)[k] = candela;
      field->peak = fmax(field->peak, candela);
    }
  /* All planes begin, and end, in one direction, where rounding may differ. */
  for (int plane = 1; plane < field->planes; ++plane) {
    if (field->gamma[0] == 0) row(field, plane)[0] = row(field, 0)[0];
    if (field->gamma[last] > 179.9) row(field, plane)[last] = row(field, 0)[last];
  }
}

static double square(double x) {
  return x * x;
}

/* Sets the flux and the error, and the squared errors between planes and between angles. Returns
 * the number of cells with light. */
static double judge(const struct lamp *lamp, struct far_field *field, double apart[2]) {
  double off = 0, all = 0, lit = 0, h = field->step * radian;
  field->lumens = apart[0] = apart[1] = 0;
  for (int plane = 0; plane < field->planes; ++plane) {
    const double *a = row(field, plane), *b = row(field, plane + 1);
    for (int k = 0; k + 1 < field->angles; ++k) {
      double c = field->c[plane], gamma = field->gamma[k], g0 = gamma * radian;
      double c1 = c + field->plane_step / 2, gamma1 = gamma + field->step / 2;
      double exact = intensity(lamp, c1, gamma1), between = (a[k] + a[k + 1] + b[k] + b[k + 1]) / 4;
      field->lumens += field->plane_step * radian *
                       (a[k] * cos(g0) - a[k + 1] * cos(g0 + h) +
                        (a[k + 1] - a[k]) * (sin(g0 + h) - sin(g0)) / h);
      if (exact == 0 && between == 0) continue;
      double weight = sin(g0 + h / 2) * fmax(exact, between); /* errors count where the light is */
      off += weight * square(exact - between);
      apart[0] += weight * square(intensity(lamp, c1, gamma) - (a[k] + b[k]) / 2);
      apart[1] += weight * square(intensity(lamp, c, gamma1) - (a[k] + a[k + 1]) / 2);
      all += weight;
      ++lit;
    }
  }
  field->error = all > 0 && field->peak > 0 ? sqrt(off / all) / field->peak : 0;
  return lit;
}

/* One plane does for a lamp that is the same in all of them. */
static void join_planes(struct far_field *field) {
  for (int plane = 1; plane < field->planes; ++plane)
    for (int k = 0; k < field->angles; ++k)
      if (fabs(row(field, plane)[k] - row(field, 0)[k]) > 1e-6 * field->peak) return;
  field->planes = 1;
}

static bool dark(const struct far_field *field, int plane, int angle) {
  for (int p = plane < 0 ? 0 : plane; p <= (plane < 0 ? field->planes - 1 : plane); ++p)
    for (int k = angle < 0 ? 0 : angle; k <= (angle < 0 ? field->angles - 1 : angle); ++k)
      if (row(field, p)[k] != 0) return false;
  return true;
}

/* Leaves out what interpolation between dark neighbours gives, but for the first and last. */
static void drop_dark_planes(struct far_field *field) {
  int kept = 0;
  bool before = true, here = dark(field, 0, -1);
  for (int p = 0; p < field->planes; ++p) {
    bool after = p + 1 < field->planes && dark(field, p + 1, -1);
    if (p == 0 || p + 1 == field->planes || !(before && here && after)) {
      field->c[kept] = field->c[p];
      memmove(row(field, kept++), row(field, p), (size_t)field->angles * sizeof(double));
    }
    before = here;
    here = after;
  }
  if (kept < field->planes) field->plane_step = 0;
  field->planes = kept;
}

static void drop_dark_angles(struct far_field *field) {
  int kept = 0, angles = field->angles;
  bool before = true, here = dark(field, -1, 0);
  for (int k = 0; k < angles; ++k) {
    bool after = k + 1 < angles && dark(field, -1, k + 1);
    if (k == 0 || k + 1 == angles || !(before && here && after)) {
      field->gamma[kept] = field->gamma[k];
      for (int p = 0; p < field->planes; ++p) row(field, p)[kept] = row(field, p)[k];
      ++kept;
    }
    before = here;
    here = after;
  }
  if (kept == angles) return;
  field->step = 0;
  for (int p = 1; p < field->planes; ++p)
    memmove(field->candela + (size_t)p * (size_t)kept, row(field, p),
            (size_t)kept * sizeof(double));
  field->angles = kept;
}

static void as_point(const void *of, int unused, const double at[3], double rgb[3]) {
  const struct page *page = of;
  const struct slab *slab = page->slab;
  double direction[3], r2 = dot(at, at), r = sqrt(r2);
  (void)unused;
  for (int c = 0; c < 3; ++c)
    direction[c] = (at[0] * slab->u[c] / plane_edge(slab, SLAB_U) +
                    at[1] * slab->v[c] / plane_edge(slab, SLAB_V) + at[2] * slab->normal[c]) /
                   r;
  rgb[0] = rgb[1] = rgb[2] = page_intensity(page, direction) / page->scale * at[2] / r / r2;
}

/* The largest of the pages', of their luminance. */
static enum result find_loss(const struct lamp *lamp, struct far_field *field,
                             struct error *error) {
  for (int k = 0; k < lamp->count; ++k) {
    struct page page = lamp->pages[k];
    struct slab grey = {0};
    double loss;
    enum result result = slab_copy_geometry(page.slab, &grey, error);
    if (result == RESULT_OK) result = slab_alloc(&grey, error);
    for (size_t i = 0, end = result == RESULT_OK ? slab_sample_count(&grey) : 0; i < end; ++i)
      for (int c = 0; c < 3; ++c)
        grey.rgb[3 * i + (size_t)c] = (float)slab_luminance(page.slab->rgb + 3 * i);
    if (result == RESULT_OK) {
      plane_errors(&grey, told_distance * plane_width(&grey), 1, as_point, &page, 1, &loss);
      field->loss = fmax(field->loss, loss);
    }
    slab_free(&grey);
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}

static enum result measure(const struct lamp *lamp, struct far_field *field, struct error *error) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (int k = 0; k < lamp->count; ++k) {
    const struct slab *slab = lamp->pages[k].slab;
    double flux[3], metres = slab->metres_per_unit;
    enum result result = slab_flux(slab, flux, error);
    if (result != RESULT_OK) return result;
    field->flux += lamp->pages[k].scale * luminance(flux);
    for (int c = 0; c < 3; ++c) {
      double half = (fabs(slab->u[c]) + fabs(slab->v[c])) / 2;
      low[c] = fmin(low[c], metres * (slab->center[c] - half));
      high[c] = fmax(high[c], metres * (slab->center[c] + half));
    }
  }
  for (int c = 0; c < 3; ++c) field->size[c] = high[c] - low[c];
  return find_loss(lamp, field, error);
}

/* Halves the steps until they are good enough, or gain little: where light ends at an edge, the
 * error falls by the root of the step at best. Those of planes or angles alone where the others err
 * less than half as much. */
static enum result find_grid(const struct lamp *lamp, double tolerance, struct far_field *field,
                             struct error *error) {
  static const double gains_little = 0.65;
  int halvings[2] = {0, 0};
  for (double before = INFINITY;; before = field->error) {
    double apart[2];
    enum result result = make_grid(lamp, halvings, field, error);
    if (result != RESULT_OK) return result;
    fill(lamp, field);
    double work = 16 * judge(lamp, field, apart) * lookups(lamp); /* of the next grid */
    bool good = field->error <= tolerance &&
                fabs(field->lumens - field->flux) <= tolerance / 5 * fabs(field->flux);
    bool finer[2];
    for (int k = 0; k < 2; ++k) finer[k] = halvings[k] < FINEST && apart[k] >= apart[1 - k] / 4;
    bool stuck = halvings[0] + halvings[1] > FINEST && field->error > gains_little * before;
    if (good || stuck || work > most_work || !(finer[0] || finer[1])) return RESULT_OK;
    for (int k = 0; k < 2; ++k) halvings[k] += finer[k];
  }
}

enum result far_field_make(const struct slab *slabs, int count, double tolerance,
                           struct far_field *field, struct error *error) {
  struct lamp lamp = {.pages = calloc((size_t)count, sizeof *lamp.pages)};
  enum result result = lamp.pages ? RESULT_OK : result_no_memory(error);
  *field = (struct far_field){0};
  for (int k = 0; k < count && result == RESULT_OK; ++k)
    if (slab_is_lit(&slabs[k])) result = open_page(&slabs[k], &lamp.pages[lamp.count++], error);
  if (result == RESULT_OK && !lamp.count)
    result = result_fail(error, RESULT_BAD, "all radiance is zero: the lamp gives no light");
  if (result == RESULT_OK) result = measure(&lamp, field, error);
  if (result == RESULT_OK) result = find_grid(&lamp, tolerance, field, error);
  if (result == RESULT_OK) {
    join_planes(field);
    drop_dark_planes(field);
    drop_dark_angles(field);
  }
  for (int k = 0; k < lamp.count; ++k) slab_free(&lamp.pages[k].mean);
  free(lamp.pages);
  return result;
}

void far_field_free(struct far_field *field) {
  free_grid(field);
  *field = (struct far_field){0};
}
