/* row_sum.c - see row_sum.h. */
#include "microlight/row_sum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"
#include "microlight/tangent.h"

enum { MATTE, GLOSS };

void row_sum_free(struct row_sum *cells) {
  for (int axis = 0; axis < 2; ++axis) rule_nodes_free(&cells->nodes[axis]);
  free(cells->columns);
  free(cells->offset);
  *cells = (struct row_sum){0};
}

static enum result reserve_columns(struct row_sum *cells, struct error *error) {
  int count = cells->nodes[0].strips.count;
  if (count <= cells->column_room) return RESULT_OK;
  struct taps_column *columns = realloc(cells->columns, (size_t)count * sizeof *columns);
  if (columns) cells->columns = columns;
  int(*offset)[2] = realloc(cells->offset, (size_t)count * sizeof *offset);
  if (offset) cells->offset = offset;
  if (!columns || !offset) return result_fail(error, RESULT_MEMORY, "out of memory");
  cells->column_room = count;
  return RESULT_OK;
}

static double reach(const struct strips *strips) {
  double sum = 0;
  for (int k = 0; k < strips->count; ++k) sum += strips->strip[k].width;
  return sum;
}

static void set_columns(struct row_sum *cells) {
  const struct rule_nodes *u = &cells->nodes[0];
  for (int c = 0; c < u->strips.count; ++c) {
    seen_page_columns(&cells->seen, &u->strips.strip[c].taps, cells->offset[c]);
    if (cells->kind == ROW_SUM_GAUSS) continue;
    double weight[4];
    for (int tap = 0; tap < 4; ++tap) weight[tap] = u->weight[c][tap] / cells->unit[0];
    taps_set_column(&cells->columns[c], cells->offset[c], weight);
  }
}

enum result row_sum_prepare(struct row_sum *cells, const struct seen_page *seen,
                            const struct strips strips[2], enum row_sum_kind kind, enum rule rule,
                            const struct rule_orders *orders, struct error *error) {
  cells->seen = *seen;
  cells->kind = kind;
  cells->row = 0;
  memset(cells->rgb, 0, sizeof cells->rgb);
  enum result result = RESULT_OK;
  double low[2], high[2], range[2];
  for (int axis = 0; axis < 2 && result == RESULT_OK; ++axis) {
    const struct strips *along = &strips[axis];
    low[axis] = along->strip[0].low;
    high[axis] = along->strip[along->count - 1].high;
    cells->unit[axis] = kind == ROW_SUM_GAUSS ? 1 : reach(along);
    if (axis == 1 && kind != ROW_SUM_GAUSS) cells->unit[axis] *= seen->page->unit;
    double pole = fmin(rule_pole(&strips[1 - axis]), kernel_pole(&seen->kernel));
    result = rule_place(along, rule, orders, pole, &cells->nodes[axis], error);
  }
  if (result == RESULT_OK) result = reserve_columns(cells, error);
  if (result != RESULT_OK) return result;
  kernel_heights(&seen->kernel, low, high, range);
  cells->above = range[0] >= 0;
  set_columns(cells);
  return RESULT_OK;
}

void row_sum_scratch_free(struct row_sum_scratch *scratch) {
  free(scratch->kernel);
  free(scratch->factor);
  *scratch = (struct row_sum_scratch){0};
}

static size_t padded(size_t count) {
  return (count + 2 * SIMD_LANES) / SIMD_LANES * SIMD_LANES;
}

