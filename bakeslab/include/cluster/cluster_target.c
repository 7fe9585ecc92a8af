/* cluster_target.c - receivers that see the lights and the slab. */
#include "include/cluster/cluster_target.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/plane.h"

enum { PLANES = 5 };

/* Planes that are fitted, as shares of the distance asked for, and how much the
 * error on each counts. Far away all light seems to come from one point, near by
 * a few lights cannot be right. */
static const double shares[PLANES] = {0.25, 0.5, 1, 2, 4},
                    weights[PLANES] = {0.25, 0.5, 1, 0.7, 0.7};

/* Receivers an axis: different numbers, so that together they see the far field at many
 * more directions than one plane does, and no lobe hides between them. */
static const int receivers[PLANES] = {22, 22, 28, 26, 30};

/* And of those that tell the error: at least twice as many, so that no lobe that the fit allows
 * hides between them; and odd, where the fit's are even, so that none is the fit's. */
enum { GAUGE_RECEIVERS = 57 };

/* Beyond what the slab lights, lights must be dark. */
static const double margin = 1.25, gauge_margin = 1.1;

/* The flux counts as much as this many planes. */
static const double flux_weight = 5;

/* Adds a plane's receivers, at equal angles. On a plane h away and at the angle theta, an intensity
 * gives the irradiance I cos^3 / h^2, and an area is the solid angle times h^2 / cos^3. */
static void add_plane(const struct slab *slab, const struct plane *plane, double weight,
                      bool intensity, struct cluster_target *target) {
  double width = plane_width(slab), square = 0;
  int first = target->count;
  /* Half as many as the sheet's errors need, which are ten times smaller. */
  const int points[2] = {plane->points[0] / 2, plane->points[1] / 2};
  for (int row = 0; row < plane->receivers; ++row)
    for (int column = 0; column < plane->receivers; ++column) {
      int k = target->count++;
      double at[2], area = plane_fan(plane, column + 0.5, row + 0.5, at);
      plane_irradiance(slab, points, at, plane->distance, target->rgb[k]);
      double slope2 = (at[0] * at[0] + at[1] * at[1]) / (plane->distance * plane->distance);
      if (intensity) area *= pow(1 + slope2, 1.5); /* 1 / cos^3 */
      for (int c = 0; c < 2; ++c) target->at[k][c] = at[c] / width;
      target->at[k][2] = plane->distance / width;
      target->weight[k] = sqrt(area);
      for (int c = 0; c < 3; ++c) square += area * target->rgb[k][c] * target->rgb[k][c];
    }
  for (int k = first; k < target->count; ++k)
    target->weight[k] *= square > 0 ? weight / sqrt(square) : 0;
}

static enum result make_room(int count, struct cluster_target *target, struct error *error) {
  size_t room = (size_t)count + 1;
  memset(target, 0, sizeof *target);
  target->at = calloc(room, 2 * sizeof *target->at + sizeof *target->weight);
  if (!target->at) return result_no_memory(error);
  target->rgb = target->at + room;
  target->weight = target->rgb[room];
  return RESULT_OK;
}

enum result cluster_target_make(const struct slab *slab, double distance, bool intensity,
                                struct cluster_target *target, struct error *error) {
  int room = 0;
  double width = plane_width(slab), most = 0;
  for (int p = 0; p < PLANES; ++p) room += receivers[p] * receivers[p];
  enum result result = make_room(room, target, error);
  if (result != RESULT_OK) return result;
  for (int k = 0; k < 2; ++k) target->edge[k] = plane_edge(slab, k) / width;
  memcpy(target->window, slab->st_window, sizeof target->window);
  for (int p = 0; p < PLANES; ++p) {
    struct plane plane = plane_make(slab, shares[p] * distance * width, margin, receivers[p]);
    add_plane(slab, &plane, weights[p], intensity, target);
    target->narrowest = fmax(target->narrowest, plane_fan_step(&plane));
  }
  double *flux = target->rgb[target->count];
  result = slab_flux(slab, flux, error);
  if (result != RESULT_OK) return result;
  for (int c = 0; c < 3; ++c) {
    flux[c] /= width * width;
    most = fmax(most, flux[c]);
  }
  target->unit = most;
  for (int k = 0; k <= target->count; ++k) {
    for (int c = 0; c < 3; ++c) target->rgb[k][c] /= most;
    target->weight[k] *= most;
  }
  target->weight[target->count] = flux_weight;
  return RESULT_OK;
}

enum result cluster_gauge_make(const struct slab *slab, double distance,
                               struct cluster_target *gauge, struct error *error) {
  enum result result = make_room(GAUGE_RECEIVERS * GAUGE_RECEIVERS, gauge, error);
  if (result != RESULT_OK) return result;
  struct plane plane = plane_make(slab, distance * plane_width(slab), gauge_margin, 0);
  plane.receivers = GAUGE_RECEIVERS;
  add_plane(slab, &plane, 1, false, gauge);
  return RESULT_OK;
}

void cluster_target_free(struct cluster_target *target) {
  free(target->at);
  memset(target, 0, sizeof *target);
}

double cluster_error(const struct cluster_target *gauge, const struct cluster_light *lights,
                     int count, double unit) {
  double error = 0;
  for (int r = 0; r < gauge->count; ++r) {
    double rest[3];
    memcpy(rest, gauge->rgb[r], sizeof rest);
    for (int k = 0; k < count; ++k) {
      double share = unit * cluster_irradiance(&lights[k], gauge->at[r]);
      for (int c = 0; c < 3; ++c) rest[c] -= lights[k].rgb[c] * share;
    }
    for (int c = 0; c < 3; ++c) error += gauge->weight[r] * gauge->weight[r] * rest[c] * rest[c];
  }
  return sqrt(error);
}
