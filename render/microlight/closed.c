/* closed.c - see closed.h. */
#include "microlight/closed.h"

#include "base/simd.h"
#include "microlight/closed_form.h"
#include "microlight/tangent.h"

static const double tolerance = 1e-11;

/* One part of a micro light, which its Gauss nodes suffice for. */
static void add_part(const struct seen_page *seen, const struct rule_nodes nodes[2],
                     const int part[2], double weight[4][4], struct row_sum_counts *counts) {
  const struct strip *strips[2];
  int first[2], count[2];
  for (int axis = 0; axis < 2; ++axis) {
    strips[axis] = &nodes[axis].strips.strip[part[axis]];
    first[axis] = nodes[axis].first[part[axis]];
    count[axis] = nodes[axis].first[part[axis] + 1] - first[axis];
  }
  double range[2];
  kernel_heights(&seen->kernel, (double[2]){strips[0]->low, strips[1]->low},
                 (double[2]){strips[0]->high, strips[1]->high}, range);
  if (range[1] <= 0) return;
  if (range[0] < 0) {
    counts->nodes += (uint64_t)tangent_weights(&seen->kernel, strips[0], strips[1],
                                               RULE_LARGEST_ORDER, weight, NULL);
    return;
  }
  counts->nodes += (uint64_t)count[0] * (uint64_t)count[1];
  for (int h = 0; h < count[1]; ++h)
    for (int g = 0; g < count[0]; ++g) {
      double x[SIMD_LANES] = {nodes[0].at[first[0] + g]}, value[SIMD_LANES];
      kernel_matte(&seen->kernel, x, nodes[1].at[first[1] + h], 1, value);
      for (int row = 0; row < 4; ++row)
        for (int tap = 0; tap < 4; ++tap)
          weight[row][tap] +=
              value[0] * nodes[1].weight[first[1] + h][row] * nodes[0].weight[first[0] + g][tap];
    }
}

/* The parts into which the rule cut the strip: first to last. */
struct parts {
  int first, last;
};

static struct parts next_parts(const struct rule_nodes *nodes, int first,
                               const struct strip *whole) {
  int last = first + 1; /* of a strip that rounds to one slope, too */
  while (last < nodes->strips.count && nodes->strips.strip[last - 1].high < whole->high) ++last;
  return (struct parts){first, last};
}

static void add_cell(const struct seen_page *seen, const struct strip *u, const struct strip *v,
                     const struct rule_nodes nodes[2], const struct parts parts[2],
                     const float *const rows[4], double irradiance[3],
                     struct row_sum_counts *counts) {
  double weight[4][4] = {{0}}, range[2];
  int offset[2];
  kernel_heights(&seen->kernel, (double[2]){u->low, v->low}, (double[2]){u->high, v->high}, range);
  if (range[1] <= 0) return;
  ++counts->microlights;
  if (range[0] >= 0 && closed_form_applies(u, v)) {
    closed_form_weights(seen->kernel.normal, u, v, weight);
  } else {
    for (int j = parts[1].first; j < parts[1].last; ++j)
      for (int i = parts[0].first; i < parts[0].last; ++i)
        add_part(seen, nodes, (int[2]){i, j}, weight, counts);
  }
  seen_page_columns(seen, &u->taps, offset);
  taps_sum_cell(rows, offset, (const double(*)[4])weight, irradiance);
}

enum result closed_sum(const struct seen_page *seen, const struct strips strips[2],
                       struct rule_nodes nodes[2], double irradiance[3],
                       struct row_sum_counts *counts, struct error *error) {
  const struct rule_orders orders = rule_orders(tolerance);
  for (int axis = 0; axis < 2; ++axis) {
    enum result result = rule_place(&strips[axis], RULE_GAUSS, &orders,
                                    rule_pole(&strips[1 - axis]), &nodes[axis], error);
    if (result != RESULT_OK) return result;
  }
  struct parts parts[2] = {{0, 0}, {0, 0}};
  for (int r = 0; r < strips[1].count; ++r) {
    const struct strip *v = &strips[1].strip[r];
    const float *rows[4];
    parts[1] = next_parts(&nodes[1], parts[1].last, v);
    parts[0].last = 0;
    seen_page_rows(seen, &v->taps, rows);
    for (int c = 0; c < strips[0].count; ++c) {
      parts[0] = next_parts(&nodes[0], parts[0].last, &strips[0].strip[c]);
      add_cell(seen, &strips[0].strip[c], v, nodes, parts, rows, irradiance, counts);
    }
  }
  return RESULT_OK;
}
