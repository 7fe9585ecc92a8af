/* cut_tree.h - the tree over the views of a page that the method `cut` descends (cut.h).
 *
 * A node is a block of views, the product of an interval along u and one along v. It stands for
 * the radiance L(a, b, s, t) in the block as
 *     M + x U + y V + x y W,    x = (a - a0)/h_u, y = (b - b0)/h_v,
 * M to W images of s and t, (a0, b0) the block's center, h_u and h_v half of its sides; such that
 * the block's mean radiance and its moments in a, b and ab are those of the views. All have the
 * resolution of st. Leaves, the single views, are the slab's own samples.
 *
 * Between four st samples radiance is linear in s and t and st, and these are linear in a and b. So
 * a node that a receiver sees between four samples is as exact as its views, however they differ,
 * up to the kernel. Its errors are what is left where it is seen across a line of samples. They are
 * measured with a constant kernel: where it is seen up to one sample wide line by line
 * (cut_lines.c), for CUT_SPREADS larger widths for a receiver in front of each st sample
 * (cut_error.c). */
#ifndef CUT_TREE_H
#define CUT_TREE_H

#include <stdint.h>
#include <string.h>

#include "base/simd.h"
#include "cut/cut_axis.h"
#include "microlight/seen_page.h"

enum { CUT_FLOATS = 12, CUT_SPREADS = 4, CUT_PADDING = 8, CUT_CODES = 256 };

/* Codes step by 1/8 of a power of 2: the upper bits of floats, without the last 20. */
enum { CUT_CODE_SHIFT = 20 };

/* Widths in st samples; CUT_SPREADS of them, each twice the one before. */
static const double cut_narrowest = 1, cut_widest = 8;

/* Of a node, for each st sample: its light, and its errors as codes of cut_tree.error. */
struct cut_estimate {
  uint16_t mean; /* of M's largest channel over the cell from this sample to the next: the upper
                    half of a float */
  uint8_t error[2][CUT_SPREADS]; /* seen wide, for w > 0 and w < 0 (cut.h): the largest of the
                                    cell's corners */
  uint8_t line[2]; /* seen narrow, across this sample of s, or of t, and between this and the next
                      of the other: per half of the width (cut_lines.c) */
  uint8_t second;  /* seen narrow: of the second moments along s and t */
  uint8_t part;    /* seen wide: of any part of the node, mean |view - node| */
  uint8_t edge;    /* the largest `part` within cut_widest/2: where the window cuts the node */
};

static inline double cut_mean(const struct cut_estimate *estimate) {
  uint32_t bits = (uint32_t)estimate->mean << 16;
  float mean;
  memcpy(&mean, &bits, sizeof mean);
  return (double)mean;
}

struct cut_level {
  float *images;                  /* node after node, M V U W x RGB for each sample; owned */
  struct cut_estimate *estimates; /* owned */
};

struct cut_tree {
  const struct light_page *page; /* `own` */
  struct light_page own;         /* the page, in the tree's unit of length (cut_tree_seen); its slab
                                    is not owned */
  double per_unit;               /* a power of two: units in a length of the scene */
  int levels;                    /* the last is that of the single views: no images */
  int fours;                     /* of intervals, of all levels along both axes */
  struct cut_axis axes[2];
  struct cut_level level[CUT_LEVELS];
  float error[CUT_CODES]; /* what a code means: mean radiance */
  double brightest;       /* largest M of the root, times the aperture's area; */
  double hemisphere;      /* times pi */
  double least;           /* of light: 0, or -INFINITY where samples are negative */
};

/* The tree's lengths are in units of about its aperture, so that none of their powers leaves the
 * range of numbers: the page as it is seen, in these units. */
static inline struct seen_page cut_tree_seen(const struct cut_tree *tree,
                                             const struct seen_page *seen) {
  struct seen_page scaled = *seen;
  scaled.page = tree->page;
  scaled.height *= tree->per_unit;
  for (int axis = 0; axis < 2; ++axis) scaled.foot[axis] *= tree->per_unit;
  return scaled;
}

/* ---- A node, by its level and its place there ---- */

static inline size_t cut_texels(const struct cut_tree *tree) {
  return (size_t)tree->page->axes[0].far_count * (size_t)tree->page->axes[1].far_count;
}

/* The number of its first st sample among those of all nodes of the level. */
static inline size_t cut_first_texel(const struct cut_tree *tree, int level, const int at[2]) {
  size_t number = (size_t)at[1] * (size_t)tree->axes[0].count[level] + (size_t)at[0];
  return cut_texels(tree) * number;
}

static inline float *cut_images(const struct cut_tree *tree, int level, const int at[2]) {
  return tree->level[level].images + CUT_FLOATS * cut_first_texel(tree, level, at);
}

static inline struct cut_estimate *cut_estimates(const struct cut_tree *tree, int level,
                                                 const int at[2]) {
  return tree->level[level].estimates + cut_first_texel(tree, level, at);
}

static inline void cut_intervals(const struct cut_tree *tree, int level, const int at[2],
                                 const struct cut_interval *node[2]) {
  for (int axis = 0; axis < 2; ++axis) node[axis] = &tree->axes[axis].level[level][at[axis]];
}

/* A leaf: the samples of a single view, its first row of the raster. */
static inline const float *cut_view(const struct cut_tree *tree, const int at[2]) {
  const struct seen_page seen = {.page = tree->page};
  return tree->page->slab.rgb + seen_page_offset(&seen, 1, at[1], 0) +
         seen_page_offset(&seen, 0, at[0], 0);
}

/* ---- Measuring its errors ---- */

/* Fills in the estimates but for the mean (cut_error.c). The scratch memory is one thread's. */
struct cut_error_scratch;
struct cut_error_scratch *cut_error_scratch(const struct cut_tree *tree); /* NULL: no memory */
void cut_error_scratch_free(struct cut_error_scratch *scratch);           /* NULL allowed */
void cut_error_measure(struct cut_tree *tree, int level, const int at[2],
                       struct cut_error_scratch *scratch);

/* Errors at the lines of axis 0: s, or 1: t, for each st sample, and adds those of the second
 * moments (cut_lines.c). */
struct cut_lines;
struct cut_lines *cut_lines_make(const struct cut_tree *tree); /* for free(); NULL: no memory */
void cut_lines_measure(const struct cut_tree *tree, int level, const int at[2], int axis,
                       struct cut_lines *lines, simd_float4 *off, simd_float4 *second);

#endif
