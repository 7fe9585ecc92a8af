/* slab_flux.c - the flux of the interpolated slab, as a weight for each sample.
 *
 * With x = s - kappa a and y = t - kappa b, cos(theta) dOmega = ds dt / (1 + x^2
 * + y^2)^2 = K ds dt. Sample (i,j,k,l) is interpolated with a hat function along
 * each axis, so that its weight is
 *     W = int int rho_ik(x) rho_jl(y) K(x, y) dx dy,
 * where rho_ik(x) = int phi_i(a) phi_k(x + kappa a) da is a cubic between the
 * points where the hats' corners meet. Each rho becomes a Gauss rule of its own,
 * long enough for K; W is the sum of K over the product of two rules. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/slab.h"
#include "slab/slab_gauss.h"

static const double tolerance = 1e-8;

enum {
  PIECE_NODES = 8,  /* Gauss nodes on a piece of rho */
  PIECE_ORDER = 6,  /* what K alone may need there: rho is a cubic */
  MAX_NODES = 4096, /* of one rule before it is compressed; never reached: a
                       piece halves at most 40 times towards each of the poles */
  CORNERS = 4
};

/* The interpolation function of one sample: linear between its corners. */
struct hat {
  double x[CORNERS], y[CORNERS];
};

static struct hat make_hat(const struct slab *slab, int axis, int index) {
  double c = slab_position(slab, axis, index), h = slab_spacing(slab, axis);
  bool first = index == 0, last = index == slab->samples[axis] - 1;
  struct hat hat;
  hat.x[0] = first ? c - h / 2 : c - h;
  hat.y[0] = first ? 1 : 0;
  hat.x[1] = hat.x[2] = c;
  hat.y[1] = hat.y[2] = 1;
  hat.x[3] = last ? c + h / 2 : c + h;
  hat.y[3] = last ? 1 : 0;
  return hat;
}

static double hat_value(const struct hat *hat, double x) {
  if (x < hat->x[0] || x > hat->x[3]) return 0;
  int k = x < hat->x[1] ? 0 : 2;
  return hat->y[k] + (hat->y[k + 1] - hat->y[k]) * (x - hat->x[k]) / (hat->x[k + 1] - hat->x[k]);
}

