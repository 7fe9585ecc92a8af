/* sheet_error.c - irradiance of a level's lights against the slab's integral. */
#include "sheet_error.h"

#include <math.h>
#include <stdlib.h>

const double sheet_distances[SHEET_DISTANCES] = {0.5, 1, 2, 4, 8};

/* Lookups of the slab that one distance may cost. */
static const double work_limit = 2e6;
enum { LEAST_POINTS = 16, MOST_POINTS = 128, LEAST_RECEIVERS = 8, MOST_RECEIVERS = 32 };

/* A plane parallel to the aperture and the part of it that the window lets
 * light reach, divided into receivers x receivers cells. */
struct plane {
  double distance;
  double low[2], size[2];
  int receivers;
  int points[2]; /* of the dense sum, along u and v */
};

/* Points of the dense sum along an axis of the aperture: several in each cell,
 * and close enough for two in each sample of s or t that a receiver sees. A
 * multiple of twice the cells, so that the kinks of the interpolant, on cell
 * centres, fall between points. */
static int quadrature_points(const struct slab *slab, int axis, double distance) {
  int cells = slab->samples[axis];
  double step = distance * slab_spacing(slab, axis == SLAB_U ? SLAB_S : SLAB_T) / 2;
  double wanted = fmin(fmax(sheet_edge(slab, axis) / step, LEAST_POINTS), MOST_POINTS);
  int half = (int)ceil(wanted / (2 * cells));
  return 2 * cells * (cells < MOST_POINTS / 4 && half < 2 ? 2 : half);
}

/* Irradiance at (x, y, distance) of points[0] x points[1] point lights on the
 * middles of as many cells of the aperture. */
static void irradiance(const struct slab *slab, const int points[2], const double at[2],
                       double distance, double rgb[3]) {
  double kappa = slab_kappa(slab);
  double du = sheet_edge(slab, SLAB_U) / points[0], dv = sheet_edge(slab, SLAB_V) / points[1];
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int j = 0; j < points[1]; ++j) {
    double b = (j + 0.5 - 0.5 * points[1]) * dv, y = at[1] - b;
    double t = y / distance + kappa * b;
    if (t < slab->st_window[2] || t > slab->st_window[3]) continue;
    for (int i = 0; i < points[0]; ++i) {
      double a = (i + 0.5 - 0.5 * points[0]) * du, x = at[0] - a;
      double radiance[3];
      slab_lookup(slab, a, b, x / distance + kappa * a, t, radiance);
      double r2 = x * x + y * y + distance * distance;
      double weight = distance * distance / (r2 * r2) * du * dv;
      for (int c = 0; c < 3; ++c) rgb[c] += weight * radiance[c];
    }
  }
}

static struct plane make_plane(const struct slab *slab, double distance) {
  struct plane plane = {.distance = distance};
  double spread = fabs(1 - slab_kappa(slab) * plane.distance);
  for (int k = 0; k < 2; ++k) {
    const double *window = slab->st_window + 2 * k;
    double aperture = spread * sheet_edge(slab, k ? SLAB_V : SLAB_U);
    plane.low[k] = plane.distance * window[0] - aperture / 2;
    plane.size[k] = plane.distance * (window[1] - window[0]) + aperture;
  }
  for (int k = 0; k < 2; ++k)
    plane.points[k] = quadrature_points(slab, k ? SLAB_V : SLAB_U, distance);
  double affordable = sqrt(work_limit / ((double)plane.points[0] * plane.points[1]));
  plane.receivers = (int)fmin(fmax(affordable, LEAST_RECEIVERS), MOST_RECEIVERS);
  return plane;
}

/* Adds the squares of one receiver: error of each level, then the irradiance. */
static void add_receiver(const struct slab *slab, const struct sheet_level *levels, int count,
                         const struct plane *plane, const double at[2], double *squares) {
  double exact[3], sum[3];
  irradiance(slab, plane->points, at, plane->distance, exact);
  for (int c = 0; c < 3; ++c) squares[count] += exact[c] * exact[c];
  for (int k = 0; k < count; ++k) {
    irradiance(&levels[k].views, levels[k].views.samples, at, plane->distance, sum);
    for (int c = 0; c < 3; ++c) squares[k] += (sum[c] - exact[c]) * (sum[c] - exact[c]);
  }
}

enum slab_result sheet_measure(const struct slab *slab, struct sheet_level *levels, int count,
                               struct slab_error *error) {
  double *squares = calloc((size_t)count + 1, sizeof *squares);
  if (!squares) return slab_fail(error, SLAB_MEMORY, "out of memory");
  double width = fmax(sheet_edge(slab, SLAB_U), sheet_edge(slab, SLAB_V));
  for (int d = 0; d < SHEET_DISTANCES; ++d) {
    struct plane plane = make_plane(slab, sheet_distances[d] * width);
    for (int k = 0; k <= count; ++k) squares[k] = 0;
    for (int row = 0; row < plane.receivers; ++row)
      for (int column = 0; column < plane.receivers; ++column) {
        const double at[2] = {plane.low[0] + (column + 0.5) / plane.receivers * plane.size[0],
                              plane.low[1] + (row + 0.5) / plane.receivers * plane.size[1]};
        add_receiver(slab, levels, count, &plane, at, squares);
      }
    for (int k = 0; k < count; ++k)
      levels[k].error[d] = squares[count] > 0 ? sqrt(squares[k] / squares[count]) : 0;
  }
  free(squares);
  return SLAB_OK;
}
