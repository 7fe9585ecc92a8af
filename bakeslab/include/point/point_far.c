/* point_far.c - the far field of a page along a direction: the sum over its views of radiance times
 * cosine times a view's share of the aperture. */
#include "include/point/point_far.h"

#include <string.h>

#include "slab/plane.h"
#include "slab/slab_resample.h"

enum { MOST_VIEWS = 8 };

static double dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

enum result point_far_make(const struct slab *slab, struct point_far *far, struct error *error) {
  int most = slab_kappa(slab) > 0 ? MOST_VIEWS : 1, samples[SLAB_AXES];
  *far = (struct point_far){.slab = slab};
  memcpy(samples, slab->samples, sizeof samples);
  for (int axis = SLAB_U; axis <= SLAB_V; ++axis)
    if (samples[axis] > most) samples[axis] = most;
  for (int c = 0; c < 3; ++c) {
    far->u[c] = slab->u[c] / plane_edge(slab, SLAB_U);
    far->v[c] = slab->v[c] / plane_edge(slab, SLAB_V);
  }
  enum result result = slab_flux(slab, far->flux, error);
  return result == RESULT_OK ? slab_resample(slab, samples, &far->views, error) : result;
}

void point_far_free(struct point_far *far) {
  slab_free(&far->views);
}

void point_far_add(const struct point_far *far, const double direction[3], double rgb[3]) {
  const struct slab *views = &far->views;
  double cosine = dot(direction, views->normal), kappa = slab_kappa(views);
  if (!(cosine > 0)) return;
  double s = dot(direction, far->u) / cosine, t = dot(direction, far->v) / cosine;
  double area = slab_spacing(views, SLAB_U) * slab_spacing(views, SLAB_V);
  for (int j = 0; j < views->samples[SLAB_V]; ++j)
    for (int i = 0; i < views->samples[SLAB_U]; ++i) {
      double a = slab_position(views, SLAB_U, i), b = slab_position(views, SLAB_V, j);
      double radiance[3];
      slab_lookup(views, a, b, s + kappa * a, t + kappa * b, radiance);
      for (int c = 0; c < 3; ++c) rgb[c] += radiance[c] * cosine * area;
    }
}
