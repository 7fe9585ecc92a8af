/* exact.h - what exact rationals (CGAL) know of a light slab. Written from the text of
 * light-slab(5) alone. */
#ifndef EXACT_H
#define EXACT_H

#ifdef __cplusplus
extern "C" {
#endif

#include "slab/slab.h"

enum { ORACLE_PIECES = 256 }; /* along an axis; more aborts */

/* Where neither grid has a line inside: everything is linear in x. Sample
 * `uv[0] + f`, f going from uv_at[0] to uv_at[1]; the same for st. */
struct oracle_piece {
  long double x, width;
  int uv[2], st[2];
  long double uv_at[2], st_at[2];
};

struct oracle_axis {
  int count; /* 0 where nothing is visible */
  struct oracle_piece piece[ORACLE_PIECES];
};

/* The visible part along u (`which` 0) or v (1), for a receiver at p, height z >= 0 above the
 * aperture, in slopes x (oracle.h); all lines of both grids are exact. z = 0 is the limit from
 * above: the rectangle is then all slopes where the foot is inside, half of them on its border.
 * Aborts unless the lengths of the pieces add up exactly. */
void oracle_axis_find(const struct slab *slab, const double p[3], int which,
                      struct oracle_axis *axis);

/* How much the mean of a channel's samples differs between two slabs of one aperture and window,
 * relative to the first's: that is their energy where samples have the same area. */
double oracle_mean_change(const struct slab *from, const struct slab *to, int channel);

#ifdef __cplusplus
}
#endif

#endif
