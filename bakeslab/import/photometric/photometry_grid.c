/* photometry_grid.c -
 *  1. A cell's mean is a sum over points of it, nearer to each other than half the table's steps:
 *     means keep the flux, samples at the middle do not. Of round bodies, the intensity is a mean,
 *     and the area that it is divided by a sample, since it has a cusp.
 *  2. The far field towards d is the sum over pages of area, cosine, share and interpolated mean.
 *  3. The pages that are off by most get cells finer by half, until the far field is right within
 *     the tolerance.
 *  4. One factor makes the flux the table's. */
#include "import/photometric/photometry_grid.h"

#include <math.h>
#include <stdlib.h>

#include <string.h>

#include "slab/slab.h"

enum {
  LEAST = 24,       /* cells along the widest window, to begin with */
  MOST_FIRST = 400, /* of round bodies, to begin with */
  MOST = 1024,
  MOST_SAMPLES = 1 << 23,  /* of all pages, with as few positions as may be */
  CHEAP_SAMPLES = 1 << 20, /* and where finer cells do not help: tables may jump */
  MOST_POINTS = 24,        /* of a cell, along each axis */
  CUSP = 4,                /* the same, where a cusp is */
  SPHERE = 4000,           /* directions of the measure of error */
  TABLE = 4000             /* and of the table's own, at most */
};

static const double round_cell = 0.2, along_cell = 0.29, growth_cell = 0.4;
static const double most_factor = 0.05;
static const double still_better = 0.9; /* of the error before, for cells that are not cheap */

void photometry_grid_free(struct photometry_grid *grid) {
  for (int n = 0; n < BODY_FACES; ++n) {
    free(grid->page[n].mean);
    free(grid->page[n].share);
  }
  *grid = (struct photometry_grid){0};
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
 * the body makes of it in the middle. */
static double cell_mean(const struct photometry *lamp, const struct photometry_pages *pages,
                        int page, const double low[2], const double step[2], double angle) {
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
      sum +=
          weight * (even ? photometry_radiance(lamp, pages, page, d) : photometry_candela(lamp, d));
      weights += weight;
    }
  if (even) return sum / weights;
  photometry_direction(pages, page, middle[0], middle[1], d);
  return sum / weights * photometry_gain(pages, page, d);
}

/* The part of a page that sends light in a direction. */
static double page_share(const struct photometry_pages *pages, int page, double s, double t) {
  const struct photometry_face *face = &pages->body.face[pages->page[page].face];
  double d[3];
  if (pages->body.shape == PHOTOMETRY_BOX) return 1;
  photometry_direction(pages, page, s, t, d);
  return photometry_face_area(&pages->body, pages->page[page].face, d) /
         (face->size[0] * face->size[1] * dot(d, face->normal));
}

static enum result take_cells(const struct photometry *lamp, const struct photometry_pages *pages,
                              int page, const int n[2], struct photometry_cells *cells,
                              struct error *error) {
  const double *window = pages->page[page].window;
  double step[2] = {(window[1] - window[0]) / n[0], (window[3] - window[2]) / n[1]};
  double angle = point_step(lamp);
  size_t count = (size_t)n[0] * (size_t)n[1];
  free(cells->mean);
  free(cells->share);
  cells->mean = calloc(count, sizeof *cells->mean);
  cells->share = calloc(count, sizeof *cells->share);
  if (!cells->mean || !cells->share) return result_no_memory(error);
  cells->n[0] = n[0];
  cells->n[1] = n[1];
  for (int l = 0; l < n[1]; ++l)
    for (int k = 0; k < n[0]; ++k) {
      double low[2] = {window[0] + k * step[0], window[2] + l * step[1]};
      size_t at = (size_t)l * (size_t)n[0] + (size_t)k;
      cells->mean[at] = cell_mean(lamp, pages, page, low, step, angle);
      cells->share[at] = page_share(pages, page, low[0] + step[0] / 2, low[1] + step[1] / 2);
    }
  return RESULT_OK;
}

