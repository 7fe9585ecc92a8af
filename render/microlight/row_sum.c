#include "microlight/row_sum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "base/simd.h"
#include "microlight/tangent.h"

enum { MATTE, GLOSS };

void row_sum_free(struct row_sum *sum) {
  for (int axis = 0; axis < 2; ++axis) rule_nodes_free(&sum->nodes[axis]);
  free(sum->columns);
  free(sum->offset);
  free(sum->kernel);
  free(sum->factor);
  *sum = (struct row_sum){0};
}

static enum result reserve(struct row_sum *sum, struct error *error) {
  int count = sum->nodes[0].strips.count;
  size_t nodes = ((size_t)sum->nodes[0].count + 2 * SIMD_LANES) / SIMD_LANES * SIMD_LANES;
  if (!array_reserve(&sum->columns, &sum->column_room, count, sizeof *sum->columns) ||
      !array_reserve(&sum->offset, &sum->offset_room, count, sizeof *sum->offset))
    return result_no_memory(error);
  if (nodes > sum->kernel_room) {
    free(sum->kernel);
    free(sum->factor);
    sum->kernel = calloc(nodes * RULE_LARGEST_ORDER, sizeof *sum->kernel);
    sum->factor = calloc(nodes, sizeof *sum->factor);
    sum->kernel_room = sum->kernel && sum->factor ? nodes : 0;
    if (!sum->kernel_room) return result_no_memory(error);
  }
  return RESULT_OK;
}

static double reach(const struct strips *strips) {
  double sum = 0;
  for (int k = 0; k < strips->count; ++k) sum += strips->strip[k].width;
  return sum;
}

static void set_columns(struct row_sum *sum) {
  const struct rule_nodes *u = &sum->nodes[0];
  for (int c = 0; c < u->strips.count; ++c) {
    seen_page_columns(sum->seen, &u->strips.strip[c].taps, sum->offset[c]);
    if (sum->rule == RULE_GAUSS) continue;
    double weight[4];
    for (int tap = 0; tap < 4; ++tap) weight[tap] = u->weight[c][tap] / sum->unit[0];
    taps_set_column(&sum->columns[c], sum->offset[c], weight);
  }
}

/* Places the nodes. */
static enum result prepare(struct row_sum *sum, const struct strips strips[2],
                           const struct rule_orders *orders, struct error *error) {
  enum result result = RESULT_OK;
  double range[2];
  memset(sum->rgb, 0, sizeof sum->rgb);
  for (int axis = 0; axis < 2 && result == RESULT_OK; ++axis) {
    sum->unit[axis] = sum->rule == RULE_GAUSS ? 1 : reach(&strips[axis]);
    if (axis == 1 && sum->rule != RULE_GAUSS) sum->unit[axis] *= sum->seen->page->unit;
    double pole = fmin(rule_pole(&strips[1 - axis]), kernel_pole(&sum->seen->kernel));
    result = rule_place(&strips[axis], sum->rule, orders, pole, &sum->nodes[axis], error);
  }
  if (result == RESULT_OK) result = reserve(sum, error);
  if (result != RESULT_OK) return result;
  seen_page_heights(sum->seen, strips, range);
  sum->above = range[0] >= 0;
  set_columns(sum);
  return RESULT_OK;
}

/* Strips along u whose micro lights in a row lie above the tangent plane: full[0] to full[1];
 * those that it cuts: cut[0] to cut[1]. */
struct span {
  int full[2], cut[2];
};

/* The first strip for which n_x * end + height >= 0, or > 0; ascending for n_x >= 0, and the
 * first for which it no longer holds for n_x < 0. */
