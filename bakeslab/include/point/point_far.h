/* point_far.h - a lamp's pages from far away. */
#ifndef POINT_FAR_H
#define POINT_FAR_H

#include "base/result.h"
#include "slab/slab.h"

/* Far away a page is its views' sum: one view where the st plane is at infinity, so
 * that all see the same slopes. */
struct point_far {
  const struct slab *slab; /* the caller's */
  struct slab views;       /* owned */
  double flux[3];          /* in lamp units */
  double u[3], v[3];       /* unit */
  double shift[3];         /* of its centre from the lamp's, along u, v and normal */
};

/* Leaves `shift` 0. Free with point_far_free, also after a failure. */
enum result point_far_make(const struct slab *slab, struct point_far *far, struct error *error);
void point_far_free(struct point_far *far);

/* Adds the page's intensity along a unit vector of lamp space to rgb. */
void point_far_add(const struct point_far *far, const double direction[3], double rgb[3]);

#endif
