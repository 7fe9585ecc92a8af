/* oracle.c - the integral over each piece: Gauss-Legendre in y inside
 * Gauss-Legendre in x, on intervals so short that the kernel's poles are far
 * away in terms of their length. Both run from the piece's lower ends, from
 * far away the pieces are short and nothing of their lengths must be lost. The receiver's tangent
 * plane is a line in (x, y): the inner integral ends there, the outer one is split where the line
 * leaves the piece. */
#include "oracle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ORDER_MAX = 64, LESS = 3 };

static const long double rho_min = 2.2L; /* shorter intervals below */
static const long double digits = 42;    /* e^-42 = 6e-19 */

struct rule {
  int count;
  long double x[ORDER_MAX], w[ORDER_MAX]; /* on (-1, 1) */
};

static const struct rule *gauss(int n) {
  static struct rule rules[ORDER_MAX + 1];
  struct rule *rule = &rules[n];
  for (int i = rule->count; i < n; ++i, rule->count = i) {
    long double x = cosl(acosl(-1.0L) * (i + 0.75L) / (n + 0.5L)), slope = 1;
    for (int step = 0; step < 12; ++step) {
      long double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        long double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    rule->x[i] = x;
    rule->w[i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

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
  const struct rule *rule = gauss(n < ORDER_MAX ? n : ORDER_MAX);
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
  const int *n = slab->samples;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      size_t column = (size_t)u->uv[a / 2] * (size_t)n[2] + (size_t)u->st[a % 2];
      size_t row = (size_t)v->uv[b / 2] * (size_t)n[3] + (size_t)v->st[b % 2];
      const float *rgb = slab->rgb + 3 * (row * (size_t)n[0] * (size_t)n[2] + column);
      for (int c = 0; c < 3; ++c) {
        long double value = (long double)rgb[c];
        area->value[swap ? b : a][swap ? a : b][c] = area->magnitude ? fabsl(value) : value;
      }
    }
}

void oracle_frame(const struct slab *slab, long double frame[3][3]) {
  const double *const from[3] = {slab->u, slab->v, slab->normal};
  for (int r = 0; r < 3; ++r) {
    long double square = 0;
    for (int k = 0; k < 3; ++k) square += (long double)from[r][k] * (long double)from[r][k];
    for (int k = 0; k < 3; ++k) frame[r][k] = (long double)from[r][k] / sqrtl(square);
  }
}

/* The receiver's unit normal in the slab's frame. */
static void turned(const struct slab *slab, const double n[3], long double turn[3]) {
  long double frame[3][3];
  long double length = 0;
  oracle_frame(slab, frame);
  for (int k = 0; k < 3; ++k) length += (long double)n[k] * (long double)n[k];
  for (int r = 0; r < 3; ++r) {
    turn[r] = 0;
    for (int k = 0; k < 3; ++k) turn[r] += frame[r][k] * (long double)n[k] / sqrtl(length);
  }
}

struct oracle_value oracle_irradiance(const struct slab *slab, const double p[3],
                                      const double n[3]) {
  struct oracle_value value = {{0}, {0}, 0};
  static struct oracle_axis axes[2];
  static struct area area;
  long double turn[3], sums[3][3] = {{0}};
  turned(slab, n, turn);
  bool swap = fabsl(turn[0]) > fabsl(turn[1]);
  area.n[0] = turn[swap], area.n[1] = turn[!swap], area.n[2] = turn[2];
  oracle_axis(slab, p, swap, &axes[0]);
  oracle_axis(slab, p, !swap, &axes[1]);
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
      value.error = fmaxl(value.error, fabsl(sums[0][c] - sums[1][c]) / sums[2][c]);
  }
  return value;
}
