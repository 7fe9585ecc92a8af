/* sheet_error.c - irradiance of a level's lights against the slab's integral. */
#include "include/sheet/sheet_error.h"

#include <math.h>
#include <stdlib.h>

#include "slab/plane.h"

const double sheet_distances[SHEET_DISTANCES] = {0.5, 1, 2, 4, 8};

/* Adds the squares of one receiver: error of each level, then the irradiance. */
static void add_receiver(const struct slab *slab, const struct sheet_level *levels, int count,
                         const struct plane *plane, const double at[2], double *squares) {
  double exact[3], sum[3];
  plane_irradiance(slab, plane->points, at, plane->distance, exact);
  for (int c = 0; c < 3; ++c) squares[count] += exact[c] * exact[c];
  for (int k = 0; k < count; ++k) {
    plane_irradiance(&levels[k].views, levels[k].views.samples, at, plane->distance, sum);
    for (int c = 0; c < 3; ++c) squares[k] += (sum[c] - exact[c]) * (sum[c] - exact[c]);
  }
}

void sheet_measure_at(const struct slab *slab, const struct sheet_level *levels, int count,
                      double distance, double *errors) {
  struct plane plane = plane_make(slab, distance * plane_width(slab), 1, 0);
  for (int k = 0; k <= count; ++k) errors[k] = 0;
  for (int row = 0; row < plane.receivers; ++row)
    for (int column = 0; column < plane.receivers; ++column) {
      double at[2];
      plane_receiver(&plane, column, row, at);
      add_receiver(slab, levels, count, &plane, at, errors);
    }
  for (int k = 0; k < count; ++k) {
    errors[k] = errors[count] > 0 ? sqrt(errors[k] / errors[count]) : 0;
    if (levels[k].height >= plane.distance) errors[k] = INFINITY;
  }
}

enum result sheet_measure(const struct slab *slab, struct sheet_level *levels, int count,
                          struct error *error) {
  double *errors = calloc((size_t)count + 1, sizeof *errors);
  if (!errors) return result_fail(error, RESULT_MEMORY, "out of memory");
  for (int d = 0; d < SHEET_DISTANCES; ++d) {
    sheet_measure_at(slab, levels, count, sheet_distances[d], errors);
    for (int k = 0; k < count; ++k) levels[k].error[d] = errors[k];
  }
  free(errors);
  return RESULT_OK;
}
