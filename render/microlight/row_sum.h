/* row_sum.h - the light of the micro lights of one page that one receiver sees through one
 * rectangle of slopes: the paper's equation 3, row by row, a row being all micro lights of one
 * strip along v. */
#ifndef ROW_SUM_H
#define ROW_SUM_H

#include <stdint.h>

#include "microlight/rule.h"
#include "microlight/seen_page.h"
#include "microlight/taps.h"

/* One sum, in memory that the next one uses again: one for each thread, zero-initialised. */
struct row_sum {
  bool skip_black; /* do not sum what is black; set by the caller */

  /* Private: */
  const struct seen_page *seen;
  enum rule rule;
  struct rule_nodes nodes[2];  /* along u and v; owned */
  struct taps_column *columns; /* all but RULE_GAUSS: one a strip along u; owned */
  int (*offset)[2];            /* pixels of the strips along u; owned */
  double *kernel;              /* at a row's nodes; owned */
  float *factor;               /* owned */
  int column_room, offset_room;
  size_t kernel_room;
  double unit[2];   /* single precision: weights are relative to these lengths and the page's
                       unit */
  bool above;       /* the tangent plane: all of it */
  int row;          /* that is summed */
  double rgb[2][3]; /* irradiance and gloss so far, but for `unit` */
};

void row_sum_free(struct row_sum *sum);

/* Sums over the strips, none of the two lists empty; `rule` and `orders` as for rule_place. All
 * rules but RULE_GAUSS sum in single precision. With RULE_VIEWS the strips are views
 * (strips_find_views), clamped at the tangent plane instead of cut by it. */
enum result row_sum_light(struct row_sum *sum, const struct seen_page *seen,
                          const struct strips strips[2], enum rule rule,
                          const struct rule_orders *orders, double irradiance[3], double gloss[3],
                          struct gather_counts *counts, struct error *error);

#endif
