/* cut_allowed.h - what a cut's light may err by (cut.h), and what the errors of its nodes make
 * together. */
#ifndef CUT_ALLOWED_H
#define CUT_ALLOWED_H

#include <math.h>

#include "cut/cut_tree.h"

/* Errors of nodes that differ from their views have either sign. Their sum is taken as this many
 * times the root of the sum of their squares, or as the sum, where that is less. */
static const double cut_scatter = 1.6;

/* Light below this share of the most that the page sends to the receiver's height may err as if
 * it were that share. */
static const double cut_least_share = 1e-4;

/* Of the tolerance: what is aimed at, since all is estimated. */
static const double cut_margin = 0.7;

/* Nodes are summed in single precision. */
static const double cut_rounding = 5e-7;

/* Of the light; not positive: it cannot be met. */
static inline double cut_allowed_share(double tolerance) {
  return cut_margin * tolerance - cut_rounding;
}

/* The light of which it is a share, at least. */
static inline double cut_allowed_least(const struct cut_tree *tree, double per_height) {
  const double sent = tree->brightest * per_height * per_height;
  return cut_least_share * simd_min(sent, tree->hemisphere);
}

/* The error of nodes from sums of theirs: `square`, of the squares of `spread` (cut_node.h). */
static inline double cut_allowed_sum(double curvature, double spread, double square) {
  const double scattered = cut_scatter * sqrt(square > 0 ? square : 0);
  return curvature + (scattered < spread ? scattered : spread);
}

#endif
