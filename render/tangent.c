/* tangent.c - see tangent.h. */
#include "tangent.h"

#include <math.h>

#include "rule.h"
#include "simd.h"

/* The plane n_x x + n_y y = n_z as a line over the axis along which it changes less: the
 * other coordinate, `inner`, is a function of this one, `outer`, with a slope of at most 1. */
struct cut {
  const struct kernel *kernel;
  const struct strip *strips[2]; /* along x and y */
  int outer, inner;              /* 0 for x, 1 for y */
};

static double line(const struct cut *cut, double outer) {
  const double *n = cut->kernel->normal;
  return (n[2] - n[cut->outer] * outer) / n[cut->inner];
}

/* Ascending outer limits of the trapezoids: the strip's ends and where the line crosses the
 * inner strip's. Returns how many. */
static int limits(const struct cut *cut, double limit[4]) {
  const double *n = cut->kernel->normal;
  const struct strip *outer = cut->strips[cut->outer], *inner = cut->strips[cut->inner];
  double cross[2];
  int count = 0;
  limit[count++] = outer->low;
  if (n[cut->outer] != 0) {
    for (int side = 0; side < 2; ++side)
      cross[side] = (n[2] - n[cut->inner] * (side ? inner->high : inner->low)) / n[cut->outer];
    double first = fmin(cross[0], cross[1]), second = fmax(cross[0], cross[1]);
    if (first > outer->low && first < outer->high) limit[count++] = first;
    if (second > limit[count - 1] && second < outer->high) limit[count++] = second;
  }
  limit[count++] = outer->high;
  return count;
}

/* weight[y][x] += value * v[y] u[x] */
static void add(double weight[4][4], const double v[4], const double u[4], double value) {
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) weight[y][x] += value * v[y] * u[x];
}

/* The inner integral at one outer node. */
static int inner_nodes(const struct cut *cut, double outer, double share, int order,
                       double weight[4][4], double (*gloss)[4]) {
  const struct strip *inner = cut->strips[cut->inner];
  const struct rule_gauss *gauss = rule_gauss(order);
  double at = fmin(fmax(line(cut, outer), inner->low), inner->high);
  bool above = cut->kernel->normal[cut->inner] > 0;
  double low = above ? at : inner->low, high = above ? inner->high : at;
  if (!(high > low)) return 0;
  double hats[2][4], value[SIMD_LANES];
  rule_hats(cut->strips[cut->outer], outer, hats[cut->outer]);
  for (int k = 0; k < order; ++k) {
    double slope[2], x[SIMD_LANES] = {0};
    slope[cut->outer] = outer;
    slope[cut->inner] = low + gauss->at[k] * (high - low);
    rule_hats(inner, slope[cut->inner], hats[cut->inner]);
    double part = share * gauss->weight[k] * (high - low);
    x[0] = slope[0];
    kernel_matte(cut->kernel, x, slope[1], 1, value);
    add(weight, hats[1], hats[0], part * fmax(value[0], 0));
    if (!gloss) continue;
    kernel_gloss(cut->kernel, x, slope[1], 1, value);
    add(gloss, hats[1], hats[0], part * value[0]);
  }
  return order;
}

int tangent_weights(const struct kernel *kernel, const struct strip *u, const struct strip *v,
                    int order, double weight[4][4], double (*gloss)[4]) {
  struct cut cut = {kernel, {u, v}, 0, 1};
  if (fabs(kernel->normal[1]) < fabs(kernel->normal[0])) cut.outer = 1, cut.inner = 0;
  if (kernel->normal[cut.inner] == 0) return 0; /* parallel: all of it or nothing, not cut */
  const struct rule_gauss *gauss = rule_gauss(order);
  double limit[4];
  int nodes = 0;
  for (int k = 0, last = limits(&cut, limit) - 1; k < last; ++k) {
    double width = limit[k + 1] - limit[k];
    for (int node = 0; node < order; ++node)
      nodes += inner_nodes(&cut, limit[k] + gauss->at[node] * width, gauss->weight[node] * width,
                           order, weight, gloss);
  }
  return nodes;
}
