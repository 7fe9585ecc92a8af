/* cut_tree.h - the tree over the views of a page that the method `cut` descends (cut.h).
 *
 * A node is a block of views, the product of an interval along u and one along v. It stands for
 * the radiance L(a, b, s, t) in the block as
 *     M(s, t) + (a - a0)/h_u U(s, t) + (b - b0)/h_v V(s, t),
 * (a0, b0) its center, h_u and h_v half of its sides; M, U and V such that the block's mean
 * radiance and its first moments are those of the views. All have the resolution of st. Leaves,
 * the single views, are the slab's own samples.
 *
 * Beside them a node has, for each st sample, how far the node is from the sum of its views
 * when a receiver's view of it is CUT_SPREADS st samples wide: measured when the tree is built,
 * with a constant kernel. */
#ifndef CUT_TREE_H
#define CUT_TREE_H

#include <stdint.h>

#include "cut_axis.h"

enum { CUT_FLOATS = 9, CUT_SPREADS = 5, CUT_PADDING = 8, CUT_CODES = 256 };

/* Widths in st samples; CUT_SPREADS of them, each twice the one before. */
static const double cut_narrowest = 0.5, cut_widest = 8;

struct cut_estimate {
  float mean; /* of M's largest channel over the cell from this st sample to the next */
  uint8_t error[2][CUT_SPREADS]; /* for w > 0 and w < 0 (cut.h): the largest of the cell's
                                    corners, coded */
  uint8_t part;                  /* the same, for any part of the node: mean |view - node| */
  uint8_t edge;                  /* the largest of these in what a receiver may see */
};

struct cut_level {
  float *images;                  /* node after node, M U V x RGB for each sample; owned */
  struct cut_estimate *estimates; /* owned */
};

struct cut_tree {
  const struct light_page *page;
  int levels; /* the last is that of the single views: no images */
  struct cut_axis axes[2];
  struct cut_level level[CUT_LEVELS];
  float error[CUT_CODES]; /* what a code means: mean radiance */
  double brightest;       /* largest M of the root, times the aperture's area */
  double bytes;           /* of memory, the slab aside */
};

/* Codes step by 1/8 octave. */
static const int cut_code_steps = 8;

static inline size_t cut_node_number(const struct cut_tree *tree, int level, const int at[2]) {
  return (size_t)at[1] * (size_t)tree->axes[0].count[level] + (size_t)at[0];
}

static inline size_t cut_texels(const struct cut_tree *tree) {
  return (size_t)tree->page->axes[0].far_count * (size_t)tree->page->axes[1].far_count;
}

/* Measures a node's errors (cut_error.c). The scratch memory is one thread's. */
struct cut_error_scratch;
struct cut_error_scratch *cut_error_scratch(const struct cut_tree *tree); /* NULL: no memory */
void cut_error_scratch_free(struct cut_error_scratch *scratch);           /* NULL allowed */
void cut_error_measure(struct cut_tree *tree, int level, const int at[2],
                       struct cut_error_scratch *scratch);

#endif
