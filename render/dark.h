/* dark.h - which parts of a page are black: there is nothing to sum there. Lamps shine through
 * a disc in a square aperture, or into a narrow beam; much of their slabs is black. */
#ifndef DARK_H
#define DARK_H

#include "slab.h"

/* Where a row of the raster is not black: views from near[0] to near[1] along u, samples from
 * far[0] to far[1] along s. near[0] > near[1] where all of it is black. */
struct dark_row {
  int near[2], far[2];
};

/* The rows of a slab's raster, to be freed; NULL without memory. */
struct dark_row *dark_rows(const struct slab *slab);

/* What is lit in either. */
struct dark_row dark_join(const struct dark_row *a, const struct dark_row *b);

#endif
