#include "export/radiance_overlap.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Separating axes of two rectangles in one plane are along their edges. */
bool radiance_overlap(const struct slab *a, const struct slab *b) {
  const double *edges[4] = {a->u, a->v, b->u, b->v};
  double apart[3];
  for (int c = 0; c < 3; ++c) apart[c] = b->center[c] - a->center[c];
  double size = sqrt(dot(a->u, a->u) + dot(a->v, a->v));
  if (dot(a->normal, b->normal) < 1 - 1e-6 || fabs(dot(apart, a->normal)) > 1e-6 * size)
    return false;
  for (int axis = 0; axis < 4; ++axis) {
    double reach = 0;
    for (int k = 0; k < 4; ++k) reach += fabs(dot(edges[k], edges[axis])) / 2;
    if (fabs(dot(apart, edges[axis])) >= (1 - 1e-6) * reach) return false;
  }
  return true;
}

enum result radiance_overlap_add(const struct slab *a, const struct slab *b, struct slab *sum,
                                 struct error *error) {
  enum result result = RESULT_OK;
  if (!sum->rgb) {
    result = slab_copy_geometry(a, sum, error);
    if (result == RESULT_OK) result = slab_alloc(sum, error);
  }
  size_t count = 3 * slab_sample_count(a);
  for (size_t k = 0; result == RESULT_OK && k < count; ++k) sum->rgb[k] = a->rgb[k] + b->rgb[k];
  return result;
}