/* Where x lies between the middles of n cells of [low, high]: constant beyond the outermost. */
static int between(double x, double low, double high, int n, double *part) {
  double at = fmin(fmax((x - low) / (high - low) * n - 0.5, 0), n - 1);
  int cell = at < n - 1 ? (int)at : n > 1 ? n - 2 : 0;
  *part = n > 1 ? at - cell : 0;
  return cell;
}

/* Intensity of a page's slab towards a direction, seen from afar, and what it should be. */
static void page_candela(const struct photometry *lamp, const struct photometry_pages *pages,
                         int page, const struct photometry_cells *cells, const double d[3],
                         double *made, double *right) {
  const struct photometry_face *face = &pages->body.face[pages->page[page].face];
  const double *window = pages->page[page].window;
  double st[2], part[2], value = 0, area;
  *made = *right = 0;
  if (!photometry_slopes(pages, page, d, st) || st[0] < window[0] || st[0] > window[1] ||
      st[1] < window[2] || st[1] > window[3])
    return;
  int k = between(st[0], window[0], window[1], cells->n[0], &part[0]);
  int l = between(st[1], window[2], window[3], cells->n[1], &part[1]);
  for (int corner = 0; corner < 4; ++corner) {
    int right_of = corner & 1, up = corner >> 1;
    double weight = (right_of ? part[0] : 1 - part[0]) * (up ? part[1] : 1 - part[1]);
    if (!(weight > 0)) continue;
    size_t at = (size_t)(l + up) * (size_t)cells->n[0] + (size_t)(k + right_of);
    value += weight * cells->mean[at] * cells->share[at];
  }
  area = face->size[0] * face->size[1] * dot(d, face->normal);
  *made = value * area;
  *right = photometry_radiance(lamp, pages, page, d) * page_share(pages, page, st[0], st[1]) * area;
}

/* Directions all over the sphere, alike near each other (a spiral of the golden angle). */
static void spiral(int n, double d[3]) {
  double y = 1 - 2 * (n + 0.5) / SPHERE, turn = n * M_PI * (3 - sqrt(5)), r = sqrt(1 - y * y);
  d[0] = r * cos(turn);
  d[1] = y;
  d[2] = r * sin(turn);
}

static int by_size(const void *left, const void *right) {
  double a = *(const double *)left, b = *(const double *)right;
  return (a > b) - (a < b);
}

/* The direction of the measure: SPHERE of the spiral, then the table's. */
static size_t directions(const struct photometry *lamp, size_t *stride) {
  size_t count = (size_t)lamp->planes * (size_t)lamp->rows;
  *stride = (count + TABLE - 1) / TABLE;
  return SPHERE + (count + *stride - 1) / *stride;
}

/* Fills the grid's error, and own[page]: by how much each page is off at most. */
static enum result measure(const struct photometry *lamp, const struct photometry_pages *pages,
                           struct photometry_grid *grid, double own[BODY_FACES],
                           struct error *error) {
  double *off = malloc(SPHERE * sizeof *off), peak = 0, sum = 0, squares = 0, d[3];
  if (!off) return result_no_memory(error);
  size_t stride, count = directions(lamp, &stride), all = (size_t)lamp->planes * (size_t)lamp->rows;
  for (size_t n = 0; n < all; ++n) peak = fmax(peak, fabs(lamp->candela[n]));
  for (int p = 0; p < pages->count; ++p) own[p] = 0;
  grid->error.most = 0;
  for (size_t n = 0; n < count; ++n) {
    double total = 0, made, right;
    if (n < SPHERE)
      spiral((int)n, d);
    else
      photometry_table_direction(lamp, (n - SPHERE) * stride, d);
    for (int p = 0; p < pages->count; ++p) {
      page_candela(lamp, pages, p, &grid->page[p], d, &made, &right);
      total += made;
      own[p] = fmax(own[p], fabs(made - right) / peak);
    }
    double candela = photometry_candela(lamp, d), difference = fabs(total - candela) / peak;
    grid->error.most = fmax(grid->error.most, difference);
    if (n >= SPHERE) continue;
    off[n] = difference;
    sum += difference * difference;
    squares += candela * candela / (peak * peak);
  }
  qsort(off, SPHERE, sizeof *off, by_size);
  grid->error.most95 = off[SPHERE * 95 / 100];
  grid->error.rms = squares > 0 ? sqrt(sum / squares) : 0;
  free(off);
  return RESULT_OK;
}

