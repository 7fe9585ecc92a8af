/* photometry_cells.h - the directions of a page as a grid of cells, between which a slab
 * interpolates. */
#ifndef PHOTOMETRY_CELLS_H
#define PHOTOMETRY_CELLS_H

#include "import/photometric/photometry_pages.h"

/* One page's. Cell (k, l) is number l * n[0] + k. */
struct photometry_cells {
  int n[2];      /* cells along s and t */
  double *mean;  /* of the radiance, cd/m2, by the flux of its rays; owned */
  double *share; /* of the page that sends light in the cell's direction; owned */
};

/* Takes n[0] x n[1] cells of a page, in place of those there. Free with photometry_cells_free, also
 * after a failure. */
enum result photometry_cells_take(const struct photometry *lamp,
                                  const struct photometry_pages *pages, int page, const int n[2],
                                  struct photometry_cells *cells, struct error *error);
void photometry_cells_free(struct photometry_cells *cells); /* zeroed ones allowed */

/* The part of a page that sends light in the direction of two slopes. */
double photometry_share(const struct photometry_pages *pages, int page, double s, double t);

#endif
