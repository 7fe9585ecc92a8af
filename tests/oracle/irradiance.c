/* irradiance.c - see oracle.h. The integral over each piece is Gauss-Legendre in y inside
 * Gauss-Legendre in x, on intervals so short that the kernel's poles are far
 * away in terms of their length. Both run from the piece's lower ends: from
 * far away the pieces are short, and nothing of their lengths must be lost. The receiver's tangent
 * plane is a line in (x, y): the inner integral ends there, the outer one is split where the line
 * leaves the piece. */
#include "oracle/oracle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/gauss.h"
#include "oracle/lookup.h"

enum { LESS = 3 };

static const long double rho_min = 2.2L; /* shorter intervals below */
static const long double digits = 42;    /* e^-42 = 6e-19 */

/* Poles of the integrand in the complex plane, each with its conjugate. */
struct poles {
  int count;
  long double re[2], im[2];
};

/* The largest ellipse around [a, b] without a pole: the sum of its axes over
 * b - a. The rule's error falls like rho^-2n. */
static long double ellipse(long double a, long double b, const struct poles *poles) {
  long double middle = (a + b) / 2, half = (b - a) / 2, least = INFINITY;
  for (int k = 0; k < poles->count; ++k) {
    long double re = (poles->re[k] - middle) / half, im = poles->im[k] / half;
    long double sum = (hypotl(re - 1, im) + hypotl(re + 1, im)) / 2;
    long double rho = sum + sqrtl(fmaxl(0, sum * sum - 1));
    if (rho < least) least = rho;
  }
  return least;
}

struct area {
  const struct oracle_piece *outer, *inner;
  long double value[4][4][3]; /* [outer uv, st][inner uv, st][channel] */
  long double n[3];           /* the receiver's normal as to outer, inner, height */
  bool magnitude;             /* integrate |L| */
  int less;                   /* nodes fewer than good */
  long double x;              /* of the outer node, from the foot */
  long double row[4][3];      /* value at x */
};

typedef void integrand(struct area *area, long double x, long double weight, long double sum[3]);

static void integrate(struct area *area, integrand *f, long double a, long double b,
                      const struct poles *poles, long double sum[3]) {
  if (!(a < b)) return;
  long double rho = ellipse(a, b, poles);
  if (rho < rho_min) {
    long double middle = (a + b) / 2;
    integrate(area, f, a, middle, poles, sum);
    integrate(area, f, middle, b, poles, sum);
    return;
  }
  /* 7 more: the polynomial in front of the poles, and the sloping inner limit */
  int n = (int)ceill(digits / (2 * logl(rho))) + 7 - area->less;
  const struct gauss *rule = gauss_rule(n < GAUSS_MOST ? n : GAUSS_MOST);
  for (int k = 0; k < rule->count; ++k)
    f(area, (a + b) / 2 + (b - a) / 2 * rule->x[k], (b - a) / 2 * rule->w[k], sum);
}

/* Weights of the 2 x 2 samples around a piece, `from` its lower end. */
static void weights(const struct oracle_piece *piece, long double from, long double w[4]) {
  long double at = from / piece->width;
  long double f = piece->uv_at[0] + (piece->uv_at[1] - piece->uv_at[0]) * at;
  long double g = piece->st_at[0] + (piece->st_at[1] - piece->st_at[0]) * at;
  w[0] = (1 - f) * (1 - g), w[1] = (1 - f) * g, w[2] = f * (1 - g), w[3] = f * g;
}

static void inner_node(struct area *area, long double from, long double weight,
                       long double sum[3]) {
  long double x = area->x, y = area->inner->x + from, q = 1 + x * x + y * y, w[4];
  long double kernel = weight * (area->n[0] * x + area->n[1] * y - area->n[2]) / (q * q);
  weights(area->inner, from, w);
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 4; ++k) sum[c] += kernel * w[k] * area->row[k][c];
}

/* Where the tangent plane cuts the inner piece. */
static long double tangent(const struct area *area, long double x) {
  return (area->n[2] - area->n[0] * x - area->n[1] * area->inner->x) / area->n[1];
}

static void outer_node(struct area *area, long double from, long double weight,
                       long double sum[3]) {
  long double w[4], x = area->outer->x + from, low = 0, high = area->inner->width;
  weights(area->outer, from, w);
  memset(area->row, 0, sizeof area->row);
  for (int o = 0; o < 4; ++o)
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 3; ++c) area->row[k][c] += weight * w[o] * area->value[o][k][c];
  area->x = x;
  if (area->n[1] > 0) low = fmaxl(low, tangent(area, x));
  if (area->n[1] < 0) high = fminl(high, tangent(area, x));
  if (area->n[1] == 0 && area->n[0] * x - area->n[2] <= 0) return;
  struct poles poles = {.count = 1, .re = {-area->inner->x}, .im = {hypotl(1, x)}};
  integrate(area, inner_node, low, high, &poles, sum);
}