/* The flux of the page as a slab. */
static enum result page_flux(const struct photometry_pages *pages, int page,
                             const struct photometry_cells *cells, double *flux,
                             struct error *error) {
  const struct photometry_face *face = &pages->body.face[pages->page[page].face];
  struct slab slab = slab_default();
  double rgb[3] = {0};
  memcpy(slab.u, face->u, sizeof slab.u);
  memcpy(slab.v, face->v, sizeof slab.v);
  memcpy(slab.normal, face->normal, sizeof slab.normal);
  memcpy(slab.st_window, pages->page[page].window, sizeof slab.st_window);
  slab.samples[SLAB_S] = cells->n[0];
  slab.samples[SLAB_T] = cells->n[1];
  enum result result = slab_alloc(&slab, error);
  for (size_t n = 0; result == RESULT_OK && n < slab_sample_count(&slab); ++n)
    slab.rgb[3 * n] = (float)(cells->mean[n] * cells->share[n]);
  if (result == RESULT_OK) result = slab_flux(&slab, rgb, error);
  *flux = rgb[0];
  slab_free(&slab);
  return result;
}

/* Makes the flux the table's. */
static enum result fit_flux(const struct photometry *lamp, const struct photometry_pages *pages,
                            struct photometry_grid *grid, struct error *error) {
  double flux = 0, one, should = photometry_flux(lamp);
  enum result result = RESULT_OK;
  for (int p = 0; p < pages->count && result == RESULT_OK; ++p) {
    result = page_flux(pages, p, &grid->page[p], &one, error);
    flux += one;
  }
  if (result != RESULT_OK) return result;
  double factor = should / flux;
  grid->error.factor = fabs(factor - 1) <= most_factor ? factor : 1;
  for (int p = 0; p < pages->count; ++p)
    for (int n = 0; n < grid->page[p].n[0] * grid->page[p].n[1]; ++n)
      grid->page[p].mean[n] *= grid->error.factor;
  return RESULT_OK;
}

/* The lengths of a page's window, in units of slope; along the side of a cylinder, where positions
 * differ little, cells may be longer, and lengths count less. Returns the longer. */
static double window_lengths(const struct photometry_pages *pages, int page, double length[2]) {
  const struct photometry_body *body = &pages->body;
  const double *window = pages->page[page].window;
  for (int axis = 0; axis < 2; ++axis) {
    length[axis] = window[2 * axis + 1] - window[2 * axis];
    if (photometry_runs_along(body, pages->page[page].face, axis))
      length[axis] *= round_cell / along_cell;
  }
  return fmax(length[0], length[1]);
}

/* Cells along both axes of a page, `across` of them on the longer one. */
static void count_cells(const struct photometry_pages *pages, int page, int across, int n[2]) {
  double length[2], longer = window_lengths(pages, page, length);
  for (int axis = 0; axis < 2; ++axis) /* odd: one has the normal in its middle */
    n[axis] = (int)fmax(8, ceil(across * length[axis] / longer)) | 1;
}

/* The pages that are off by most get finer cells, half as many again; false where that would be
 * too many. */
static bool refine(const struct photometry_pages *pages, const double own[BODY_FACES],
                   double tolerance, double most_samples, int across[BODY_FACES],
                   bool changed[BODY_FACES]) {
  int least = photometry_is_even(&pages->body) ? PHOTOMETRY_LEAST_EVEN : PHOTOMETRY_LEAST_ROUND;
  double samples = 0;
  double most = 0;
  bool any = false;
  for (int p = 0; p < pages->count; ++p) most = fmax(most, own[p]);
  for (int p = 0; p < pages->count; ++p) {
    int n[2], uv[2];
    changed[p] = (own[p] >= most / 2 || own[p] > tolerance) && across[p] < MOST;
    if (changed[p]) across[p] += across[p] / 2;
    any = any || changed[p];
    count_cells(pages, p, across[p], n);
    photometry_positions(pages, p, least, uv);
    samples += (double)uv[0] * uv[1] * n[0] * n[1];
  }
  return any && samples <= most_samples;
}

