#include "scene/camera.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/key_values.h"
#include "base/vector.h"

enum result camera_parse(const char *text, struct camera *camera, struct error *error) {
  *camera = (struct camera){.up = {0, 1, 0}, .fov = 60};
  struct key_value keys[] = {{"from=X,Y,Z", 3, camera->from, false, false},
                             {"at=X,Y,Z", 3, camera->at, false, false},
                             {"up=X,Y,Z", 3, camera->up, false, false},
                             {"fov=DEG", 1, &camera->fov, false, false}};
  char what[256];
  snprintf(what, sizeof what, "camera '%s'", text);
  enum result result = key_values_parse(what, text, keys, sizeof keys / sizeof *keys, error);
  if (result != RESULT_OK) return result;
  for (int k = 0; k < 2; ++k)
    if (!keys[k].seen)
      return result_fail(error, RESULT_BAD, "%s: %s is missing", what, keys[k].form);
  return camera_check(what, camera, error);
}

static bool is_finite(const double numbers[3]) {
  return isfinite(numbers[0]) && isfinite(numbers[1]) && isfinite(numbers[2]);
}

enum result camera_check(const char *what, const struct camera *camera, struct error *error) {
  if (!is_finite(camera->from) || !is_finite(camera->at) || !is_finite(camera->up))
    return result_fail(error, RESULT_BAD, "%s: is not finite", what);
  if (!(camera->fov > 0 && camera->fov < 180))
    return result_fail(error, RESULT_BAD, "%s: fov must be between 0 and 180 degrees", what);
  double forward[3], up[3], right[3];
  vector_subtract(camera->at, camera->from, forward);
  memcpy(up, camera->up, sizeof up);
  if (!vector_normalise(forward))
    return result_fail(error, RESULT_BAD, "%s: from and at are the same or too far apart", what);
  if (!vector_normalise(up)) return result_fail(error, RESULT_BAD, "%s: up has no length", what);
  vector_cross(up, forward, right);
  if (vector_length(right) < 1e-9)
    return result_fail(error, RESULT_BAD, "%s: up is along the view; give another up=X,Y,Z", what);
  return RESULT_OK;
}

void camera_axes(const struct camera *camera, double forward[3], double right[3], double up[3]) {
  double upwards[3];
  vector_subtract(camera->at, camera->from, forward);
  vector_normalise(forward);
  memcpy(upwards, camera->up, sizeof upwards);
  vector_normalise(upwards);             /* its length must not matter, however small or large */
  vector_cross(upwards, forward, right); /* left-handed: y cross z is x, as on paper */
  vector_normalise(right);
  vector_cross(forward, right, up);
}

void camera_ray(const struct camera *camera, int width, int height, double x, double y,
                double direction[3]) {
  double forward[3], right[3], up[3];
  camera_axes(camera, forward, right, up);
  double half = tan(camera->fov * (M_PI / 360));
  double across = (2 * x / width - 1) * half, along = (height - 2 * y) / width * half;
  for (int c = 0; c < 3; ++c) direction[c] = forward[c] + across * right[c] + along * up[c];
  vector_normalise(direction);
}
