/* ray_boxes.h - the boxes of cells of a page's grid: all products of nodes of four binary trees,
 * one an axis, each with its rays and with the evidence that they are even in the box, or in boxes
 * that it is cut into (ray_partition.c).
 *
 * A row of boxes differs in its last axis, S, alone, and a layer is all boxes of one node of the
 * first axis, T. Boxes are numbered so that a layer's and a row's follow each other, and that
 * halves come before what they are halves of. */
#ifndef RAY_BOXES_H
#define RAY_BOXES_H

#include "slab/slab.h"

enum { RAY_BOXES_LAST = SLAB_AXES - 1 }; /* number of the last axis */

/* Cells are in the order of slab->rgb's pixels. */
struct ray_cells {
  int samples[SLAB_AXES];
  const float *count;    /* rays of a cell: flux over the flux of a ray there */
  const float *exposure; /* their expected number at radiance 1: etendue over the same */
  int threads;           /* at least 1; any number gives the same bits */
};

/* An interval of cells; a single cell has no halves: left is -1, and height, the number of times
 * that it can be halved, 0. */
struct ray_node {
  int low, left, right, size, height;
};

struct ray_tree {
  int count;
  struct ray_node *nodes; /* halves first, the root last; owned */
};

struct ray_box {
  float count, exposure;
};

struct ray_boxes {
  const struct ray_cells *cells;
  struct ray_tree trees[SLAB_AXES]; /* of T, V, U, S */
  size_t boxes, step[SLAB_AXES];    /* between boxes whose node differs by 1 */
  size_t cell_step[SLAB_AXES];      /* between cells */
  struct ray_box *box;              /* owned */
  float *evidence; /* of each box: its logarithm, less what all partitions share; owned */
  double scale;    /* exposures are multiplied by it, so that the mean density is 1 */
  int *list;       /* of nodes of the first axis, with room for all; owned */
};

/* Refuses more samples than there is memory for: (2 Nu - 1)(2 Nv - 1)(2 Ns - 1)(2 Nt - 1) boxes of
 * 12 bytes are at most 4 GiB. */
enum result ray_boxes_check(const int samples[SLAB_AXES], struct error *error);

/* Memory for the boxes of cells, which must stay. To be freed in any case. */
enum result ray_boxes_new(const struct ray_cells *cells, struct ray_boxes *boxes,
                          struct error *error);
void ray_boxes_free(struct ray_boxes *boxes);

/* Cuts the axes as this pass does, and weighs all boxes. */
enum result ray_boxes_weigh(struct ray_boxes *boxes, int pass, struct error *error);

struct ray_row {
  const struct ray_node *node[RAY_BOXES_LAST];
  size_t first;                     /* its first box */
  size_t cell;                      /* that of its lowest cells */
  int across;                       /* axes along which it has halves, later ones first, with */
  size_t halves[RAY_BOXES_LAST][2]; /* the first boxes of their rows */
};

/* The row that begins with this box. */
struct ray_row ray_boxes_row(const struct ray_boxes *boxes, size_t first);

/* The cell of a box of a row: its lowest. */
static inline size_t ray_boxes_cell(const struct ray_boxes *boxes, const struct ray_row *row,
                                    int at) {
  return row->cell + (size_t)boxes->trees[RAY_BOXES_LAST].nodes[at].low;
}

/* The halves of a box of a row, `most` pairs at most, the last axis first, with their evidence.
 * Returns the number of pairs. */
static inline int ray_boxes_halves(const struct ray_boxes *boxes, const struct ray_row *row, int at,
                                   int most, size_t halves[SLAB_AXES][2], double *evidence) {
  const struct ray_node *node = &boxes->trees[RAY_BOXES_LAST].nodes[at];
  int pairs = 0;
  if (node->left >= 0) {
    halves[0][0] = row->first + (size_t)node->left;
    halves[pairs++][1] = row->first + (size_t)node->right;
  }
  for (int n = 0; n < row->across && pairs < most; ++n, ++pairs)
    for (int side = 0; side < 2; ++side) halves[pairs][side] = row->halves[n][side] + (size_t)at;
  for (int n = 0; n < pairs; ++n)
    evidence[n] = (double)boxes->evidence[halves[n][0]] + (double)boxes->evidence[halves[n][1]];
  return pairs;
}

/* The logarithm of the evidence of a box with rays, by that of its halves. Fills in, unless NULL,
 * what share of it is that of an even density, and that of each pair. */
double ray_boxes_evidence(const struct ray_box *box, const double *halves, int pairs, double *even,
                          double *shares);

#endif