/* |n[0]| <= |n[1]|: the line is never steep. */
static void piece_integral(struct area *area, long double sum[3]) {
  long double low = area->inner->x, high = low + area->inner->width;
  long double near = low > 0 ? low : high < 0 ? -high : 0;
  long double at = area->outer->x, cut[4] = {0, 0, 0, area->outer->width};
  struct poles poles = {.count = 1, .re = {-at}, .im = {hypotl(1, near)}};
  if (area->n[1] != 0) { /* 1 + x^2 + (slope x + rise)^2 = 0 */
    long double slope = -area->n[0] / area->n[1], rise = area->n[2] / area->n[1];
    poles.re[1] = -slope * rise / (1 + slope * slope) - at;
    poles.im[1] = sqrtl(1 + slope * slope + rise * rise) / (1 + slope * slope);
    poles.count = 2;
  }
  if (area->n[0] != 0) {
    long double a = (area->n[2] - area->n[1] * low - area->n[0] * at) / area->n[0];
    long double b = (area->n[2] - area->n[1] * high - area->n[0] * at) / area->n[0];
    cut[1] = fminl(fmaxl(fminl(a, b), cut[0]), cut[3]);
    cut[2] = fminl(fmaxl(fmaxl(a, b), cut[0]), cut[3]);
  }
  for (int k = 0; k < 3; ++k) integrate(area, outer_node, cut[k], cut[k + 1], &poles, sum);
}

/* Samples around a piece; `swap`: the outer axis is v. */
static void gather(const struct slab *slab, struct area *area, bool swap) {
  const struct oracle_piece *u = swap ? area->inner : area->outer;
  const struct oracle_piece *v = swap ? area->outer : area->inner;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const float *rgb =
          oracle_sample(slab, u->uv[a / 2], v->uv[b / 2], u->st[a % 2], v->st[b % 2]);
      for (int c = 0; c < 3; ++c) {
        long double value = (long double)rgb[c];
        area->value[swap ? b : a][swap ? a : b][c] = area->magnitude ? fabsl(value) : value;
      }
    }
}

static long double length_of(const double x[3]) {
  return hypotl(hypotl(x[0], x[1]), x[2]);
}

void oracle_place(const struct slab *slab, const double p[3], const double n[3],
                  struct oracle_place *place) {
  const double *const axes[3] = {slab->u, slab->v, slab->normal};
  for (int r = 0; r < 3; ++r) {
    place->p[r] = place->n[r] = 0;
    for (int k = 0; k < 3; ++k) {
      long double axis = (long double)axes[r][k] / length_of(axes[r]);
      place->p[r] += axis * ((long double)p[k] - (long double)slab->center[k]);
      place->n[r] += axis * (long double)n[k] / length_of(n);
    }
  }
  for (int k = 0; k < 2; ++k) place->half[k] = length_of(axes[k]) / 2;
  place->kappa = isinf(slab->st_distance) ? 0 : 1 / (long double)slab->st_distance;
}

struct oracle_value oracle_irradiance(const struct slab *slab, const double p[3],
                                      const double n[3]) {
  struct oracle_value value = {{0}, {0}, 0};
  static struct oracle_axis axes[2];
  static struct area area;
  struct oracle_place place;
  long double sums[3][3] = {{0}};
  oracle_place(slab, p, n, &place);
  bool swap = fabsl(place.n[0]) > fabsl(place.n[1]);
  area.n[0] = place.n[swap], area.n[1] = place.n[!swap], area.n[2] = place.n[2];
  oracle_axis_find(slab, p, swap, &axes[0]);
  oracle_axis_find(slab, p, !swap, &axes[1]);
  for (int pass = 0; pass < 3; ++pass) {
    area.less = pass == 0 ? 0 : LESS;
    area.magnitude = pass == 2;
    for (int i = 0; i < axes[0].count; ++i)
      for (int j = 0; j < axes[1].count; ++j) {
        area.outer = &axes[0].piece[i], area.inner = &axes[1].piece[j];
        gather(slab, &area, swap);
        piece_integral(&area, sums[pass]);
      }
  }
  for (int c = 0; c < 3; ++c) {
    value.e[c] = sums[0][c];
    value.magnitude[c] = sums[2][c];
    if (sums[2][c] > 0)
      value.error = oracle_larger(value.error, fabsl(sums[0][c] - sums[1][c]) / sums[2][c]);
  }
  return value;
}
