/* far_grid.h - planes and angles of a table of intensities, as close together as interpolation
 * between them needs, and what it errs by. */
#ifndef FAR_GRID_H
#define FAR_GRID_H

#include "export/far_page.h"

enum { FAR_C, FAR_GAMMA }; /* axes */

struct far_grid {
  int count[2];    /* planes, the first of which comes again as the last; angles */
  double *at[2];   /* C and gamma, degrees, ascending; owned */
  double *candela; /* [plane * angles + angle]; owned */
  double peak;     /* the largest intensity of all directions that were looked at */
  /* Of interpolation, over the peak, by solid angle, where there is light: */
  double rms, most95, most;
  double beyond; /* the part of the directions that are off by more than the tolerance */
};

/* Intensities of all pages, between the tables' axes of type C (export_photometry.h). Free with
 * far_grid_free, also after a failure. Steps are halved until all but a hundredth of the lit
 * directions between two planes, or two angles, are off by no more than the tolerance, down to
 * 0.005 degrees between angles and 0.015 between planes, while the table is of bearable size. */
enum result far_grid_make(const struct far_page *pages, int count, double tolerance,
                          struct far_grid *grid, struct error *error);
void far_grid_free(struct far_grid *grid); /* zeroed ones allowed */

/* Its flux, lm: linear in gamma and in C, times sin(gamma), in closed form. */
double far_grid_flux(const struct far_grid *grid);

#endif
