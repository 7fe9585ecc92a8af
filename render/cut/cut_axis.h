/* cut_axis.h - blocks of neighbouring views along one axis, and what the st samples weigh in
 * them for a receiver.
 *
 * The hat functions of a block's samples sum up to H(a): 1 inside the block, falling to 0 over
 * the spacing of views at its ends (a step where the aperture ends). The light of a block is an
 * integral over H(a) times the hat functions of the st samples, which are functions of a for a
 * given receiver (strips.h). Their products with powers of a are integrated exactly. */
#ifndef CUT_AXIS_H
#define CUT_AXIS_H

#include <stdbool.h>

#include "base/result.h"
#include "base/simd.h"
#include "light/light.h"

enum { CUT_LEVELS = 16, CUT_TAPS = 16, CUT_MOMENTS = 4, CUT_HINGE = CUT_MOMENTS + 3 };

/* Gauss nodes and weights on [0, 1]: exact to the fifth power. */
static const double cut_gauss_at[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
static const double cut_gauss_weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

/* A part of an interval on which H is linear: from `from` at `low` to `to` at `high`. */
struct cut_piece {
  double low, high; /* distances from the interval's center */
  double from, to;
};

struct cut_interval {
  int first, last;                /* views */
  int child, children;            /* on the next level; 1 or 2 */
  double center;                  /* of mass of H, scene units from the middle of the aperture */
  double half;                    /* the largest distance from it where H > 0 */
  double per_half;                /* 1/half */
  double moment[CUT_MOMENTS + 1]; /* integral of H (a - center)^m */
  int pieces;
  struct cut_piece piece[3];
  /* With y = (a - center)/half: integrals of H y^m da; and for each piece those of H y^m times
   * (y - y0)+, as a polynomial of y0 from the piece's middle, ascending. */
  float share[CUT_MOMENTS + 1];
  float hinge[3][CUT_HINGE][CUT_MOMENTS];
};

/* Four neighbouring intervals, what is needed of each to see it; those beyond the last are zero. */
struct cut_four {
  simd_doubles4 center, half, per_half, size; /* size: moment[0] */
};

/* Level 0 is one block, each further one halves all blocks of more than one view: children of
 * 2 n + 1 views have n + 1 and n. */
struct cut_axis {
  int count[CUT_LEVELS];
  struct cut_interval *level[CUT_LEVELS]; /* owned */
  struct cut_four *fours[CUT_LEVELS];     /* the same, by four; owned */
  double reach[CUT_LEVELS];               /* largest `half` of a level */
  double widest[CUT_LEVELS];              /* in samples of st for a unit change of s per length */
  double per_step;                        /* 1/(from sample to sample of st) */
};

/* Levels until all blocks are single views. */
int cut_axis_levels(int views);

enum result cut_axis_make(const struct light_axis *axis, int levels, struct cut_axis *made,
                          struct error *error);
void cut_axis_free(struct cut_axis *axis);

/* How a receiver sees an interval: the st sample number at a is place + rate (a - center), and a
 * length of the aperture is worth `scale`. */
struct cut_sight {
  double place, rate, scale;
  bool clipped; /* by the st window; false where that is known not to be */
};

/* moment[m][k]: integral of H hat_(first+k) y^m scale da with y = (a - center)/half; 0 from `count`
 * on to the next multiple of 4. Rays beyond the st window bring nothing. */
struct cut_taps {
  int first, count; /* st samples; count 0: nothing is seen */
  float moment[CUT_MOMENTS][CUT_TAPS];
};

/* False where more than CUT_TAPS samples are seen. */
bool cut_taps_find(const struct cut_interval *interval, const struct cut_sight *sight,
                   int far_count, struct cut_taps *taps);

#endif
