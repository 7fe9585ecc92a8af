#include "microlight/tangent.h"

#include <math.h>

#include "base/simd.h"
#include "microlight/rule.h"

/* The plane n_x x + n_y y = n_z as a line: the coordinate `inner` as a function of the other,
 * `outer`, chosen so that its slope is at most 1. Both count from the strips' lower ends: far away
 * strips are narrow, and slopes would cancel. */
struct cut {
  struct kernel kernel;          /* turned, so that x is the inner axis */
  const struct strip *strips[2]; /* along x and y */
  int outer, inner;              /* 0 for x, 1 for y */
  double height;                 /* g where both coordinates are 0 */
};

static double line(const struct cut *cut, double outer) {
  const double *n = cut->kernel.normal;
  return -(cut->height + n[1] * outer) / n[0];
}

/* Ascending outer limits of the trapezoids: the strip's ends and where the line crosses the
 * inner strip's. Returns how many. */
static int limits(const struct cut *cut, double limit[4]) {
  const double *n = cut->kernel.normal, width = cut->strips[cut->outer]->width;
  double cross[2];
  int count = 0;
  limit[count++] = 0;
  if (n[1] != 0) {
    for (int side = 0; side < 2; ++side)
      cross[side] = -(cut->height + (side ? n[0] * cut->strips[cut->inner]->width : 0)) / n[1];
    double first = fmin(cross[0], cross[1]), second = fmax(cross[0], cross[1]);
    if (first > 0 && first < width) limit[count++] = first;
    if (second > limit[count - 1] && second < width) limit[count++] = second;
  }
  limit[count++] = width;
  return count;
}

/* weight[y][x] += of[y] of[x]: the outer axis has its hats, the inner one their integrals. */
static void add(const struct cut *cut, double weight[4][4], const double hats[4],
                const double sums[4]) {
  const double *u = cut->inner ? hats : sums, *v = cut->inner ? sums : hats;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) weight[y][x] += v[y] * u[x];
}

enum { ROOM = RULE_LARGEST_ORDER + SIMD_LANES };

/* The inner integral at one outer node. */
static int inner_nodes(const struct cut *cut, double outer, double share, int order,
                       double weight[4][4], double (*gloss)[4]) {
  const struct strip *inner = cut->strips[cut->inner];
  const struct rule_gauss *gauss = rule_gauss(order);
  double at = fmin(fmax(line(cut, outer), 0), inner->width);
  bool above = cut->kernel.normal[0] > 0;
  double low = above ? at : 0, high = above ? inner->width : at;
  if (!(high > low)) return 0;
  double hats[RULE_LARGEST_ORDER][4], outer_hats[4], slope[ROOM] = {0}, value[ROOM] = {0};
  const struct strip *across = cut->strips[cut->outer];
  rule_hats(across, outer / across->width, outer_hats);
  for (int k = 0; k < order; ++k) {
    double from = low + gauss->at[k] * (high - low);
    slope[k] = inner->low + from;
    rule_hats(inner, from / inner->width, hats[k]);
  }
  for (int light = 0; light < (gloss ? 2 : 1); ++light) {
    double sums[4] = {0};
    (light ? kernel_gloss : kernel_matte)(&cut->kernel, slope, across->low + outer, order, value);
    for (int k = 0; k < order; ++k) {
      if (!(value[k] > 0)) continue;
      const double part = share * gauss->weight[k] * (high - low) * value[k];
      for (int tap = 0; tap < 4; ++tap) sums[tap] += part * hats[k][tap];
    }
    add(cut, light ? gloss : weight, outer_hats, sums);
  }
  return order;
}

int tangent_weights(const struct kernel *kernel, const struct strip *u, const struct strip *v,
                    int order, double weight[4][4], double (*gloss)[4]) {
  const double *n = kernel->normal;
  const int inner = fabs(n[1]) < fabs(n[0]) ? 0 : 1;
  const struct cut cut = {{.normal = {n[inner], n[!inner], n[2]},
                           .eye = {kernel->eye[inner], kernel->eye[!inner], kernel->eye[2]},
                           .shininess = kernel->shininess},
                          {u, v},
                          !inner,
                          inner,
                          kernel_height(kernel, u->low, v->low)};
  if (n[inner] == 0) return 0; /* parallel: all of it or nothing, not cut */
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
