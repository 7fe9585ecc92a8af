/* known_rays.c - rays by rejection; means of a product of a function of (a, s) and one of (b, t),
 * or of one of (s, t). */
#include "oracle/known_rays.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "oracle/gauss.h"
#include "oracle/random.h"

const struct known_source known_sources[KNOWN_KINDS] = {
    [KNOWN_SQUARE] = {"square", {0.0005, 0.0005, 3, 3}},
    [KNOWN_BEAM] = {"beam", {0.005, 0.005, 0.02182, 0.02182}}, /* 1.25 degrees */
    [KNOWN_BARS] = {"bars", {0.1, 0.1, 1.5, 1.5}},
    [KNOWN_LOBE] = {"lobe", {0.1, 0.1, 1.2, 1.2}}};

struct slab known_page(enum known_kind kind, int nu, int ns) {
  const double *half = known_sources[kind].half;
  return (struct slab){.samples = {nu, nu, ns, ns},
                       .u = {2 * half[0], 0, 0},
                       .v = {0, 2 * half[1], 0},
                       .normal = {0, 0, 1},
                       .st_window = {-half[2], half[2], -half[3], half[3]},
                       .st_distance = INFINITY,
                       .metres_per_unit = 1,
                       .radiance_unit = "W/(sr m2)"};
}

static const double most = 1.5; /* the radiance of any */

static bool in_beam(double s, double t) {
  double tangent = 0.017455064928217585; /* of 1 degree */
  return s * s + t * t < tangent * tangent;
}

static bool in_source(double a, double s) {
  return fabs(a - 0.1 * s) <= 0.06;
}

static bool between_bars(double a, double s) {
  double periods = (a - 0.02 * s) / 0.04;
  return periods - floor(periods) < 0.5;
}

double known_radiance(enum known_kind kind, const double abst[4]) {
  double a = abst[0], b = abst[1], s = abst[2], t = abst[3];
  switch (kind) {
  case KNOWN_BEAM:
    return in_beam(s, t);
  case KNOWN_BARS:
    return in_source(a, s) && between_bars(a, s) && in_source(b, t);
  case KNOWN_LOBE:
    return exp(-(s * s + t * t) / 0.18) * (1 + a / 0.2);
  default:
    return 1;
  }
}

void known_ray(enum known_kind kind, uint64_t *seed, double abst[4]) {
  const double *half = known_sources[kind].half;
  double slope = kind == KNOWN_SQUARE ? INFINITY : hypot(half[2], half[3]);
  double most_square = 1 / (1 + 1 / (slope * slope)); /* of the sine */
  for (;;) {
    double square = most_square * random_number(seed), angle = 2 * acos(-1) * random_number(seed);
    double tangent = sqrt(square / (1 - square));
    abst[0] = half[0] * (2 * random_number(seed) - 1);
    abst[1] = half[1] * (2 * random_number(seed) - 1);
    abst[2] = tangent * cos(angle);
    abst[3] = tangent * sin(angle);
    if (kind == KNOWN_SQUARE) return;
    if (fabs(abst[2]) >= half[2] || fabs(abst[3]) >= half[3]) continue;
    double radiance = known_radiance(kind, abst);
    if (radiance >= (kind == KNOWN_LOBE ? most * random_number(seed) : 0.5)) return;
  }
}

/* ---- Cells ---- */

enum { POINTS = 48, NODES = 6 };

/* What the means are made of: that of (s, t), in the middle of the page, or with bars that of
 * (a, s), and then that of (b, t). */
typedef double part(enum known_kind kind, double x, double y);

static double of_slopes(enum known_kind kind, double s, double t) {
  return known_radiance(kind, (const double[]){0, 0, s, t});
}

static double through_bars(enum known_kind kind, double a, double s) {
  (void)kind;
  return in_source(a, s) && between_bars(a, s);
}

static double beside_bars(enum known_kind kind, double b, double t) {
  (void)kind;
  return in_source(b, t);
}

/* Means over n by m cells of the rectangle of these half widths, and, after them, means of the same
 * times y less its middle. */
static double *means(enum known_kind kind, part *of, double half_x, int n, double half_y, int m) {
  double *mean = calloc(2 * (size_t)n * (size_t)m, sizeof *mean), dy = 2 * half_y / m;
  for (int i = 0; i < n * m; ++i)
    for (int p = 0; p < POINTS * POINTS; ++p) {
      double x = half_x * (2 * (i / m + (p / POINTS + 0.5) / POINTS) / n - 1);
      double from_middle = ((p % POINTS + 0.5) / POINTS - 0.5) * dy;
      double value = of(kind, x, (i % m + 0.5) * dy - half_y + from_middle) / (POINTS * POINTS);
      mean[i] += value;
      mean[n * m + i] += value * from_middle;
    }
  return mean;
}

/* The etendue of the directions (k, l) through a square metre. */
static double solid_angle(const double half[4], const int samples[4], int k, int l) {
  const struct gauss *rule = gauss_rule(NODES);
  double sum = 0, ds = 2 * half[2] / samples[2], dt = 2 * half[3] / samples[3];
  for (int p = 0; p < NODES; ++p)
    for (int q = 0; q < NODES; ++q) {
      double s = (k + 0.5 + (double)rule->x[p] / 2) * ds - half[2];
      double t = (l + 0.5 + (double)rule->x[q] / 2) * dt - half[3], r = 1 + s * s + t * t;
      sum += (double)(rule->w[p] * rule->w[q]) / (r * r);
    }
  return sum * ds * dt / 4;
}

/* The mean of along(s) * across(t), the cosines taken as linear within the cell. */
static double bars_mean(const double *along, int columns, const double *across, int rows, double s,
                        double t) {
  double slope = -4 / (1 + s * s + t * t);
  return along[0] * across[0] +
         slope * (s * along[columns] * across[0] + t * along[0] * across[rows]);
}

double known_cells(enum known_kind kind, const int samples[4], double *mean, double *etendue) {
  const double *half = known_sources[kind].half;
  int nu = samples[0], nv = samples[1], ns = samples[2], nt = samples[3];
  bool bars = kind == KNOWN_BARS;
  double *slopes = means(kind, of_slopes, half[2], bars ? 1 : ns, half[3], bars ? 1 : nt);
  double *along = means(kind, through_bars, half[0], nu, half[2], ns);
  double *across = means(kind, beside_bars, half[1], nv, half[3], nt);
  double area = 4 * half[0] * half[1] / (nu * nv), flux = 0;
  for (int j = 0; j < nv; ++j)
    for (int l = 0; l < nt; ++l)
      for (int k = 0; k < ns; ++k) {
        double omega = solid_angle(half, samples, k, l);
        for (int i = 0; i < nu; ++i) {
          size_t cell =
              (((size_t)j * (size_t)nt + (size_t)l) * (size_t)nu + (size_t)i) * (size_t)ns +
              (size_t)k;
          double a = half[0] * (2 * (i + 0.5) / nu - 1);
          double s = half[2] * (2 * (k + 0.5) / ns - 1), t = half[3] * (2 * (l + 0.5) / nt - 1);
          etendue[cell] = area * omega;
          mean[cell] =
              bars ? bars_mean(&along[i * ns + k], nu * ns, &across[j * nt + l], nv * nt, s, t)
                   : slopes[k * nt + l] * (kind == KNOWN_LOBE ? 1 + a / 0.2 : 1);
          flux += mean[cell] * etendue[cell];
        }
      }
  free(slopes);
  free(along);
  free(across);
  return kind == KNOWN_SQUARE ? acos(-1) * 4 * half[0] * half[1] : flux;
}
