/* photometry_grid.h - how fine the cells of a lamp's pages must be, and what the far field of the
 * slab then is. */
#ifndef PHOTOMETRY_GRID_H
#define PHOTOMETRY_GRID_H

#include "import/photometric/photometry_cells.h"

/* How far the far field, interpolated between the cells as a slab is, is from the table. */
struct photometry_grid_error {
  double rms;    /* relative, weighted by solid angle */
  double most95; /* over the largest intensity, of 95 % of the directions where it is light */
  double most;   /* of all of them and of the table's own */
  double beyond; /* the part of the lit directions that are off by more than the tolerance */
  double factor; /* on all cells, for the flux */
};

struct photometry_grid {
  struct photometry_cells page[BODY_FACES];
  struct photometry_grid_error error;
};

/* Takes the cells. st: how many; 0: as few as keep most within the tolerance and most95 within 0.4
 * of that, up to a limit. Light beyond the windows, and what interpolation changes, is made up
 * for by one factor on all cells, so that the slab's flux is the table's. Free with
 * photometry_grid_free, also after a failure. */
enum result photometry_grid(const struct photometry *lamp, const struct photometry_pages *pages,
                            const int st[2], double tolerance, struct photometry_grid *grid,
                            struct error *error);
void photometry_grid_free(struct photometry_grid *grid);

#endif