/* The changed pages' cells, then what comes of all. */
static enum result take(const struct photometry *lamp, const struct photometry_pages *pages,
                        const int across[BODY_FACES], const int st[2],
                        const bool changed[BODY_FACES], struct photometry_grid *grid,
                        double own[BODY_FACES], struct error *error) {
  enum result result = RESULT_OK;
  for (int p = 0; p < pages->count && result == RESULT_OK; ++p) {
    int n[2] = {st[0], st[1]};
    if (!changed[p]) continue;
    if (!(st[0] > 0)) count_cells(pages, p, across[p], n);
    result = take_cells(lamp, pages, p, n, &grid->page[p], error);
  }
  if (result == RESULT_OK) result = measure(lamp, pages, grid, own, error);
  return result;
}

/* Whether the far field is right, or as right as cells make it: light may lie beyond the windows.
 */
static bool is_done(const struct photometry_grid_error *error, const double own[BODY_FACES],
                    int pages, double tolerance) {
  double most = 0;
  for (int p = 0; p < pages; ++p) most = fmax(most, own[p]);
  return most <= tolerance || (error->most95 <= tolerance && error->most <= 2.5 * tolerance);
}

/* By how much the body's area grows with the slope from a page's normal on, per slope; the larger
 * of both axes'. */
static double growth_of(const struct photometry_pages *pages, int page) {
  const double slope = 0.01;
  double normal[3], along[3], most = 0;
  photometry_direction(pages, page, 0, 0, normal);
  for (int axis = 0; axis < 2; ++axis) {
    photometry_direction(pages, page, axis == 0 ? slope : 0, axis == 0 ? 0 : slope, along);
    double ratio = photometry_area(&pages->body, along) / photometry_area(&pages->body, normal);
    most = fmax(most, (ratio - 1) / slope);
  }
  return most;
}

/* Interpolation over cells of which each lets the area grow by growth_cell is off by a thirtieth
 * or less. Where positions differ, their directions tell near by what is seen: cells of round
 * bodies have slopes of round_cell at most. */
static int first_across(const struct photometry_pages *pages, int page) {
  double length[2], longer = window_lengths(pages, page, length);
  if (photometry_is_even(&pages->body)) return LEAST;
  double cell = fmin(round_cell, growth_cell / growth_of(pages, page));
  return (int)fmin(fmax(LEAST, longer / cell), MOST_FIRST);
}

enum result photometry_grid(const struct photometry *lamp, const struct photometry_pages *pages,
                            const int st[2], double tolerance, struct photometry_grid *grid,
                            struct error *error) {
  int across[BODY_FACES];
  bool changed[BODY_FACES];
  double own[BODY_FACES] = {0}, before = INFINITY;
  *grid = (struct photometry_grid){0};
  for (int p = 0; p < pages->count; ++p) across[p] = first_across(pages, p), changed[p] = true;
  enum result result = take(lamp, pages, across, st, changed, grid, own, error);
  while (result == RESULT_OK && !(st[0] > 0) &&
         !is_done(&grid->error, own, pages->count, tolerance)) {
    bool better = grid->error.most95 > tolerance || grid->error.most <= still_better * before;
    if (!refine(pages, own, tolerance, better ? MOST_SAMPLES : CHEAP_SAMPLES, across, changed))
      break;
    before = grid->error.most;
    result = take(lamp, pages, across, st, changed, grid, own, error);
  }
  if (result == RESULT_OK) result = fit_flux(lamp, pages, grid, error);
  if (result == RESULT_OK) result = measure(lamp, pages, grid, own, error);
  return result;
}