static int ascending(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* int phi_i(a) phi_k(x + kappa a) da: a quadratic between corners, for which
 * two Gauss nodes are exact. */
static double density(const struct hat *uv, const struct hat *st, double kappa, double x) {
  double corners[2 * CORNERS];
  int count = CORNERS;
  memcpy(corners, uv->x, sizeof uv->x);
  for (int k = 0; k < CORNERS && kappa > 0; ++k) {
    double a = (st->x[k] - x) / kappa;
    if (a > uv->x[0] && a < uv->x[3]) corners[count++] = a;
  }
  qsort(corners, (size_t)count, sizeof *corners, ascending);
  double sum = 0;
  for (int k = 0; k + 1 < count; ++k) {
    double middle = (corners[k] + corners[k + 1]) / 2, half = (corners[k + 1] - corners[k]) / 2;
    for (int side = -1; side <= 1; side += 2) {
      double a = middle + side * half * 0.57735026918962576;
      sum += half * hat_value(uv, a) * hat_value(st, x + kappa * a);
    }
  }
  return sum;
}

/* Quadrature nodes, growing. */
struct rule {
  int count;
  double x[MAX_NODES], w[MAX_NODES], scratch[2 * MAX_NODES];
};

struct builder {
  const struct hat *uv, *st;
  double kappa;
  double nodes[PIECE_NODES], weights[PIECE_NODES];
  struct rule *rule;
};

/* Halves a piece until K is smooth on it. */
static void add_piece(struct builder *b, double low, double high, int depth) {
  double middle = (low + high) / 2, half = (high - low) / 2;
  if (depth > 0 && slab_gauss_order(low, high, tolerance / 10) > PIECE_ORDER) {
    add_piece(b, low, middle, depth - 1);
    add_piece(b, middle, high, depth - 1);
    return;
  }
  for (int k = 0; k < PIECE_NODES && b->rule->count < MAX_NODES; ++k) {
    double x = middle + half * b->nodes[k];
    b->rule->x[b->rule->count] = x;
    b->rule->w[b->rule->count++] = half * b->weights[k] * density(b->uv, b->st, b->kappa, x);
  }
}

/* The rule for the pair of samples (i, k) of one axis pair. */
static void build_rule(const struct slab *slab, int axis, int i, int k, struct rule *rule) {
  struct hat uv = make_hat(slab, axis, i), st = make_hat(slab, axis + SLAB_S, k);
  struct builder b = {.uv = &uv, .st = &st, .kappa = slab_kappa(slab), .rule = rule};
  slab_gauss_legendre(PIECE_NODES, b.nodes, b.weights);
  double corners[CORNERS * CORNERS];
  int count = 0;
  for (int m = 0; m < CORNERS; ++m)
    for (int n = 0; n < CORNERS; ++n) corners[count++] = st.x[m] - b.kappa * uv.x[n];
  qsort(corners, (size_t)count, sizeof *corners, ascending);
  rule->count = 0;
  for (int m = 0; m + 1 < count; ++m)
    if (corners[m + 1] > corners[m]) add_piece(&b, corners[m], corners[m + 1], 40);
  int order = slab_gauss_order(corners[0], corners[count - 1], tolerance);
  if (order >= rule->count || order > SLAB_GAUSS_MAX) return;
  double nodes[SLAB_GAUSS_MAX], weights[SLAB_GAUSS_MAX];
  rule->count =
      slab_gauss_compress(rule->count, rule->x, rule->w, order, nodes, weights, rule->scratch);
  memcpy(rule->x, nodes, (size_t)rule->count * sizeof *nodes);
  memcpy(rule->w, weights, (size_t)rule->count * sizeof *weights);
}

/* The rules of all columns (or of all rows). */
struct nodes {
  int count;
  double *x, *w; /* one block of memory, owned */
};

static void free_rules(struct nodes *rules, size_t count) {
  for (size_t n = 0; rules && n < count; ++n) free(rules[n].x);
  free(rules);
}

/* `axis` is SLAB_U for columns, SLAB_V for rows. NULL without memory. */
static struct nodes *make_rules(const struct slab *slab, int axis, size_t count) {
  size_t slopes = (size_t)slab->samples[axis + SLAB_S];
  struct rule *rule = malloc(sizeof *rule);
  struct nodes *rules = calloc(count, sizeof *rules);
  bool good = rule && rules;
  for (size_t n = 0; n < count && good; ++n) {
    build_rule(slab, axis, (int)(n / slopes), (int)(n % slopes), rule);
    size_t nodes = (size_t)rule->count;
    double *x = malloc((2 * nodes + 1) * sizeof *x);
    good = x != NULL;
    if (!good) break;
    memcpy(x, rule->x, nodes * sizeof *x);
    memcpy(x + nodes, rule->w, nodes * sizeof *x);
    rules[n] = (struct nodes){rule->count, x, x + nodes};
  }
  free(rule);
  if (good) return rules;
  free_rules(rules, count);
  return NULL;
}

static double weight(const struct nodes *column, const struct nodes *row) {
  const double *x = column->x, *w = column->w;
  int count = column->count;
  double sum = 0;
  for (int q = 0; q < row->count; ++q) {
    double base = 1 + row->x[q] * row->x[q], line = 0;
    for (int p = 0; p < count; ++p) {
      double reciprocal = 1 / (base + x[p] * x[p]);
      line += w[p] * reciprocal * reciprocal;
    }
    sum += row->w[q] * line;
  }
  return sum;
}

/* Adds the row (j, l) with the weights of its columns; those of one view serve
 * all when there are no more. */
static void add_row(const struct slab *slab, int j, int l, const double *weights, bool one_view,
                    double rgb[3]) {
  const float *sample = slab_at(slab, 0, j, 0, l);
  for (int i = 0; i < slab->samples[SLAB_U]; ++i)
    for (int k = 0; k < slab->samples[SLAB_S]; ++k, sample += 3) {
      double w = weights[one_view ? k : i * slab->samples[SLAB_S] + k];
      for (int c = 0; c < 3; ++c) rgb[c] += w * (double)sample[c];
    }
}

enum result slab_flux(const struct slab *slab, double rgb[3], struct error *error) {
  /* With the st plane at infinity all views have the same weights. */
  bool one_view = slab_kappa(slab) == 0;
  size_t ns = (size_t)slab->samples[SLAB_S], nt = (size_t)slab->samples[SLAB_T];
  size_t columns_count = one_view ? ns : ns * (size_t)slab->samples[SLAB_U];
  size_t rows_count = one_view ? nt : nt * (size_t)slab->samples[SLAB_V];
  struct nodes *columns = make_rules(slab, SLAB_U, columns_count);
  struct nodes *rows = make_rules(slab, SLAB_V, rows_count);
  double *weights = calloc(columns_count, sizeof *weights);
  bool good = columns && rows && weights;
  rgb[0] = rgb[1] = rgb[2] = good ? 0 : NAN;
  for (int l = 0; l < slab->samples[SLAB_T] && good; ++l)
    for (int j = 0; j < slab->samples[SLAB_V]; ++j) {
      size_t row = (size_t)j * nt + (size_t)l;
      if (row < rows_count)
        for (size_t k = 0; k < columns_count; ++k) weights[k] = weight(&columns[k], &rows[row]);
      add_row(slab, j, l, weights, one_view, rgb);
    }
  free(weights);
  free_rules(columns, columns_count);
  free_rules(rows, rows_count);
  return good ? RESULT_OK : result_no_memory(error);
}

enum result slab_flux_metric(const struct slab *slab, double rgb[3], struct error *error) {
  enum result result = slab_flux(slab, rgb, error);
  for (int c = 0; c < 3; ++c) rgb[c] *= slab->metres_per_unit * slab->metres_per_unit;
  return result;
}

const char *slab_flux_unit(const struct slab *slab) {
  if (!strcmp(slab->radiance_unit, "W/(sr m2)")) return "W";
  if (!strcmp(slab->radiance_unit, "cd/m2")) return "lm";
  return "relative m2 sr";
}
