/* scene_camera.c - a mesh file's own camera, by its name. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "scene/scene.h"

/* A node's name comes before a camera's, which several nodes may share. */
static enum result find(const struct scene *scene, const char *path, const char *name,
                        const struct scene_camera **found, struct error *error) {
  char there[512];
  int count = 0;
  for (int other = 0; other < 2 && count == 0; ++other)
    for (int k = 0; k < scene->camera_count; ++k) {
      const struct scene_camera *camera = &scene->cameras[k];
      if (strcmp(other ? camera->other_name : camera->name, name) != 0) continue;
      *found = camera;
      ++count;
    }
  if (count == 1) return RESULT_OK;
  if (count > 1)
    return result_fail(error, RESULT_BAD, "%s: has %d cameras '%s'; rename their nodes", path,
                       count, name);
  return result_fail(
      error, RESULT_BAD, "%s: has no camera '%s', but %s; or give --camera 'from=X,Y,Z at=X,Y,Z'",
      path, name,
      scene->camera_count > 0 ? scene_camera_names(scene, sizeof there, there) : "none at all");
}

const char *scene_camera_names(const struct scene *scene, size_t room, char *names) {
  size_t at = 0;
  names[0] = 0;
  for (int k = 0; k < scene->camera_count && at < room - 1; ++k)
    at += (size_t)snprintf(names + at, room - at, "%s'%s'", k > 0 ? ", " : "",
                           scene->cameras[k].name);
  return names;
}

/* How far the middle of the scene is before the camera: that is where it looks. */
static double depth(const struct scene *scene, const struct scene_camera *camera,
                    const double forward[3]) {
  double low[3], high[3], way[3];
  scene_box(scene, low, high);
  for (int c = 0; c < 3; ++c) way[c] = low[c] / 2 + high[c] / 2 - camera->from[c];
  double far = vector_dot(way, forward);
  return far > 0 ? far : 1;
}

enum result scene_find_camera(const struct scene *scene, const char *path, const char *name,
                              double aspect, struct camera *camera, struct error *error) {
  const struct scene_camera *found = NULL;
  double forward[3];
  char what[512];
  enum result result = find(scene, path, name, &found, error);
  if (result != RESULT_OK) return result;
  snprintf(what, sizeof what, "%s: camera '%s'", path, name);
  if (!found->perspective)
    return result_fail(error, RESULT_BAD, "%s: is orthographic, which is not supported", what);
  memcpy(forward, found->forward, sizeof forward);
  memcpy(camera->from, found->from, sizeof camera->from);
  memcpy(camera->up, found->up, sizeof camera->up);
  if (!vector_normalise(forward))
    return result_fail(error, RESULT_BAD, "%s: looks nowhere: its node has no size", what);
  double far = depth(scene, found, forward), half = tan(found->vertical * (M_PI / 360));
  for (int c = 0; c < 3; ++c) camera->at[c] = camera->from[c] + far * forward[c];
  camera->fov = atan(half * (found->aspect > 0 ? found->aspect : aspect)) * (360 / M_PI);
  return camera_check(what, camera, error);
}
