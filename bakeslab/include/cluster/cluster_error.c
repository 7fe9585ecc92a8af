/* cluster_error.c - what lights err, on receivers that had no part in their fit. */
#include <math.h>

#include "include/cluster/cluster.h"
#include "slab/plane.h"

/* Receivers an axis: at least twice as many as the fit has, so that no lobe that it allows
 * hides between them; and odd, where the fit's are even, so that none is the fit's. */
enum { RECEIVERS = 57 };

/* Light beyond what the slab lights is an error too. */
static const double margin = 1.1;

enum result cluster_gauge_make(const struct slab *slab, double distance,
                               struct cluster_target *gauge, struct error *error) {
  enum result result = cluster_target_room(RECEIVERS * RECEIVERS, gauge, error);
  if (result != RESULT_OK) return result;
  struct plane plane = plane_make(slab, distance * plane_width(slab), margin, 0);
  plane.receivers = RECEIVERS;
  cluster_target_add(slab, &plane, 1, gauge);
  return RESULT_OK;
}

double cluster_error(const struct cluster_target *gauge, const struct cluster_light *lights,
                     int count, double unit) {
  double error = 0;
  for (int r = 0; r < gauge->count; ++r) {
    double rest[3];
    for (int c = 0; c < 3; ++c) rest[c] = gauge->rgb[r][c];
    for (int k = 0; k < count; ++k) {
      double share = unit * cluster_irradiance(&lights[k], gauge->at[r]);
      for (int c = 0; c < 3; ++c) rest[c] -= lights[k].rgb[c] * share;
    }
    for (int c = 0; c < 3; ++c) error += gauge->weight[r] * gauge->weight[r] * rest[c] * rest[c];
  }
  return sqrt(error);
}
