#include "slab/plane.h"

#include <math.h>

/* Lookups of the slab that one plane may cost. */
static const double work_limit = 2e6;
enum { LEAST_POINTS = 16, MOST_POINTS = 128, LEAST_RECEIVERS = 8, MOST_RECEIVERS = 32 };

double plane_edge(const struct slab *slab, int axis) {
  return slab_spacing(slab, axis) * slab->samples[axis];
}

double plane_width(const struct slab *slab) {
  return fmax(plane_edge(slab, SLAB_U), plane_edge(slab, SLAB_V));
}

/* Points of the dense sum along an axis of the aperture: several in each cell,
 * and close enough for two in each sample of s or t that a receiver sees. A
 * multiple of twice the cells, so that the kinks of the interpolant, on cell
 * centres, fall between points. */
static int quadrature_points(const struct slab *slab, int axis, double distance) {
  int cells = slab->samples[axis];
  double step = distance * slab_spacing(slab, axis == SLAB_U ? SLAB_S : SLAB_T) / 2;
  double wanted = fmin(fmax(plane_edge(slab, axis) / step, LEAST_POINTS), MOST_POINTS);
  int half = (int)ceil(wanted / (2 * cells));
  return 2 * cells * (cells < MOST_POINTS / 4 && half < 2 ? 2 : half);
}

/* The share of a cell about `middle` that lies below `until`. */
static double share_below(double middle, double size, double until) {
  return fmin(fmax((until - middle) / size + 0.5, 0), 1);
}

void plane_irradiance_until(const struct slab *slab, const int points[2], const double until[2],
                            const double at[2], double distance, double rgb[3]) {
  double kappa = slab_kappa(slab);
  double du = plane_edge(slab, SLAB_U) / points[0], dv = plane_edge(slab, SLAB_V) / points[1];
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int j = 0; j < points[1]; ++j) {
    double b = (j + 0.5 - 0.5 * points[1]) * dv, y = at[1] - b;
    double t = y / distance + kappa * b, below = share_below(b, dv, until[1]);
    if (t < slab->st_window[2] || t > slab->st_window[3] || below == 0) continue;
    for (int i = 0; i < points[0]; ++i) {
      double a = (i + 0.5 - 0.5 * points[0]) * du, x = at[0] - a;
      double radiance[3], share = below * share_below(a, du, until[0]);
      if (share == 0) break;
      slab_lookup(slab, a, b, x / distance + kappa * a, t, radiance);
      double r2 = x * x + y * y + distance * distance;
      double weight = share * distance * distance / r2 * (du * dv / r2); /* tiny lengths, too */
      for (int c = 0; c < 3; ++c) rgb[c] += weight * radiance[c];
    }
  }
}

void plane_irradiance(const struct slab *slab, const int points[2], const double at[2],
                      double distance, double rgb[3]) {
  static const double all[2] = {INFINITY, INFINITY};
  plane_irradiance_until(slab, points, all, at, distance, rgb);
}

struct plane plane_make(const struct slab *slab, double distance, double margin, int most) {
  struct plane plane = {.distance = distance};
  double spread = fabs(1 - slab_kappa(slab) * plane.distance);
  for (int k = 0; k < 2; ++k) {
    const double *window = slab->st_window + 2 * k;
    double aperture = spread * plane_edge(slab, k ? SLAB_V : SLAB_U);
    double size = plane.distance * (window[1] - window[0]) + aperture;
    plane.size[k] = margin * size;
    plane.low[k] = plane.distance * window[0] - aperture / 2 - (margin - 1) / 2 * size;
  }
  for (int k = 0; k < 2; ++k)
    plane.points[k] = quadrature_points(slab, k ? SLAB_V : SLAB_U, distance);
  double affordable = sqrt(work_limit / ((double)plane.points[0] * plane.points[1]));
  plane.receivers = (int)fmin(fmax(affordable, LEAST_RECEIVERS), most > 0 ? most : MOST_RECEIVERS);
  return plane;
}

/* Where a receiver stands in its cell, from 0 to 1. Edges of light may lie along rows or columns:
 * the receivers of each are spread evenly over the width of the cell, by the golden ratio. */
static double stagger(int index) {
  double place = 0.5 + 0.6180339887498949 * index;
  return place - floor(place);
}

/* Angle at which the lit part begins along an axis, and how far it reaches. */
static void fan_angles(const struct plane *plane, int axis, double *low, double *reach) {
  *low = atan(plane->low[axis] / plane->distance);
  *reach = atan((plane->low[axis] + plane->size[axis]) / plane->distance) - *low;
}

double plane_fan(const struct plane *plane, double column, double row, double at[2]) {
  double area = 1, cells[2] = {column, row};
  for (int k = 0; k < 2; ++k) {
    double low, reach;
    fan_angles(plane, k, &low, &reach);
    double slope = tan(low + cells[k] / plane->receivers * reach);
    at[k] = plane->distance * slope;
    area *= plane->distance * (1 + slope * slope) * reach / plane->receivers;
  }
  return area;
}

double plane_fan_step(const struct plane *plane) {
  double widest = 0;
  for (int k = 0; k < 2; ++k) {
    double low, reach;
    fan_angles(plane, k, &low, &reach);
    widest = fmax(widest, reach / plane->receivers);
  }
  return widest;
}

void plane_errors(const struct slab *slab, double distance, double margin,
                  plane_approximation *approximation, const void *of, int count, double *errors) {
  struct plane plane = plane_make(slab, distance, margin, 0);
  double all = 0, exact[3], sum[3], at[3] = {0, 0, distance};
  for (int k = 0; k < count; ++k) errors[k] = 0;
  for (int row = 0; row < plane.receivers; ++row)
    for (int column = 0; column < plane.receivers; ++column) {
      at[0] = plane.low[0] + (column + stagger(row)) / plane.receivers * plane.size[0];
      at[1] = plane.low[1] + (row + stagger(column)) / plane.receivers * plane.size[1];
      plane_irradiance(slab, plane.points, at, distance, exact);
      for (int c = 0; c < 3; ++c) all += exact[c] * exact[c];
      for (int k = 0; k < count; ++k) {
        approximation(of, k, at, sum);
        for (int c = 0; c < 3; ++c) errors[k] += (sum[c] - exact[c]) * (sum[c] - exact[c]);
      }
    }
  for (int k = 0; k < count; ++k) errors[k] = all > 0 ? sqrt(errors[k] / all) : 0;
}
