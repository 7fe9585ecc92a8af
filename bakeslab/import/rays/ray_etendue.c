/* ray_etendue.c - a Gauss rule for x of each column of cells and one for y of each row.
 *
 * 1. s is cut into pieces, each halved until 8 nodes integrate the cosines over it (slab_gauss.h).
 *    With the st plane at infinity these nodes are the column's x. Else x = s - kappa a at these
 *    nodes of s and a few of a.
 * 2. The etendue of a cell is the sum of 1/(1 + x^2 + y^2)^2 over the nodes of its column and row.
 *    With the st plane at infinity all views are alike. */
#include "import/rays/ray_etendue.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/slab_gauss.h"

static const double tolerance = 1e-10;

enum {
  PIECE_NODES = 8,
  MAX_NODES = 4096,  /* never reached: a piece halves at most 40 times towards each of the poles */
  MAX_VIEW_NODES = 3 /* over the a of a cell, where the cosines hardly change */
};

struct rule {
  int count;
  double x[MAX_NODES], w[MAX_NODES];
};

static void add_piece(struct rule *rule, double low, double high, int depth) {
  double middle = (low + high) / 2, half = (high - low) / 2, nodes[PIECE_NODES];
  double weights[PIECE_NODES];
  int order = slab_gauss_order(low, high, tolerance);
  if (depth > 0 && order > PIECE_NODES) {
    add_piece(rule, low, middle, depth - 1);
    add_piece(rule, middle, high, depth - 1);
    return;
  }
  if (order > PIECE_NODES) order = PIECE_NODES;
  slab_gauss_legendre(order, nodes, weights);
  for (int n = 0; n < order && rule->count < MAX_NODES; ++n) {
    rule->x[rule->count] = middle + half * nodes[n];
    rule->w[rule->count++] = half * weights[n];
  }
}

/* The rule of the cells (index, slope) of an axis pair, by way of `slopes`, a rule for scratch. */
static void build_rule(const struct slab *slab, int axis, int index, int slope, struct rule *slopes,
                       struct rule *rule) {
  double kappa = slab_kappa(slab), nodes[MAX_VIEW_NODES], weights[MAX_VIEW_NODES];
  double a = slab_position(slab, axis, index), da = slab_spacing(slab, axis);
  double s = slab_position(slab, axis + SLAB_S, slope), ds = slab_spacing(slab, axis + SLAB_S);
  int views = kappa > 0 ? MAX_VIEW_NODES : 1;
  slab_gauss_legendre(views, nodes, weights);
  rule->count = 0;
  for (int n = 0; n < views; ++n) {
    double shift = kappa * (a + da / 2 * nodes[n]);
    slopes->count = 0;
    add_piece(slopes, s - ds / 2 - shift, s + ds / 2 - shift, 40);
    for (int k = 0; k < slopes->count && rule->count < MAX_NODES; ++k) {
      rule->x[rule->count] = slopes->x[k];
      rule->w[rule->count++] = da / 2 * weights[n] * slopes->w[k];
    }
  }
}

static double cell(const struct rule *column, const struct rule *row) {
  double sum = 0;
  for (int q = 0; q < row->count; ++q) {
    double base = 1 + row->x[q] * row->x[q], line = 0;
    for (int p = 0; p < column->count; ++p) {
      double reciprocal = 1 / (base + column->x[p] * column->x[p]);
      line += column->w[p] * reciprocal * reciprocal;
    }
    sum += row->w[q] * line;
  }
  return sum;
}

/* All rows of cells, by the columns' rules. */
static void fill(const struct slab *slab, const struct rule *columns, struct rule *slopes,
                 struct rule *row, double *etendue) {
  bool alike = !(slab_kappa(slab) > 0);
  double area = slab->metres_per_unit * slab->metres_per_unit;
  size_t width = (size_t)slab_width(slab), ns = (size_t)slab->samples[SLAB_S];
  for (int j = 0; j < slab->samples[SLAB_V]; ++j)
    for (int l = 0; l < slab->samples[SLAB_T]; ++l) {
      double *out = etendue + ((size_t)j * (size_t)slab->samples[SLAB_T] + (size_t)l) * width;
      build_rule(slab, SLAB_V, j, l, slopes, row);
      for (size_t n = 0; n < width; ++n)
        out[n] = alike && n >= ns ? out[n - ns] : area * cell(&columns[alike ? n % ns : n], row);
    }
}

double *ray_etendue(const struct slab *slab) {
  bool alike = !(slab_kappa(slab) > 0);
  size_t ns = (size_t)slab->samples[SLAB_S];
  size_t columns_count = alike ? ns : (size_t)slab_width(slab);
  double *etendue = malloc(slab_sample_count(slab) * sizeof *etendue);
  struct rule *rules = malloc((columns_count + 2) * sizeof *rules);
  if (etendue && rules) {
    struct rule *columns = rules + 2;
    for (size_t n = 0; n < columns_count; ++n)
      build_rule(slab, SLAB_U, (int)(n / ns), (int)(n % ns), &rules[0], &columns[n]);
    fill(slab, columns, &rules[0], &rules[1], etendue);
  } else {
    free(etendue);
    etendue = NULL;
  }
  free(rules);
  return etendue;
}
