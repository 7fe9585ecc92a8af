/* photometry_grid.c -
 *  1. Takes the pages' cells (photometry_cells.h).
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
  SPHERE = 4000,           /* directions of the measure of error, where it is light */
  MOST_SPHERE = 1 << 16,   /* and of those with the dark ones */
  TABLE = 4000             /* and of the table's own, at most */
};

static const double round_cell = 0.2, along_cell = 0.29, growth_cell = 0.4;
static const double most_factor = 0.05;
/* Cells that are not cheap must help: directions beyond the tolerance are more than a part of all,
 * or the largest error is near to it and still falls. */
static const double most_beyond = 0.005, near_enough = 4, still_better = 0.9;
/* Cells are fine where the far field errs by so much of the tolerance: the rest is for light cut
 * off at windows. */
static const double cells_part = 0.4;

void photometry_grid_free(struct photometry_grid *grid) {
  for (int n = 0; n < BODY_FACES; ++n) photometry_cells_free(&grid->page[n]);
  *grid = (struct photometry_grid){0};
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
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
  *right = photometry_radiance(lamp, pages, page, d) * photometry_share(pages, page, st[0], st[1]) *
           area;
}

/* Direction n of count all over the sphere, alike near each other (a spiral of the golden angle).
 */
static void spiral(int n, int count, double d[3]) {
  double y = 1 - 2 * (n + 0.5) / count, turn = n * M_PI * (3 - sqrt(5)), r = sqrt(1 - y * y);
  d[0] = r * cos(turn);
  d[1] = y;
  d[2] = r * sin(turn);
}

/* As many directions as have SPHERE among them where it is light. */
static int sphere_of(const struct photometry *lamp) {
  double d[3];
  int lit = 0;
  for (int n = 0; n < SPHERE; ++n) {
    spiral(n, SPHERE, d);
    lit += photometry_candela(lamp, d) != 0;
  }
  return (int)fmin(MOST_SPHERE, SPHERE * (double)SPHERE / fmax(1, lit));
}

static int by_size(const void *left, const void *right) {
  double a = *(const double *)left, b = *(const double *)right;
  return (a > b) - (a < b);
}

/* Intensity of all pages, and own[page]: by how much a page is off at most. */
static double candela_of(const struct photometry *lamp, const struct photometry_pages *pages,
                         const struct photometry_grid *grid, const double d[3],
                         double own[BODY_FACES]) {
  double total = 0, made, right;
  for (int p = 0; p < pages->count; ++p) {
    page_candela(lamp, pages, p, &grid->page[p], d, &made, &right);
    total += made;
    own[p] = fmax(own[p], fabs(made - right));
  }
  return total;
}

/* In the table's own directions, which a sphere's may miss. */
static double most_in_table(const struct photometry *lamp, const struct photometry_pages *pages,
                            const struct photometry_grid *grid, double own[BODY_FACES]) {
  size_t count = (size_t)lamp->planes * (size_t)lamp->rows, stride = (count + TABLE - 1) / TABLE;
  double most = 0, d[3];
  for (size_t n = 0; n < count; n += stride) {
    photometry_table_direction(lamp, n, d);
    double made = candela_of(lamp, pages, grid, d, own);
    most = fmax(most, fabs(made - photometry_candela(lamp, d)));
  }
  return most;
}

static double largest(const struct photometry *lamp) {
  size_t count = (size_t)lamp->planes * (size_t)lamp->rows;
  double peak = 0;
  for (size_t n = 0; n < count; ++n) peak = fmax(peak, fabs(lamp->candela[n]));
  return peak;
}

/* Fills the grid's error, and own[page], over the peak. */
static enum result measure(const struct photometry *lamp, const struct photometry_pages *pages,
                           double tolerance, struct photometry_grid *grid, double own[BODY_FACES],
                           struct error *error) {
  int sphere = sphere_of(lamp), lit = 0, beyond = 0;
  double *off = malloc((size_t)sphere * sizeof *off), sum = 0, squares = 0, d[3];
  if (!off) return result_no_memory(error);
  double peak = largest(lamp);
  for (int p = 0; p < BODY_FACES; ++p) own[p] = 0;
  double most = most_in_table(lamp, pages, grid, own);
  for (int n = 0; n < sphere; ++n) {
    spiral(n, sphere, d);
    double candela = photometry_candela(lamp, d), made = candela_of(lamp, pages, grid, d, own);
    double difference = fabs(made - candela);
    most = fmax(most, difference);
    sum += difference * difference;
    squares += candela * candela;
    if (made == 0 && candela == 0) continue;
    beyond += difference > tolerance * peak;
    off[lit++] = difference;
  }
  qsort(off, (size_t)lit, sizeof *off, by_size);
  grid->error.most = most / peak;
  grid->error.most95 = lit > 0 ? off[lit * 95LL / 100] / peak : 0;
  grid->error.beyond = lit > 0 ? (double)beyond / lit : 0;
  grid->error.rms = squares > 0 ? sqrt(sum / squares) : 0;
  for (int p = 0; p < BODY_FACES; ++p) own[p] /= peak;
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
                        const bool changed[BODY_FACES], double tolerance,
                        struct photometry_grid *grid, double own[BODY_FACES], struct error *error) {
  enum result result = RESULT_OK;
  for (int p = 0; p < pages->count && result == RESULT_OK; ++p) {
    int n[2] = {st[0], st[1]};
    if (!changed[p]) continue;
    if (!(st[0] > 0)) count_cells(pages, p, across[p], n);
    result = photometry_cells_take(lamp, pages, p, n, &grid->page[p], error);
  }
  if (result == RESULT_OK) result = measure(lamp, pages, tolerance, grid, own, error);
  return result;
}

/* Whether the far field is right, or as right as cells make it: light may lie beyond the windows.
 */
static bool is_done(const struct photometry_grid_error *error, const double own[BODY_FACES],
                    int pages, double tolerance) {
  double most = 0;
  for (int p = 0; p < pages; ++p) most = fmax(most, own[p]);
  return most <= cells_part * tolerance ||
         (error->most95 <= cells_part * tolerance && error->most <= tolerance);
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
  enum result result = take(lamp, pages, across, st, changed, tolerance, grid, own, error);
  while (result == RESULT_OK && !(st[0] > 0) &&
         !is_done(&grid->error, own, pages->count, tolerance)) {
    bool better =
        grid->error.beyond > most_beyond ||
        (grid->error.most <= near_enough * tolerance && grid->error.most <= still_better * before);
    if (!refine(pages, own, cells_part * tolerance, better ? MOST_SAMPLES : CHEAP_SAMPLES, across,
                changed))
      break;
    before = grid->error.most;
    result = take(lamp, pages, across, st, changed, tolerance, grid, own, error);
  }
  if (result == RESULT_OK) result = fit_flux(lamp, pages, grid, error);
  if (result == RESULT_OK) result = measure(lamp, pages, tolerance, grid, own, error);
  return result;
}
