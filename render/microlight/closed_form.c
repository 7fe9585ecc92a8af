/* closed_form.c - see closed_form.h. */
#include "microlight/closed_form.h"

#include <math.h>

#include "slab/slab_gauss.h"

static double farness(const struct strip *strip) {
  return strip->low > 0 ? strip->low : strip->high < 0 ? -strip->high : 0;
}

bool closed_form_applies(const struct strip *u, const struct strip *v) {
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

void closed_form_weights(const double normal[3], const struct strip *u, const struct strip *v,
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
