/* row_sum.h - the micro lights of one page that one receiver sees through one rectangle of
 * slopes, and the sum of their light (the paper's equation 3).
 *
 * A sum is prepared and then taken row by row, a row being all micro lights of one strip
 * along v, so that sums of neighbouring receivers can be interleaved while the page's rows
 * are in the cache. */
#ifndef ROW_SUM_H
#define ROW_SUM_H

#include <stdint.h>

#include "microlight/rule.h"
#include "microlight/seen_page.h"
#include "microlight/taps.h"

enum row_sum_kind {
  ROW_SUM_SINGLE, /* a node a micro light, single precision */
  ROW_SUM_VIEWS,  /* the same over views: clamped at the tangent plane instead of cut */
  ROW_SUM_GAUSS   /* several nodes, double precision */
};

struct row_sum {
  struct seen_page seen;
  enum row_sum_kind kind;
  struct rule_nodes nodes[2];  /* along u and v; owned */
  struct taps_column *columns; /* all but ROW_SUM_GAUSS: one a strip along u; owned */
  int (*offset)[2];            /* pixels of the strips along u; owned */
  int column_room;
  double unit[2];   /* single precision: weights are relative to these lengths
                      and the page's unit */
  bool above;       /* the tangent plane: all of it */
  bool skip_black;  /* do not sum what is black; set by whoever prepares */
  int row;          /* next to sum */
  double rgb[2][3]; /* irradiance and gloss so far, but for `unit` */
};

struct row_sum_counts {
  uint64_t microlights, nodes; /* visited */
  uint64_t black;              /* micro lights that were not: all their samples are 0 */
};

void row_sum_free(struct row_sum *cells);

/* Prepares the sum over the strips; `rule` and `orders` as for rule_place. */
enum result row_sum_prepare(struct row_sum *cells, const struct seen_page *seen,
                            const struct strips strips[2], enum row_sum_kind kind, enum rule rule,
                            const struct rule_orders *orders, struct error *error);

/* Scratch memory for rows: kernels of a row's nodes. One for each thread. */
struct row_sum_scratch {
  double *kernel; /* owned */
  float *factor;  /* owned */
  size_t room;
};
void row_sum_scratch_free(struct row_sum_scratch *scratch);
enum result row_sum_scratch_reserve(struct row_sum_scratch *scratch, const struct row_sum *cells,
                                    struct error *error);

/* Sums the next row. */
void row_sum_add_row(struct row_sum *cells, struct row_sum_scratch *scratch,
                     struct row_sum_counts *counts);

/* What all rows gave. */
void row_sum_result(const struct row_sum *cells, double irradiance[3], double gloss[3]);

#endif
