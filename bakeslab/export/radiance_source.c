#include "export/radiance_source.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "slab/plane.h"

const double radiance_source_ds = 0.01;
enum { MOST_PARTS = 64, MOST_POLYGONS = 16, RECEIVERS = 12 };

struct radiance_source radiance_source_make(const struct slab *slab, const int polygons[2]) {
  struct radiance_source source = {{polygons[0], polygons[1]}, {0, 0}};
  double edge[2];
  for (int k = 0; k < 2; ++k) edge[k] = plane_edge(slab, k) / polygons[k];
  for (int parts = 1; parts < MOST_PARTS; parts *= 2) {
    int longer = edge[0] > edge[1] ? 0 : 1;
    edge[longer] /= 2;
    ++source.halvings[longer];
  }
  return source;
}

/* Along one axis of the aperture: parts of width `size`, and how a receiver sees them. */
struct parts {
  double size, turn, low, high; /* slope per length on the aperture; the window */
  int count;
};

/* A part's share within the window, and where its light is taken from. */
struct lit {
  double middle, share, along, slope;
};

static struct lit light_of(const struct parts *parts, int index, double at, double distance,
                           double kappa) {
  struct lit lit = {.middle = (index + 0.5 - 0.5 * parts->count) * parts->size};
  double width = parts->size * fabs(parts->turn);
  double slope = (at - lit.middle) / distance + kappa * lit.middle;
  double low = fmax(slope - width / 2, parts->low), high = fmin(slope + width / 2, parts->high);
  lit.share = width > 1e-9 ? fmax(high - low, 0) / width : high >= low;
  lit.slope = width > 1e-9 ? (low + high) / 2 : slope;
  lit.along = width > 1e-9 ? lit.middle + (lit.slope - slope) / parts->turn : lit.middle;
  return lit;
}

/* Parts of all polygons, as they are at the distance straight below; `finer`: halved once more. */
static struct parts parts_at(const struct slab *slab, const struct radiance_source *source,
                             int axis, double distance, bool finer) {
  struct parts parts = {.size = plane_edge(slab, axis) / source->polygons[axis],
                        .turn = slab_kappa(slab) - 1 / distance,
                        .low = slab->st_window[2 * axis],
                        .high = slab->st_window[2 * axis + 1],
                        .count = source->polygons[axis]};
  int halvings = 0;
  while (halvings < source->halvings[axis] &&
         parts.size / (1 << halvings) > radiance_source_ds * distance)
    ++halvings;
  if (finer) ++halvings;
  parts.size /= 1 << halvings;
  parts.count <<= halvings;
  return parts;
}

/* At (x, y) on the plane at a distance. */
static void irradiance(const struct slab *slab, const struct radiance_source *source,
                       const double at[2], double distance, bool finer, double rgb[3]) {
  struct parts u = parts_at(slab, source, SLAB_U, distance, finer);
  struct parts v = parts_at(slab, source, SLAB_V, distance, finer);
  double kappa = slab_kappa(slab);
  memset(rgb, 0, 3 * sizeof *rgb);
  for (int j = 0; j < v.count; ++j) {
    struct lit b = light_of(&v, j, at[1], distance, kappa);
    if (!(b.share > 0)) continue;
    for (int i = 0; i < u.count; ++i) {
      struct lit a = light_of(&u, i, at[0], distance, kappa);
      if (!(a.share > 0)) continue;
      double radiance[3], x = at[0] - a.middle, y = at[1] - b.middle;
      double r2 = x * x + y * y + distance * distance;
      double weight = a.share * b.share * distance * distance / r2 * (u.size * v.size / r2);
      slab_lookup(slab, a.along, b.along, a.slope, b.slope, radiance);
      for (int c = 0; c < 3; ++c) rgb[c] += weight * radiance[c];
    }
  }
}

/* Halving all parts leaves a fourth of the error, since the middles of parts are a rule of second
 * order: it is 4/3 of the difference. */
double radiance_source_error(const struct slab *slab, const struct radiance_source *source,
                             double widths) {
  double distance = widths * plane_width(slab), off = 0, all = 0;
  struct plane plane = plane_make(slab, distance, 1, 0);
  for (int k = 0; k < RECEIVERS * RECEIVERS; ++k) {
    double at[2], sum[3], finer[3], golden = 0.6180339887498949;
    int column = k % RECEIVERS, row = k / RECEIVERS; /* staggered: edges may lie along them */
    at[0] = plane.low[0] + (column + fmod(0.5 + golden * row, 1)) / RECEIVERS * plane.size[0];
    at[1] = plane.low[1] + (row + fmod(0.5 + golden * column, 1)) / RECEIVERS * plane.size[1];
    irradiance(slab, source, at, distance, false, sum);
    irradiance(slab, source, at, distance, true, finer);
    for (int c = 0; c < 3; ++c) {
      off += (sum[c] - finer[c]) * (sum[c] - finer[c]);
      all += finer[c] * finer[c];
    }
  }
  return all > 0 ? 4 * sqrt(off / all) / 3 : 0;
}

struct radiance_source radiance_source_choose(const struct slab *slab, double tolerance) {
  struct radiance_source source;
  for (int most = 1;; most *= 2) {
    int polygons[2];
    for (int k = 0; k < 2; ++k)
      polygons[k] = (int)fmax(1, round(most * plane_edge(slab, k) / plane_width(slab)));
    source = radiance_source_make(slab, polygons);
    if (most == MOST_POLYGONS || radiance_source_error(slab, &source, 1) <= tolerance)
      return source;
  }
}