enum result row_sum_scratch_reserve(struct row_sum_scratch *scratch, const struct row_sum *cells,
                                    struct error *error) {
  size_t room = padded((size_t)cells->nodes[0].count);
  if (room <= scratch->room) return RESULT_OK;
  row_sum_scratch_free(scratch);
  scratch->kernel = calloc(room * RULE_LARGEST_ORDER, sizeof *scratch->kernel);
  scratch->factor = calloc(room, sizeof *scratch->factor);
  if (!scratch->kernel || !scratch->factor)
    return result_fail(error, RESULT_MEMORY, "out of memory");
  scratch->room = room;
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

static struct span find_span(const struct row_sum *cells, const struct strip *row) {
  const struct strips *strips = &cells->nodes[0].strips;
  const double *n = cells->seen.kernel.normal;
  int count = strips->count;
  if (cells->above || cells->kind == ROW_SUM_VIEWS) return (struct span){{0, count}, {0, 0}};
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

static void sum_single(struct row_sum *cells, const struct span *span, const float *const rows[4],
                       struct row_sum_scratch *scratch, struct row_sum_counts *counts) {
  const struct rule_nodes *u = &cells->nodes[0], *v = &cells->nodes[1];
  const struct kernel *kernel = &cells->seen.kernel;
  int first = span->full[0], count = span->full[1] - first;
  double weight[4], y = v->at[cells->row];
  for (int tap = 0; tap < 4; ++tap) weight[tap] = v->weight[cells->row][tap] / cells->unit[1];
  for (int light = MATTE; light <= (kernel->shininess > 0 ? GLOSS : MATTE); ++light) {
    (light == GLOSS ? kernel_gloss : kernel_matte)(kernel, u->at + first, y, count,
                                                   scratch->kernel);
    for (int c = 0; c < count; ++c) scratch->factor[c] = (float)scratch->kernel[c];
    if (cells->kind == ROW_SUM_VIEWS)
      for (int c = 0; c < count; ++c) scratch->factor[c] = fmaxf(scratch->factor[c], 0);
    taps_sum_row(rows, weight, cells->columns + first, scratch->factor, count, cells->rgb[light]);
    counts->nodes += (uint64_t)count;
  }
}

static void sum_gauss(struct row_sum *cells, const struct span *span, const float *const rows[4],
                      struct row_sum_scratch *scratch, struct row_sum_counts *counts) {
  const struct rule_nodes *u = &cells->nodes[0], *v = &cells->nodes[1];
  const struct kernel *kernel = &cells->seen.kernel;
  int first = u->first[span->full[0]], count = u->first[span->full[1]] - first;
  int row = v->first[cells->row], row_nodes = v->first[cells->row + 1] - row;
  const double *at[RULE_LARGEST_ORDER];
  const struct taps_cells sum = {rows,
                                 row_nodes,
                                 (const double(*)[4])v->weight + row,
                                 at,
                                 u->first[span->full[0]],
                                 (const int(*)[2])cells->offset,
                                 u->first,
                                 (const double(*)[4])u->weight};
  for (int light = MATTE; light <= (kernel->shininess > 0 ? GLOSS : MATTE); ++light) {
    for (int h = 0; h < row_nodes; ++h) {
      double *out = scratch->kernel + (size_t)h * scratch->room;
      (light == GLOSS ? kernel_gloss : kernel_matte)(kernel, u->at + first, v->at[row + h], count,
                                                     out);
      at[h] = out;
    }
    taps_sum_cells(&sum, span->full[0], span->full[1], cells->rgb[light]);
    counts->nodes += (uint64_t)count * (uint64_t)row_nodes;
  }
}

/* Micro lights that the tangent plane cuts: a few a row. */
static void sum_cut(struct row_sum *cells, const struct span *span, const float *const rows[4],
                    struct row_sum_counts *counts) {
  const struct rule_nodes *u = &cells->nodes[0], *v = &cells->nodes[1];
  const struct strip *row = &v->strips.strip[cells->row];
  const struct kernel *kernel = &cells->seen.kernel;
  double scale = 1 / (cells->unit[0] * cells->unit[1]);
  for (int c = span->cut[0]; c < span->cut[1]; ++c) {
    double weight[4][4] = {{0}}, gloss[4][4] = {{0}};
    int nodes = u->first[c + 1] - u->first[c],
        others = v->first[cells->row + 1] - v->first[cells->row];
    int order = (nodes > others ? nodes : others) + 2;
    if (order > RULE_LARGEST_ORDER) order = RULE_LARGEST_ORDER;
    counts->nodes += (uint64_t)tangent_weights(kernel, &u->strips.strip[c], row, order, weight,
                                               kernel->shininess > 0 ? gloss : NULL);
    double rgb[2][3] = {{0}};
    taps_sum_cell(rows, cells->offset[c], (const double(*)[4])weight, rgb[MATTE]);
    if (kernel->shininess > 0)
      taps_sum_cell(rows, cells->offset[c], (const double(*)[4])gloss, rgb[GLOSS]);
    for (int k = 0; k < 3; ++k) {
      cells->rgb[MATTE][k] += rgb[MATTE][k] * scale;
      cells->rgb[GLOSS][k] += rgb[GLOSS][k] * scale;
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

void row_sum_add_row(struct row_sum *cells, struct row_sum_scratch *scratch,
                     struct row_sum_counts *counts) {
  const struct strip *row = &cells->nodes[1].strips.strip[cells->row];
  const struct lit_row lit = find_lit(&cells->seen, &row->taps);
  struct span span = find_span(cells, row);
  const float *rows[4];
  if (cells->skip_black) {
    trim(&cells->nodes[0].strips, &lit, span.full, &counts->black);
    trim(&cells->nodes[0].strips, &lit, span.cut, &counts->black);
  }
  seen_page_rows(&cells->seen, &row->taps, rows);
  if (span.full[1] > span.full[0])
    (cells->kind == ROW_SUM_GAUSS ? sum_gauss : sum_single)(cells, &span, rows, scratch, counts);
  sum_cut(cells, &span, rows, counts);
  counts->microlights +=
      (uint64_t)(span.full[1] - span.full[0]) + (uint64_t)(span.cut[1] - span.cut[0]);
  ++cells->row;
}

void row_sum_result(const struct row_sum *cells, double irradiance[3], double gloss[3]) {
  for (int c = 0; c < 3; ++c) {
    irradiance[c] = cells->rgb[MATTE][c] * cells->unit[0] * cells->unit[1];
    gloss[c] = cells->rgb[GLOSS][c] * cells->unit[0] * cells->unit[1];
  }
}
