/* photometry_unfold.h - from the planes that a file holds to those all around. */
#ifndef PHOTOMETRY_UNFOLD_H
#define PHOTOMETRY_UNFOLD_H

#include "import/photometric/photometry.h"

/* What a distribution in C planes is alike under; bits. */
enum photometry_symmetry {
  PHOTOMETRY_ASYMMETRIC = 0,
  PHOTOMETRY_C0_C180 = 1,  /* plane C is plane 360 - C */
  PHOTOMETRY_C90_C270 = 2, /* plane C is plane 180 - C */
  PHOTOMETRY_ROTATED = 4   /* all are one */
};

/* Makes the planes and the candela of a lamp whose rows are set from `planes` planes at the angles
 * c (degrees, any turn), each of lamp->rows intensities. One plane is all of them. Of two at one
 * angle the first counts. Where the last is not 360, the first comes again there. Refuses what
 * leaves the plane 0 open. */
enum result photometry_unfold(struct photometry *lamp, const double *c, int planes,
                              const double *candela, enum photometry_symmetry symmetry,
                              struct error *error);

/* The same for types A and B, whose angles H and V are mirrored where they begin at 0. */
enum result photometry_unfold_sides(struct photometry *lamp, const double *h, int planes,
                                    const double *v, int rows, const double *candela,
                                    struct error *error);

#endif
