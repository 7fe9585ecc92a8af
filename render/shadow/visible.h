/* visible.h - the part of an aperture that a receiver sees past the occluders,
 * as rectangles over which the integrators sum as if nothing stood there.
 *
 * The rule: the rectangle is cut into `grid` x `grid` blocks. Shadow rays go to the four
 * corners (shared between blocks) and the middle of each; where the five agree, the block
 * is taken as wholly visible or wholly hidden, otherwise it is quartered, down to 1/`edge`
 * of the rectangle's sides, where the ray to the middle decides for the whole. Such parts are
 * merged along rows or columns, whichever ends at more shadows, and each end is then put where rays
 * along its middle line change. So an occluder that hides less than a block may be missed; edges of
 * shadows are off by 1/16 of 1/`edge` of the aperture, those along the rows (columns) by at
 * most half of 1/`edge` of the aperture. Deterministic. */
#ifndef VISIBLE_H
#define VISIBLE_H

#include <stdint.h>

#include "base/result.h"

struct occlusion;

/* The smallest part of a side is one of so many. */
enum { VISIBLE_MOST_EDGE = 4096 };

struct visible_rectangle {
  double low[2], high[2];
};

/* Points of the aperture are origin + x*along[0] + y*along[1]; the rectangle to look at is
 * `whole`, in (x, y). */
struct visible_query {
  const struct occlusion *occlusion;
  double lifted[3]; /* the receiver, by occlusion_lift */
  double origin[3], along[2][3];
  struct visible_rectangle whole;
  int grid; /* >= 1 */
  int edge; /* grid..VISIBLE_MOST_EDGE; rounded up to grid times a power of two */
};

/* A buffer that is used again from receiver to receiver; one for each thread.
 * Zero-initialised; freed with visible_free. */
struct visible {
  struct visible_rectangle *rectangles; /* disjoint; neighbours are merged where they line up */
  int count, room;
  uint64_t shadow_rays;      /* traced since the buffer was made */
  struct visible_work *work; /* private */
};

/* Replaces the contents of the buffer. The whole rectangle, exactly, where nothing is hidden,
 * for (grid+1)^2 + grid^2 rays; none where all is. A rectangle without area (or with
 * low > high) has no visible part, and no ray is traced. */
enum result visible_find(const struct visible_query *query, struct visible *visible,
                         struct error *error);
void visible_free(struct visible *visible);

#endif