static int boundary(const struct strips *strips, double along, bool at_high, double height,
                    bool strictly) {
  int low = 0, high = strips->count;
  while (low < high) {
    int middle = (low + high) / 2;
    const struct strip *strip = &strips->strip[middle];
    double g = along * (at_high ? strip->high : strip->low) + height;
    if ((strictly ? g > 0 : g >= 0) == (along >= 0))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

static struct span find_span(const struct row_sum *sum, const struct strip *row) {
  const struct strips *strips = &sum->nodes[0].strips;
  const double *n = sum->seen->kernel.normal;
  int count = strips->count;
  if (sum->above || sum->rule == RULE_VIEWS) return (struct span){{0, count}, {0, 0}};
  double least = fmin(n[1] * row->low, n[1] * row->high) - n[2];
  double most = fmax(n[1] * row->low, n[1] * row->high) - n[2];
  if (n[0] >= 0) {
    int full = boundary(strips, n[0], false, least, false);
    int lit = boundary(strips, n[0], true, most, true);
    return (struct span){{full, count}, {lit, full}};
  }
  int full = boundary(strips, n[0], true, least, false);
  int lit = boundary(strips, n[0], false, most, true);
  return (struct span){{0, full}, {full, lit}};
}

static void sum_single(struct row_sum *sum, const struct span *span, const float *const rows[4],
                       struct gather_counts *counts) {
  const struct rule_nodes *u = &sum->nodes[0], *v = &sum->nodes[1];
  const struct kernel *kernel = &sum->seen->kernel;
  int first = span->full[0], count = span->full[1] - first;
  double weight[4], y = v->at[sum->row];
  for (int tap = 0; tap < 4; ++tap) weight[tap] = v->weight[sum->row][tap] / sum->unit[1];
  for (int light = MATTE; light <= (kernel->shininess > 0 ? GLOSS : MATTE); ++light) {
    (light == GLOSS ? kernel_gloss : kernel_matte)(kernel, u->at + first, y, count, sum->kernel);
    for (int c = 0; c < count; ++c) sum->factor[c] = (float)sum->kernel[c];
    if (sum->rule == RULE_VIEWS)
      for (int c = 0; c < count; ++c) sum->factor[c] = fmaxf(sum->factor[c], 0);
    taps_sum_row(rows, weight, sum->columns + first, sum->factor, count, sum->rgb[light]);
    counts->nodes += (uint64_t)count;
  }
}

static void sum_gauss(struct row_sum *sum, const struct span *span, const float *const rows[4],
                      struct gather_counts *counts) {
  const struct rule_nodes *u = &sum->nodes[0], *v = &sum->nodes[1];
  const struct kernel *kernel = &sum->seen->kernel;
  int first = u->first[span->full[0]], count = u->first[span->full[1]] - first;
  int row = v->first[sum->row], row_nodes = v->first[sum->row + 1] - row;
  const double *at[RULE_LARGEST_ORDER];
  const struct taps_cells cells = {rows,
                                   row_nodes,
                                   (const double(*)[4])v->weight + row,
                                   at,
                                   u->first[span->full[0]],
                                   (const int(*)[2])sum->offset,
                                   u->first,
                                   (const double(*)[4])u->weight};
  for (int light = MATTE; light <= (kernel->shininess > 0 ? GLOSS : MATTE); ++light) {
    for (int h = 0; h < row_nodes; ++h) {
      double *out = sum->kernel + (size_t)h * sum->kernel_room;
      (light == GLOSS ? kernel_gloss : kernel_matte)(kernel, u->at + first, v->at[row + h], count,
                                                     out);
      at[h] = out;
    }
    taps_sum_cells(&cells, span->full[0], span->full[1], sum->rgb[light]);
    counts->nodes += (uint64_t)count * (uint64_t)row_nodes;
  }
}

/* Micro lights that the tangent plane cuts: a few a row. */
static void sum_cut(struct row_sum *sum, const struct span *span, const float *const rows[4],
                    struct gather_counts *counts) {
  const struct rule_nodes *u = &sum->nodes[0], *v = &sum->nodes[1];
  const struct strip *row = &v->strips.strip[sum->row];
  const struct kernel *kernel = &sum->seen->kernel;
  double scale = 1 / (sum->unit[0] * sum->unit[1]);
  for (int c = span->cut[0]; c < span->cut[1]; ++c) {
    double weight[4][4] = {{0}}, gloss[4][4] = {{0}};
    int nodes = u->first[c + 1] - u->first[c], others = v->first[sum->row + 1] - v->first[sum->row];
    int order = (nodes > others ? nodes : others) + 2;
    if (order > RULE_LARGEST_ORDER) order = RULE_LARGEST_ORDER;
    counts->nodes += (uint64_t)tangent_weights(kernel, &u->strips.strip[c], row, order, weight,
                                               kernel->shininess > 0 ? gloss : NULL);
    double rgb[2][3] = {{0}};
    taps_sum_cell(rows, sum->offset[c], (const double(*)[4])weight, rgb[MATTE]);
    if (kernel->shininess > 0)
      taps_sum_cell(rows, sum->offset[c], (const double(*)[4])gloss, rgb[GLOSS]);
    for (int k = 0; k < 3; ++k) {
      sum->rgb[MATTE][k] += rgb[MATTE][k] * scale;
      sum->rgb[GLOSS][k] += rgb[GLOSS][k] * scale;
    }
  }
}

/* Where any of the row's samples is not 0. */
static struct lit_row find_lit(const struct seen_page *seen, const struct strip_taps *taps) {
  const struct lit_row *rows = seen->page->lit;
  int count = seen->page->axes[1].far_count;
  struct lit_row lit = rows[taps->near * count + taps->far];
  for (int tap = 1; tap < 4; ++tap) {
    int near = taps->near + (tap >> 1) * taps->near_up, far = taps->far + (tap & 1) * taps->far_up;
    lit = lit_rows_join(&lit, &rows[near * count + far]);
  }
  return lit;
}

static bool is_black(const struct strip_taps *taps, const struct lit_row *lit) {
  return taps->near + taps->near_up < lit->near[0] || taps->near > lit->near[1] ||
         taps->far + taps->far_up < lit->far[0] || taps->far > lit->far[1];
}

/* Strips ascend or descend through the samples, so the black ones are at the ends. */
static void trim(const struct strips *strips, const struct lit_row *lit, int range[2],
                 uint64_t *black) {
  int before = range[1] - range[0];
  while (range[0] < range[1] && is_black(&strips->strip[range[0]].taps, lit)) ++range[0];
  while (range[0] < range[1] && is_black(&strips->strip[range[1] - 1].taps, lit)) --range[1];
  *black += (uint64_t)(before - (range[1] - range[0]));
}

static void add_row(struct row_sum *sum, struct gather_counts *counts) {
  const struct strip *row = &sum->nodes[1].strips.strip[sum->row];
  const struct lit_row lit = find_lit(sum->seen, &row->taps);
  struct span span = find_span(sum, row);
  const float *rows[4];
  if (sum->skip_black) {
    trim(&sum->nodes[0].strips, &lit, span.full, &counts->black);
    trim(&sum->nodes[0].strips, &lit, span.cut, &counts->black);
  }
  seen_page_rows(sum->seen, &row->taps, rows);
  if (span.full[1] > span.full[0])
    (sum->rule == RULE_GAUSS ? sum_gauss : sum_single)(sum, &span, rows, counts);
  sum_cut(sum, &span, rows, counts);
  counts->microlights +=
      (uint64_t)(span.full[1] - span.full[0]) + (uint64_t)(span.cut[1] - span.cut[0]);
}

enum result row_sum_light(struct row_sum *sum, const struct seen_page *seen,
                          const struct strips strips[2], enum rule rule,
                          const struct rule_orders *orders, double irradiance[3], double gloss[3],
                          struct gather_counts *counts, struct error *error) {
  sum->seen = seen;
  sum->rule = rule;
  enum result result = prepare(sum, strips, orders, error);
  if (result != RESULT_OK) return result;
  for (sum->row = 0; sum->row < sum->nodes[1].strips.count; ++sum->row) add_row(sum, counts);
  for (int c = 0; c < 3; ++c) {
    irradiance[c] = sum->rgb[MATTE][c] * sum->unit[0] * sum->unit[1];
    gloss[c] = sum->rgb[GLOSS][c] * sum->unit[0] * sum->unit[1];
  }
  return RESULT_OK;
}
