/* lit_rows.h - which parts of a page are black and need no sum. Lamps shine through a disc in a
 * square aperture, or into a narrow beam: much of their slabs is black. */
#ifndef LIT_ROWS_H
#define LIT_ROWS_H

#include "slab/slab.h"

/* Where a row of the raster is not black: views from near[0] to near[1] along u, samples from
 * far[0] to far[1] along s. near[0] > near[1] where all of it is black. */
struct lit_row {
  int near[2], far[2];
};

/* The rows of a slab's raster, to be freed; NULL: no memory. */
struct lit_row *lit_rows(const struct slab *slab);

/* The ranges that hold both rows'. */
struct lit_row lit_rows_join(const struct lit_row *a, const struct lit_row *b);

#endif
