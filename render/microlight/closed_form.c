/* closed_form.c - for each micro light:
 *   1. The antiderivatives Phi_ab at its corners and the moments I_ab of the kernel (corner,
 *      moments).
 *   2. The weights of its samples, quadratics in the slopes along each axis (quadratics).
 *   3. Both multiplied and summed (find_weights).
 * Where that cancels too many digits (applies), or the tangent plane cuts it: Gauss rules. */
#include "microlight/closed_form.h"

#include <math.h>

#include "base/simd.h"
#include "microlight/tangent.h"
#include "slab/slab_gauss.h"

/* Distance from the foot. */
static double farness(const struct strip *strip) {
  return strip->low > 0 ? strip->low : strip->high < 0 ? -strip->high : 0;
}

/* Narrow, remote or oblong micro lights cancel away too many digits. */
static bool applies(const struct strip *u, const struct strip *v) {
  const struct strip *strips[2] = {u, v};
  for (int axis = 0; axis < 2; ++axis) {
    double width = strips[axis]->high - strips[axis]->low;
    if (!(width > 0.5) || farness(strips[axis]) > fmin(4, 2 * width)) return false;
  }
  return true;
}

/* int_0^x atan(t)/t dt, 0 <= x <= 1. The integrand's nearest singularities are at +-i: 14
 * nodes leave 1e-18. */
static double inverse_tangent_integral(double x) {
  enum { NODES = 14 };
  double node[NODES], weight[NODES], sum = 0;
  if (!(x > 0)) return 0;
  slab_gauss_legendre(NODES, node, weight);
  for (int k = 0; k < NODES; ++k) {
    double t = x * (1 + node[k]) / 2;
    sum += weight[k] / 2 * (t > 0 ? atan(t) / t : 1);
  }
  return x * sum;
}

/* int_0^x int_0^y 1/(1 + x^2 + y^2) */
static double corner_f(double x, double y) {
  double a = asinh(fabs(x)), b = asinh(fabs(y)), sign = (x < 0) == (y < 0) ? 1 : -1;
  if (x == 0 || y == 0) return 0;
  return sign * (M_PI_2 * fmin(a, b) - inverse_tangent_integral(exp(-fabs(a - b))) +
                 inverse_tangent_integral(exp(-(a + b))));
}

/* phi[a][b] at a corner; phi[3][3] is not needed. */
static void corner(double x, double y, double phi[4][4]) {
  double cx2 = x * x + 1, cy2 = y * y + 1, cx = sqrt(cx2), cy = sqrt(cy2);
  double A = atan(y / cx), B = atan(x / cy), l = log(x * x + y * y + 1), F = corner_f(x, y);
  phi[0][0] = (x * A / cx + y * B / cy) / 2;
  phi[1][0] = -A / (2 * cx);
  phi[0][1] = -B / (2 * cy);
  phi[1][1] = -l / 4;
  phi[1][2] = cx * A / 2;
  phi[2][1] = cy * B / 2;
  phi[1][3] = cx2 * l / 4;
  phi[3][1] = cy2 * l / 4;
  phi[2][0] = (F - x * A / cx) / 2;
  phi[0][2] = (F - y * B / cy) / 2;
  phi[2][2] = (-x * y + x * cx * A + y * cy * B - F) / 4;
  phi[3][0] = (y * l + 2 * cx * A - x * x * A / cx) / 2;
  phi[0][3] = (x * l + 2 * cy * B - y * y * B / cy) / 2;
  phi[3][2] = (y * y * y * l / 3 - x * x * y / 3 - 2 * cx2 * cx * A / 3 + x * x * cx * A) / 2;
  phi[2][3] = (x * x * x * l / 3 - y * y * x / 3 - 2 * cy2 * cy * B / 3 + y * y * cy * B) / 2;
  phi[3][3] = 0;
}

static void moments(const struct strip *u, const struct strip *v, double moment[4][4]) {
  double low[4][4], high[4][4], left[4][4], right[4][4];
  corner(u->low, v->low, low);
  corner(u->high, v->high, high);
  corner(u->low, v->high, left);
  corner(u->high, v->low, right);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      moment[a][b] = (high[a][b] - left[a][b]) - (right[a][b] - low[a][b]);
}

/* The weight of each sample as a quadratic in the slope: coefficient[sample][power]. */
static void quadratics(const struct strip *strip, double coefficient[4][3]) {
  double width = strip->high - strip->low;
  for (int sample = 0; sample < 4; ++sample) {
    double line[2][2]; /* of the near and the far weight: constant, rise */
    for (int which = 0; which < 2; ++which) {
      const double *weight = which ? strip->far_weight : strip->near_weight;
      bool upper = which ? sample & 1 : sample >> 1;
      double start = upper ? weight[0] : 1 - weight[0];
      double rise = (upper ? 1 : -1) * (weight[1] - weight[0]) / width;
      line[which][0] = start - rise * strip->low;
      line[which][1] = rise;
    }
    coefficient[sample][0] = line[0][0] * line[1][0];
    coefficient[sample][1] = line[0][0] * line[1][1] + line[0][1] * line[1][0];
    coefficient[sample][2] = line[0][1] * line[1][1];
  }
}

/* Weights of the samples, [sample along v][sample along u] in rule.h's order, for the irradiance
 * of a receiver with the unit normal. */
static void find_weights(const double normal[3], const struct strip *u, const struct strip *v,
                         double weight[4][4]) {
  double moment[4][4], along_u[4][3], along_v[4][3];
  moments(u, v, moment);
  quadratics(u, along_u);
  quadratics(v, along_v);
  double kernel[3][3]; /* of x^a y^b */
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      kernel[a][b] =
          normal[0] * moment[a + 1][b] + normal[1] * moment[a][b + 1] - normal[2] * moment[a][b];
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      double sum = 0;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) sum += along_u[x][a] * along_v[y][b] * kernel[a][b];
      weight[y][x] = sum;
    }
}

/* ---- The sum ---- */

/* Of the Gauss rules where the closed form does not apply. */
static const double tolerance = 1e-11;

/* A part of a micro light for which one Gauss rule suffices. */
static void add_part(const struct seen_page *seen, const struct rule_nodes nodes[2],
                     const int part[2], double weight[4][4], struct gather_counts *counts) {
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
                     struct gather_counts *counts) {
  double weight[4][4] = {{0}}, range[2];
  int offset[2];
  kernel_heights(&seen->kernel, (double[2]){u->low, v->low}, (double[2]){u->high, v->high}, range);
  if (range[1] <= 0) return;
  ++counts->microlights;
  if (range[0] >= 0 && applies(u, v)) {
    find_weights(seen->kernel.normal, u, v, weight);
  } else {
    for (int j = parts[1].first; j < parts[1].last; ++j)
      for (int i = parts[0].first; i < parts[0].last; ++i)
        add_part(seen, nodes, (int[2]){i, j}, weight, counts);
  }
  seen_page_columns(seen, &u->taps, offset);
  taps_sum_cell(rows, offset, (const double(*)[4])weight, irradiance);
}

enum result closed_form_sum(const struct seen_page *seen, const struct strips strips[2],
                            struct rule_nodes nodes[2], double irradiance[3],
                            struct gather_counts *counts, struct error *error) {
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
