/* ray_partition.h - the density of rays over a page's 4D cells, averaged over every way to cut the
 * grid into boxes in which it is even, each weighted by how well it explains the rays.
 *
 * The boxes of an axis are the nodes of a binary tree: all cells, their halves, and so on to single
 * cells. A box is halved along any axis, or is not, each with its own chance. Where the rays show
 * no structure large boxes win, and their mean has little noise; at an edge those win that do not
 * straddle it. Every box has the mean of its own rays, so that their sum is kept exactly. */
#ifndef RAY_PARTITION_H
#define RAY_PARTITION_H

#include "import/rays/ray_boxes.h"

enum { RAY_PASSES = 4 }; /* whose mean is taken, each with its cuts elsewhere */

/* Of one pass, on average: sums over cells, of what the density may be about its mean. */
struct ray_posterior {
  double variance;      /* exposure times the density's variance */
  double view_variance; /* the density's variance, that of a box times its views: as if cells erred
                           independently, but sums over views by as much */
};

/* Fills in the expected density of each cell, count over exposure, the mean of RAY_PASSES. The
 * trees' cuts are at multiples of powers of two, less some cells that depend on the pass. Refuses
 * as ray_boxes_check. */
enum result ray_partition(const struct ray_cells *cells, double *density,
                          struct ray_posterior *posterior, struct error *error);

#endif
