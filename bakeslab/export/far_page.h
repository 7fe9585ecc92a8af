/* far_page.h - a page seen from so far that its size does not count: the mean radiance over its
 * positions, in every direction, as a slab of one view whose st plane is at infinity.
 *
 * The mean of a page whose st plane is at infinity is exact. Of others it is taken, exact, on a
 * grid several times finer than their directions, whose window is as much wider as the aperture
 * makes it, and interpolated in between. */
#ifndef FAR_PAGE_H
#define FAR_PAGE_H

#include "slab/slab.h"

struct far_page {
  const struct slab *slab; /* the caller's */
  struct slab view;        /* of luminance, in R; owned */
  double scale;            /* to cd/m2, times the square of a lamp unit in metres */
};

/* Free with far_page_free, also after a failure. */
enum result far_page_make(const struct slab *slab, struct far_page *page, struct error *error);
void far_page_free(struct far_page *page); /* zeroed ones allowed */

/* Luminous intensity towards a unit vector of lamp space: W/(sr m2) count 179 lm, and a relative
 * radiance counts as cd/m2. */
double far_page_candela(const struct far_page *page, const double direction[3]);

#endif
