#include "import/photometric/photometry_slab.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  SAMPLES = 1 << 22, /* of all pages, unless the least number of positions needs more */
  EVEN = 8,          /* positions along the longer edge of a page that shines all over ... */
  ROUND = 16,        /* and of one that holds something round */
  ROWS = 4,          /* within a position */
  TURNS = 2          /* directions within a cell, along each axis, for round bodies */
};

static double samples_of(const struct photometry_pages *pages, const struct photometry_grid *grid,
                         int along) {
  double count = 0;
  for (int p = 0; p < pages->count; ++p) {
    const struct photometry_cells *cells = &grid->page[p];
    int uv[2];
    photometry_positions(pages, p, along, uv);
    count += (double)uv[0] * uv[1] * cells->n[0] * cells->n[1];
  }
  return count;
}

static const double least_sheet = 0.0012; /* m */

/* How many positions along the longer edge of a page. */
static int choose_along(const struct photometry *lamp, const struct photometry_pages *pages,
                        const struct photometry_grid *grid) {
  bool round = pages->body.shape != PHOTOMETRY_BOX;
  int along = round ? ROUND : EVEN, least = round ? PHOTOMETRY_LEAST_ROUND : PHOTOMETRY_LEAST_EVEN;
  if (lamp->shape == PHOTOMETRY_POINT) return 1;
  while (along > least && samples_of(pages, grid, along) > SAMPLES) --along;
  return along;
}

/* POV-Ray lights a scene through a sheet as far above a page as its positions are apart, over the
 * range of its slopes; at Scale 1 it must be a millimetre or more (include/sheet/). Where positions
 * are alike, fewer are as exact elsewhere. */
static void spread(const struct photometry_pages *pages, int page, int uv[2]) {
  const double *window = pages->page[page].window;
  const double *size = pages->body.face[pages->page[page].face].size;
  int least = pages->body.shape == PHOTOMETRY_BOX ? 1 : PHOTOMETRY_LEAST_ROUND;
  for (int axis = 0; axis < 2; ++axis) {
    double most = size[axis] / (least_sheet * (window[2 * axis + 1] - window[2 * axis]));
    if (uv[axis] > least) uv[axis] = (int)fmax(least, fmin(uv[axis], floor(most)));
  }
}

/* Adds to each of `count` cells along a page the part of [from, to] that lies in it, over its
 * width. */
static void cover(double *cells, int count, double size, const double range[2], double weight) {
  double width = size / count, from = (range[0] + size / 2) / width,
         to = (range[1] + size / 2) / width;
  for (int i = (int)fmax(0, floor(from)); i < count && i < to; ++i)
    cells[i] += weight * (fmin(to, i + 1) - fmax(from, i));
}

/* The parts of a view's positions (i fastest) that send light in the directions of cell (k, l). */
static void view_cover(const struct photometry_pages *pages, int page, const struct slab *slab,
                       int k, int l, double *part) {
  int face = pages->page[page].face, nu = slab->samples[SLAB_U], nv = slab->samples[SLAB_V];
  const double *size = pages->body.face[face].size;
  bool box = pages->body.shape == PHOTOMETRY_BOX;
  int across = photometry_is_even(&pages->body) ? 1 : TURNS;
  double step[2] = {slab_spacing(slab, SLAB_S), slab_spacing(slab, SLAB_T)}, range[2], d[3];
  for (int n = 0; n < nu * nv; ++n) part[n] = box ? 1 : 0;
  if (box) return;
  for (int n = 0; n < across * across; ++n) {
    double s = slab_position(slab, SLAB_S, k) + ((n % across + 0.5) / across - 0.5) * step[0];
    double t = slab_position(slab, SLAB_T, l) + ((n / across + 0.5) / across - 0.5) * step[1];
    photometry_direction(pages, page, s, t, d);
    for (int row = 0; row < nv * ROWS; ++row)
      if (photometry_row(&pages->body, face, d, ((row + 0.5) / (nv * ROWS) - 0.5) * size[1], range))
        cover(part + row / ROWS * nu, nu, size[0], range, 1.0 / (ROWS * across * across));
  }
}

/* Where the whole page's share of a direction is known, the parts add up to it. */
static void fit_to_share(double *part, int count, double share) {
  double sum = 0;
  for (int n = 0; n < count; ++n) sum += part[n];
  for (int n = 0; n < count && sum > 0; ++n) part[n] *= share * count / sum;
}

static enum result fill(const struct photometry_pages *pages, int page,
                        const struct photometry_cells *cells, const double white[3],
                        struct slab *slab, struct error *error) {
  int nu = slab->samples[SLAB_U], nv = slab->samples[SLAB_V];
  double *part = calloc((size_t)nu * (size_t)nv, sizeof *part);
  if (!part) return result_no_memory(error);
  for (int l = 0; l < cells->n[1]; ++l)
    for (int k = 0; k < cells->n[0]; ++k) {
      size_t at = (size_t)l * (size_t)cells->n[0] + (size_t)k;
      if (cells->mean[at] == 0) continue;
      view_cover(pages, page, slab, k, l, part);
      fit_to_share(part, nu * nv, cells->share[at]);
      for (int n = 0; n < nu * nv; ++n)
        for (int c = 0; c < 3; ++c)
          slab_at(slab, n % nu, n / nu, k, l)[c] = (float)(white[c] * part[n] * cells->mean[at]);
    }
  free(part);
  return RESULT_OK;
}

static struct slab geometry(const struct photometry_pages *pages, int page,
                            const struct photometry_cells *cells, const int uv[2]) {
  const struct photometry_face *face = &pages->body.face[pages->page[page].face];
  struct slab slab = slab_default();
  memcpy(slab.center, face->center, sizeof slab.center);
  memcpy(slab.u, face->u, sizeof slab.u);
  memcpy(slab.v, face->v, sizeof slab.v);
  memcpy(slab.normal, face->normal, sizeof slab.normal);
  memcpy(slab.st_window, pages->page[page].window, sizeof slab.st_window);
  slab.samples[SLAB_U] = uv[0];
  slab.samples[SLAB_V] = uv[1];
  slab.samples[SLAB_S] = cells->n[0];
  slab.samples[SLAB_T] = cells->n[1];
  snprintf(slab.radiance_unit, sizeof slab.radiance_unit, "cd/m2");
  return slab;
}

enum result photometry_slabs(const struct photometry *lamp, const struct photometry_pages *pages,
                             const struct photometry_grid *grid, const int uv[2],
                             const double white[3], struct slab **slabs, struct error *error) {
  int along = choose_along(lamp, pages, grid);
  enum result result = RESULT_OK;
  struct slab *made = calloc(BODY_FACES, sizeof *made);
  *slabs = NULL;
  if (!made) return result_no_memory(error);
  for (int p = 0; p < pages->count && result == RESULT_OK; ++p) {
    const struct photometry_cells *cells = &grid->page[p];
    int own[2] = {uv[0], uv[1]};
    if (!(uv[0] > 0)) {
      photometry_positions(pages, p, along, own);
      spread(pages, p, own);
    }
    made[p] = geometry(pages, p, cells, own);
    result = slab_check(&made[p], error);
    if (result == RESULT_OK) result = slab_alloc(&made[p], error);
    if (result == RESULT_OK) result = fill(pages, p, cells, white, &made[p], error);
  }
  for (int p = 0; p < pages->count && result != RESULT_OK; ++p) slab_free(&made[p]);
  if (result == RESULT_OK)
    *slabs = made;
  else
    free(made);
  return result;
}
