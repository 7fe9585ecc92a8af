/* cut_node.h - a node as a receiver sees it: what is estimated of it, at the cost of a look at one
 * st sample, and its light. All lengths are in the tree's units (cut_tree_seen). */
#ifndef CUT_NODE_H
#define CUT_NODE_H

#include "cut/cut_four.h"
#include "cut/cut_tree.h"

struct cut_node {
  int level, at[2];
  double light;               /* estimated: of the largest channel */
  double spread;              /* error: views that differ from the node */
  double curvature;           /* error: what the kernel's expansion leaves out */
  double curvature_per_light; /* of that, what is proportional to the light */
  double kernel;              /* at the center; with the height g there (kernel.h): */
  double per_g, per_square;   /* 1/g; 1/(1 + x^2 + y^2) */
};

/* How wide the nodes of a level are seen. */
struct cut_width {
  double across; /* half of a node's width, in st samples */
  bool narrow;   /* at most one sample wide: errors are those at lines */
  bool wide;     /* wider than errors are known for */
  int spread;    /* else errors are those of this of the CUT_SPREADS widths or the next, */
  int side;      /* for w < 0 (cut.h): 1 */
};

/* For nodes that are seen up to so many st samples wide. */
struct cut_width cut_width_of(double samples, double w);

/* Estimates node->level, node->at: the k-th of those of `worth`, seen at spots[axis], of which it
 * is the one at lane[axis]. */
void cut_node_estimate(const struct cut_tree *tree, const struct cut_width *width,
                       const struct cut_spots *const spots[2], const int lane[2],
                       const struct cut_worth *worth, int k, struct cut_node *node);

/* Adds a node's light; and to `error` its curvature_per_light of what is more than was estimated.
 * `taps` are those of its intervals. */
void cut_node_light(const struct cut_tree *tree, const struct cut_node *node,
                    const double normal[3], const struct cut_spots *const spots[2],
                    const int lane[2], const struct cut_taps *const taps[2], double rgb[3],
                    double *error);

#endif
