/* cells.h - the micro lights of one page that one receiver sees through one rectangle of
 * slopes, and the sum of their light (the paper's equation 3).
 *
 * A sum is prepared and then taken row by row, a row being all micro lights of one strip
 * along v, so that sums of neighbouring receivers can be interleaved while the page's rows
 * are in the cache. */
#ifndef CELLS_H
#define CELLS_H

#include <stdint.h>

#include "rule.h"
#include "taps.h"
#include "view.h"

enum cells_kind {
  CELLS_SINGLE, /* a node a micro light, single precision */
  CELLS_VIEWS,  /* the same over views: clamped at the tangent plane instead of cut */
  CELLS_GAUSS   /* several nodes, double precision */
};

struct cells {
  struct view view;
  enum cells_kind kind;
  struct rule_nodes nodes[2];  /* along u and v; owned */
  struct taps_column *columns; /* all but CELLS_GAUSS: one a strip along u; owned */
  int (*offset)[2];            /* pixels of the strips along u; owned */
  int column_room;
  double unit[2];   /* single precision: weights are relative to these lengths
                      and the page's unit */
  bool above;       /* the tangent plane: all of it */
  bool skip_black;  /* do not sum what is black; set by whoever prepares */
  int row;          /* next to sum */
  double rgb[2][3]; /* irradiance and gloss so far, but for `unit` */
};

struct cells_counts {
  uint64_t microlights, nodes; /* visited */
  uint64_t black;              /* micro lights that were not: all their samples are 0 */
};

void cells_free(struct cells *cells);

/* Prepares the sum over the strips; `rule` and `orders` as for rule_place. */
enum slab_result cells_prepare(struct cells *cells, const struct view *view,
                               const struct strips strips[2], enum cells_kind kind, enum rule rule,
                               const struct rule_orders *orders, struct slab_error *error);

/* Scratch memory for rows: kernels of a row's nodes. One for each thread. */
struct cells_scratch {
  double *kernel; /* owned */
  float *factor;  /* owned */
  size_t room;
};
void cells_scratch_free(struct cells_scratch *scratch);
enum slab_result cells_scratch_reserve(struct cells_scratch *scratch, const struct cells *cells,
                                       struct slab_error *error);

/* Sums the next row. */
void cells_sum_row(struct cells *cells, struct cells_scratch *scratch, struct cells_counts *counts);

/* What all rows gave. */
void cells_result(const struct cells *cells, double irradiance[3], double gloss[3]);

#endif
