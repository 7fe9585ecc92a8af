#include "viewer/viewer_camera.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* At least so far from straight above, in radians. */
static const double steepest = 0.02;

struct camera viewer_camera_outside(const struct scene *scene) {
  static const double aside[3] = {0.3, 0.45, -1};
  struct camera camera = {.up = {0, 1, 0}, .fov = 60};
  double low[3], high[3], size[3];
  scene_box(scene, low, high);
  vector_subtract(high, low, size);
  double distance = vector_length(size) > 0 ? vector_length(size) : 1;
  for (int c = 0; c < 3; ++c) {
    camera.at[c] = (low[c] + high[c]) / 2;
    camera.from[c] = camera.at[c] + distance * aside[c];
  }
  return camera;
}

bool viewer_camera_same(const struct camera *a, const struct camera *b) {
  bool same = a->fov == b->fov;
  for (int c = 0; c < 3; ++c)
    same = same && a->from[c] == b->from[c] && a->at[c] == b->at[c] && a->up[c] == b->up[c];
  return same;
}

double viewer_camera_distance(const struct camera *camera) {
  double offset[3];
  vector_subtract(camera->from, camera->at, offset);
  return vector_length(offset);
}

void viewer_camera_orbit(struct camera *camera, double right, double up) {
  double forward[3], across[3], above[3], axis[3], level[3], offset[3];
  double distance = viewer_camera_distance(camera);
  camera_axes(camera, forward, across, above);
  memcpy(axis, camera->up, sizeof axis);
  vector_normalise(axis);
  double height = asin(fmax(-1, fmin(1, -vector_dot(forward, axis))));
  for (int c = 0; c < 3; ++c) level[c] = -forward[c] - sin(height) * axis[c];
  vector_normalise(level);
  double most = M_PI / 2 - steepest;
  height = fmax(-most, fmin(most, height + up));
  for (int c = 0; c < 3; ++c) {
    offset[c] = cos(height) * (cos(right) * level[c] + sin(right) * across[c]);
    camera->from[c] = camera->at[c] + distance * (offset[c] + sin(height) * axis[c]);
  }
}

void viewer_camera_pan(struct camera *camera, double right, double up) {
  double forward[3], across[3], above[3];
  camera_axes(camera, forward, across, above);
  for (int c = 0; c < 3; ++c) {
    double step = right * across[c] + up * above[c];
    camera->from[c] += step;
    camera->at[c] += step;
  }
}

void viewer_camera_zoom(struct camera *camera, double factor) {
  for (int c = 0; c < 3; ++c)
    camera->from[c] = camera->at[c] + factor * (camera->from[c] - camera->at[c]);
}

void viewer_camera_turn(double vector[3], const double p[3], const double q[3], double angle) {
  double a = vector_dot(vector, p), b = vector_dot(vector, q);
  for (int c = 0; c < 3; ++c)
    vector[c] += (a * (cos(angle) - 1) - b * sin(angle)) * p[c] +
                 (a * sin(angle) + b * (cos(angle) - 1)) * q[c];
}
