/* camera.c - see camera.h. */
#include "camera.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "vector.h"

static const char BLANKS[] = " \t\r\n";

/* Reads `count` finite numbers with commas between them, up to a blank or the end. */
static bool read_numbers(const char *text, int count, double *out) {
  for (int k = 0; k < count; ++k) {
    char *end;
    if (k > 0 && *text++ != ',') return false;
    if (strchr(BLANKS, *text)) return false; /* strtod would skip it; \0 too */
    out[k] = strtod(text, &end);
    if (end == text || !isfinite(out[k])) return false;
    text = end;
  }
  return strchr(BLANKS, *text) != NULL;
}

struct field {
  const char *name; /* with its = */
  const char *form;
  int count;
  double *out;
  bool seen;
};

static enum slab_result read_fields(const char *text, struct field *fields, int count,
                                    struct slab_error *error) {
  const char *at = text + strspn(text, BLANKS);
  while (*at) {
    int length = (int)strcspn(at, BLANKS);
    struct field *field = fields;
    while (field < fields + count && strncmp(at, field->name, strlen(field->name)) != 0) ++field;
    if (field == fields + count)
      return slab_fail(error, SLAB_BAD,
                       "camera '%s': '%.*s' is none of from=X,Y,Z at=X,Y,Z up=X,Y,Z fov=DEG", text,
                       length, at);
    if (field->seen)
      return slab_fail(error, SLAB_BAD, "camera '%s': %s is there twice", text, field->form);
    if (!read_numbers(at + strlen(field->name), field->count, field->out))
      return slab_fail(error, SLAB_BAD, "camera '%s': '%.*s' is not %s with finite numbers", text,
                       length, at, field->form);
    field->seen = true;
    at += length;
    at += strspn(at, BLANKS);
  }
  return SLAB_OK;
}

enum slab_result camera_parse(const char *text, struct camera *camera, struct slab_error *error) {
  *camera = (struct camera){.up = {0, 1, 0}, .fov = 60};
  struct field fields[] = {{"from=", "from=X,Y,Z", 3, camera->from, false},
                           {"at=", "at=X,Y,Z", 3, camera->at, false},
                           {"up=", "up=X,Y,Z", 3, camera->up, false},
                           {"fov=", "fov=DEG", 1, &camera->fov, false}};
  enum slab_result result = read_fields(text, fields, 4, error);
  if (result) return result;
  for (int k = 0; k < 2; ++k)
    if (!fields[k].seen)
      return slab_fail(error, SLAB_BAD, "camera '%s': %s is missing", text, fields[k].form);
  if (!(camera->fov > 0 && camera->fov < 180))
    return slab_fail(error, SLAB_BAD, "camera '%s': fov must be between 0 and 180 degrees", text);
  double forward[3], up[3], right[3];
  vector_subtract(camera->at, camera->from, forward);
  memcpy(up, camera->up, sizeof up);
  if (!vector_normalise(forward))
    return slab_fail(error, SLAB_BAD, "camera '%s': from and at are the same or too far apart",
                     text);
  if (!vector_normalise(up))
    return slab_fail(error, SLAB_BAD, "camera '%s': up has no length", text);
  vector_cross(up, forward, right);
  if (vector_length(right) < 1e-9)
    return slab_fail(error, SLAB_BAD, "camera '%s': up is along the view; give another up=X,Y,Z",
                     text);
  return SLAB_OK;
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
