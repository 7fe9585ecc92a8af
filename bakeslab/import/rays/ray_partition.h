/* ray_partition.h - the density of rays over a page's 4D cells, averaged over every way to cut the
 * grid into boxes in which it is even, each weighted by how well it explains the rays.
 *
 * The boxes of an axis are the nodes of a binary tree: all cells, their halves, and so on to single
 * cells. A box is halved along any axis, or is not, each with its own chance. Where the rays show
 * no structure large boxes win, and their mean has little noise; at an edge those win that do not
 * straddle it. Every box has the mean of its own rays, so that their sum is kept exactly. */
#ifndef RAY_PARTITION_H
#define RAY_PARTITION_H

#include "slab/slab.h"

enum { RAY_PASSES = 4 }; /* whose mean is taken, each with its cuts elsewhere */

/* Cells are in the order of slab->rgb's pixels. */
struct ray_cells {
  int samples[SLAB_AXES];
  const float *count;    /* rays of a cell: flux over the flux of a ray there */
  const float *exposure; /* their expected number at radiance 1: etendue over the same */
};

/* Of one pass: sums over cells, of the density and of what it may be about it. */
struct ray_posterior {
  double variance;      /* exposure times the density's variance */
  double view_variance; /* the density's variance, that of a box times its views: as if cells erred
                           independently, but sums over views by as much */
};

/* Refuses more samples than there is memory for: (2 Nu - 1)(2 Nv - 1)(2 Ns - 1)(2 Nt - 1) boxes of
 * 12 bytes are at most 4 GiB. */
enum result ray_partition_check(const int samples[SLAB_AXES], struct error *error);

/* Adds the expected density of each cell, count over exposure, by one pass to density[]. The trees'
 * cuts are at multiples of powers of two, less some cells that depend on the pass. */
enum result ray_partition_add(const struct ray_cells *cells, int pass, double *density,
                              struct ray_posterior *posterior, struct error *error);

#endif
