/* photometry_slab.h - the slabs of a lamp that was measured from afar: each point of its opening
 * that faces a direction shines alike there (photometry_pages.h). Samples are means over cells. */
#ifndef PHOTOMETRY_SLAB_H
#define PHOTOMETRY_SLAB_H

#include "import/photometric/photometry_grid.h"
#include "slab/slab.h"

/* Makes pages->count slabs, which the caller frees, and their array. uv: how many positions; 0:
 * enough for light near by. `white` is a colour of luminance 1. */
enum result photometry_slabs(const struct photometry *lamp, const struct photometry_pages *pages,
                             const struct photometry_grid *grid, const int uv[2],
                             const double white[3], struct slab **slabs, struct error *error);

#endif
