#include "slab/plane_shadow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Across the edge, receivers in the penumbra and as many beyond, where all is seen; and along
 * it. */
enum { ACROSS = 12, ALONG = 12 };

/* Where a receiver stands in its cell, from 0 to 1, as in plane.c. */
static double stagger(int index) {
  double place = 0.5 + 0.6180339887498949 * index;
  return place - floor(place);
}

/* Receivers between two places along `axis`. */
static void add_strip(const struct slab *slab, const struct plane *plane, int axis,
                      const double strip[2], struct plane_shadow *shadow) {
  /* Half as many points as without shadow: cells that the edge cuts count in part. */
  const int points[2] = {plane->points[0] / 2, plane->points[1] / 2};
  double middle = plane->low[axis] + plane->size[axis] / 2, size = strip[1] - strip[0];
  if (!(size > 0)) return;
  for (int row = 0; row < ALONG; ++row)
    for (int column = 0; column < ACROSS; ++column) {
      struct plane_shadow_receiver *receiver = &shadow->receivers[shadow->count++];
      double *at = receiver->at;
      at[axis] = strip[0] + (column + stagger(row)) / ACROSS * size;
      at[1 - axis] = plane->low[1 - axis] + (row + stagger(column)) / ALONG * plane->size[1 - axis];
      at[2] = plane->distance;
      receiver->until[axis] = middle - at[axis];
      receiver->edge[axis] = middle / 2;
      receiver->until[1 - axis] = receiver->edge[1 - axis] = INFINITY;
      receiver->area = size * plane->size[1 - axis] / (ACROSS * ALONG);
      plane_irradiance_until(slab, points, receiver->until, at, plane->distance, receiver->rgb);
    }
}

enum result plane_shadow_make(const struct slab *slab, double distance, struct plane_shadow *shadow,
                              struct error *error) {
  struct plane plane = plane_make(slab, distance, 1, 0);
  *shadow = (struct plane_shadow){.count = 0};
  shadow->receivers = calloc(4 * ACROSS * ALONG, sizeof *shadow->receivers);
  if (!shadow->receivers) return result_no_memory(error);
  for (int axis = 0; axis < 2; ++axis) {
    double low = plane.low[axis], high = low + plane.size[axis], middle = (low + high) / 2;
    double half = plane_edge(slab, axis) / 2;
    double begins = fmax(middle - half, low), ends = fmin(middle + half, high);
    const double seen[2] = {low, begins}, penumbra[2] = {begins, ends};
    add_strip(slab, &plane, axis, seen, shadow);
    add_strip(slab, &plane, axis, penumbra, shadow);
  }
  return RESULT_OK;
}

void plane_shadow_free(struct plane_shadow *shadow) {
  free(shadow->receivers);
  memset(shadow, 0, sizeof *shadow);
}

bool plane_shadow_hides(const struct plane_shadow_receiver *receiver, const double light[3]) {
  const double *at = receiver->at;
  if (light[2] >= at[2] / 2) return false; /* it stands beyond the edge */
  double part = (at[2] / 2 - light[2]) / (at[2] - light[2]);
  for (int k = 0; k < 2; ++k)
    if (light[k] + part * (at[k] - light[k]) > receiver->edge[k]) return true;
  return false;
}

double plane_shadow_error(const struct plane_shadow *shadow,
                          plane_shadow_approximation *approximation, const void *of, int k) {
  double all = 0, wrong = 0, rgb[3];
  for (int n = 0; n < shadow->count; ++n) {
    const struct plane_shadow_receiver *receiver = &shadow->receivers[n];
    approximation(of, k, receiver, rgb);
    for (int c = 0; c < 3; ++c) {
      double exact = receiver->rgb[c];
      all += receiver->area * exact * exact;
      wrong += receiver->area * (rgb[c] - exact) * (rgb[c] - exact);
    }
  }
  return all > 0 ? sqrt(wrong / all) : 0;
}
