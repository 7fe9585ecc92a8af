#include "export/radiance_source.h"

#include <math.h>

#include "slab/plane.h"

const double radiance_source_ds = 0.01;
enum { MOST_PARTS = 64 };

struct cut {
  const struct slab *slab;
  int points[2]; /* of the whole aperture */
};

/* Parts of one polygon, at the distance that is nearest: straight below it. */
static struct cut cut(const struct slab *slab, const int polygons[2], double distance) {
  struct cut cut = {.slab = slab, .points = {1, 1}};
  double edge[2];
  for (int k = 0; k < 2; ++k) edge[k] = plane_edge(slab, k) / polygons[k];
  for (int parts = 1; parts < MOST_PARTS; parts *= 2) {
    int longer = edge[0] > edge[1] ? 0 : 1;
    if (edge[longer] <= radiance_source_ds * distance) break;
    edge[longer] /= 2;
    cut.points[longer] *= 2;
  }
  for (int k = 0; k < 2; ++k) cut.points[k] *= polygons[k];
  return cut;
}

static void irradiance(const void *of, int k, const double at[3], double rgb[3]) {
  const struct cut *cut = of;
  (void)k;
  plane_irradiance(cut->slab, cut->points, at, at[2], rgb);
}

double radiance_source_error(const struct slab *slab, const int polygons[2], double widths) {
  double error, distance = widths * plane_width(slab);
  struct cut parts = cut(slab, polygons, distance);
  plane_errors(slab, distance, 1, irradiance, &parts, 1, &error);
  return error;
}

double radiance_source_choose(const struct slab *slab, double tolerance, int polygons[2]) {
  double error = INFINITY;
  for (int most = 1; most <= RADIANCE_SOURCE_MOST && !(error <= tolerance); most *= 2) {
    for (int k = 0; k < 2; ++k)
      polygons[k] = (int)fmax(1, round(most * plane_edge(slab, k) / plane_width(slab)));
    error = radiance_source_error(slab, polygons, 1);
  }
  return error;
}
