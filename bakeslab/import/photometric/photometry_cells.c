/* photometry_cells.c -
 *  1. A cell's mean is a sum over points of it, nearer to each other than half the table's steps:
 *     means keep the flux, samples at the middle do not. Of round bodies, the intensity is a mean,
 *     and the area that it is divided by a sample, since it has a cusp.
 *  2. Of other bodies, means are changed so that interpolation errs to both sides alike. */
#include "import/photometric/photometry_cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  MOST_POINTS = 12, /* of a cell, along each axis */
  CUSP = 4          /* the same, where a cusp is */
};

void photometry_cells_free(struct photometry_cells *cells) {
  free(cells->mean);
  free(cells->share);
  *cells = (struct photometry_cells){0};
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The least step of ascending values; 180 for one. */
static double least_step(const double *values, int count) {
  double least = 180;
  for (int k = 1; k < count; ++k) least = fmin(least, values[k] - values[k - 1]);
  return least;
}

/* The angle between points of a cell, radians. */
static double point_step(const struct photometry *lamp) {
  double step = fmin(least_step(lamp->plane, lamp->planes), least_step(lamp->row, lamp->rows));
  return fmax(step, 0.25) * M_PI / 180 / 2;
}

/* Where a direction is a page's normal, the projected area of a body with sides has a cusp, and so
 * has either the radiance or the intensity. Only samples in the middle of cells there keep it when
 * they are interpolated; but what neighbours leave to the page is a mean there, too. */
static double cusp_radiance(const struct photometry *lamp, const struct photometry_pages *pages,
                            int page, const double middle[2], const double step[2]) {
  double d[3], kept = 0;
  for (int k = 0; k < CUSP * CUSP; ++k) {
    double s = middle[0] + ((k % CUSP + 0.5) / CUSP - 0.5) * step[0];
    double t = middle[1] + ((k / CUSP + 0.5) / CUSP - 0.5) * step[1];
    photometry_direction(pages, page, s, t, d);
    kept += photometry_gain(pages, page, d) * photometry_area(&pages->body, d) / (CUSP * CUSP);
  }
  photometry_direction(pages, page, middle[0], middle[1], d);
  return kept * photometry_candela(lamp, d) / photometry_area(&pages->body, d);
}

/* The middle of the cell lies where one of the slopes is 0. */
static bool holds_normal(const double middle[2], const double step[2]) {
  return fabs(middle[0]) < 1e-6 * step[0] || fabs(middle[1]) < 1e-6 * step[1];
}

/* The radiance of a cell: the mean intensity, weighted by cos^4 as the flux is in slopes, and what
 * the body makes of it in the middle. `range` is widened by what was averaged. */
static double cell_mean(const struct photometry *lamp, const struct photometry_pages *pages,
                        int page, const double low[2], const double step[2], double angle,
                        double range[2]) {
  double middle[2] = {low[0] + step[0] / 2, low[1] + step[1] / 2}, sum = 0, weights = 0;
  double near[2] = {fmax(0, fabs(middle[0]) - step[0] / 2), fmax(0, fabs(middle[1]) - step[1] / 2)};
  double wide = 1 / sqrt(1 + near[0] * near[0] + near[1] * near[1]), d[3];
  int n[2];
  bool even = photometry_is_even(&pages->body);
  if (!even && holds_normal(middle, step)) return cusp_radiance(lamp, pages, page, middle, step);
  for (int axis = 0; axis < 2; ++axis)
    n[axis] = (int)fmin(fmax(ceil(step[axis] * wide / angle), 2), MOST_POINTS);
  for (int j = 0; j < n[1]; ++j)
    for (int i = 0; i < n[0]; ++i) {
      double s = low[0] + (i + 0.5) / n[0] * step[0], t = low[1] + (j + 0.5) / n[1] * step[1];
      double weight = 1 / pow(1 + s * s + t * t, 2);
      photometry_direction(pages, page, s, t, d);
      double value = even ? photometry_radiance(lamp, pages, page, d) : photometry_candela(lamp, d);
      range[0] = fmin(range[0], value);
      range[1] = fmax(range[1], value);
      sum += weight * value;
      weights += weight;
    }
  if (even) return sum / weights;
  photometry_direction(pages, page, middle[0], middle[1], d);
  return sum / weights * photometry_gain(pages, page, d);
}

/* The least and the largest of a cell and its neighbours. */
static void range_around(const int n[2], const double (*range)[2], int k, int l, double out[2]) {
  out[0] = INFINITY;
  out[1] = -INFINITY;
  for (int y = (int)fmax(0, l - 1); y <= l + 1 && y < n[1]; ++y)
    for (int x = (int)fmax(0, k - 1); x <= k + 1 && x < n[0]; ++x) {
      const double *of = range[(size_t)y * (size_t)n[0] + (size_t)x];
      out[0] = fmin(out[0], of[0]);
      out[1] = fmax(out[1], of[1]);
    }
}

/* Where a function bends, the mean of a cell lies a 24th of the means' second difference off its
 * middle, and interpolation halfway between two means a sixth, to the same side. An eighth less is
 * the best fit of a parabola, in the sense of least squares, and the sum stays. No cell leaves the
 * range of what it and its neighbours average, so that nothing rings beside an edge. */
static enum result balance(struct photometry_cells *cells, const double (*range)[2],
                           struct error *error) {
  const int *n = cells->n;
  size_t count = (size_t)n[0] * (size_t)n[1], row = (size_t)n[0];
  double *mean = malloc(count * sizeof *mean), around[2];
  if (!mean) return result_no_memory(error);
  memcpy(mean, cells->mean, count * sizeof *mean);
  for (int l = 0; l < n[1]; ++l)
    for (int k = 0; k < n[0]; ++k) {
      const double *at = mean + (size_t)l * row + k;
      double bend = 0;
      if (k > 0 && k + 1 < n[0]) bend += at[-1] - 2 * at[0] + at[1];
      if (l > 0 && l + 1 < n[1]) bend += *(at - row) - 2 * at[0] + at[row];
      range_around(n, range, k, l, around);
      cells->mean[(size_t)l * row + (size_t)k] = fmin(fmax(at[0] - bend / 8, around[0]), around[1]);
    }
  free(mean);
  return RESULT_OK;
}

double photometry_share(const struct photometry_pages *pages, int page, double s, double t) {
  const struct photometry_face *face = &pages->body.face[pages->page[page].face];
  double d[3];
  if (pages->body.shape == PHOTOMETRY_BOX) return 1;
  photometry_direction(pages, page, s, t, d);
  return photometry_face_area(&pages->body, pages->page[page].face, d) /
         (face->size[0] * face->size[1] * dot(d, face->normal));
}

enum result photometry_cells_take(const struct photometry *lamp,
                                  const struct photometry_pages *pages, int page, const int n[2],
                                  struct photometry_cells *cells, struct error *error) {
  const double *window = pages->page[page].window;
  double step[2] = {(window[1] - window[0]) / n[0], (window[3] - window[2]) / n[1]};
  double angle = point_step(lamp), (*range)[2];
  size_t count = (size_t)n[0] * (size_t)n[1];
  enum result result = RESULT_OK;
  photometry_cells_free(cells);
  cells->mean = calloc(count, sizeof *cells->mean);
  cells->share = calloc(count, sizeof *cells->share);
  range = malloc(count * sizeof *range);
  if (!cells->mean || !cells->share || !range) {
    free(range);
    return result_no_memory(error);
  }
  cells->n[0] = n[0];
  cells->n[1] = n[1];
  for (int l = 0; l < n[1]; ++l)
    for (int k = 0; k < n[0]; ++k) {
      double low[2] = {window[0] + k * step[0], window[2] + l * step[1]};
      size_t at = (size_t)l * (size_t)n[0] + (size_t)k;
      range[at][0] = INFINITY;
      range[at][1] = -INFINITY;
      cells->mean[at] = cell_mean(lamp, pages, page, low, step, angle, range[at]);
      cells->share[at] = photometry_share(pages, page, low[0] + step[0] / 2, low[1] + step[1] / 2);
    }
  if (photometry_is_even(&pages->body)) result = balance(cells, range, error);
  free(range);
  return result;
}
