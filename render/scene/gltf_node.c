/* gltf_node.c - a glTF file's nodes and cameras, see gltf.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "scene/gltf.h"

/* Deeper trees than this are none that anyone made. */
enum { MOST_DEPTH = 1000 };

static struct gltf_place place_within(const struct gltf_place *parent,
                                      const struct gltf_place *child) {
  struct gltf_place place = {0};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) {
      place.row[r][c] = c == 3 ? parent->row[r][3] : 0;
      for (int k = 0; k < 3; ++k) place.row[r][c] += parent->row[r][k] * child->row[k][c];
    }
  return place;
}

/* `matrix`, column by column, or translation, rotation (a quaternion x, y, z, w) and scale. */
static struct gltf_place read_place(const json_t *node) {
  double m[16], move[3] = {0}, q[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
  struct gltf_place place;
  if (gltf_array(node, "matrix", 16, m)) {
    for (int k = 0; k < 12; ++k) place.row[k % 3][k / 3] = m[4 * (k / 3) + k % 3];
    return place;
  }
  gltf_array(node, "translation", 3, move);
  gltf_array(node, "rotation", 4, q);
  gltf_array(node, "scale", 3, scale);
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  const double turn[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                             {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                             {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) place.row[r][c] = turn[r][c] * scale[c];
    place.row[r][3] = move[r];
  }
  return place;
}

/* A node has one parent (3.5.2): one that comes twice would let a small file be an endless scene.
 */
static enum result walk(struct gltf *gltf, const json_t *number, const struct gltf_place *parent,
                        int depth, struct error *error) {
  const json_t *node, *child;
  enum result result = gltf_item(gltf, "nodes", number, &node, error);
  if (result != RESULT_OK) return result;
  size_t at = (size_t)json_integer_value(number), k;
  if (gltf->seen[at]) return result_fail(error, RESULT_BAD, "has node %zu twice in one scene", at);
  if (depth > MOST_DEPTH)
    return result_fail(error, RESULT_BAD, "has nodes that are %d deep", depth);
  struct gltf_place own = read_place(node);
  gltf->seen[at] = true;
  gltf->order[gltf->shown++] = at;
  gltf->places[at] = place_within(parent, &own);
  json_array_foreach(json_object_get(node, "children"), k, child) {
    if (result == RESULT_OK) result = walk(gltf, child, &gltf->places[at], depth + 1, error);
  }
  return result;
}

enum result gltf_nodes(struct gltf *gltf, struct error *error) {
  /* to POV-Ray's left-handed coordinates */
  static const struct gltf_place mirror = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}}};
  const json_t *number = json_object_get(gltf->root, "scene"), *index;
  const json_t *scene = json_array_get(json_object_get(gltf->root, "scenes"), 0);
  size_t count = json_array_size(json_object_get(gltf->root, "nodes")), k;
  if (!scene) return result_fail(error, RESULT_BAD, "has no scene");
  enum result result = number ? gltf_item(gltf, "scenes", number, &scene, error) : RESULT_OK;
  if (result != RESULT_OK) return result;
  gltf->node_count = count;
  gltf->places = calloc(count + 1, sizeof *gltf->places);
  gltf->order = calloc(count + 1, sizeof *gltf->order);
  gltf->seen = calloc(count + 1, sizeof *gltf->seen);
  if (!gltf->places || !gltf->order || !gltf->seen) return result_no_memory(error);
  json_array_foreach(json_object_get(scene, "nodes"), k, index) {
    if (result == RESULT_OK) result = walk(gltf, index, &mirror, 0, error);
  }
  return result;
}

static void copy_name(const json_t *from, char name[128]) {
  const char *text = json_string_value(json_object_get(from, "name"));
  snprintf(name, 128, "%s", text ? text : "");
}

/* A camera looks along -z of its node, with y up. */
static void set_camera(struct scene_camera *made, const json_t *node, const json_t *camera,
                       double row[3][4], int number) {
  const json_t *lens = json_object_get(camera, "perspective");
  *made = (struct scene_camera){.perspective = lens != NULL,
                                .vertical = gltf_number(lens, "yfov", 0) * (180 / M_PI),
                                .aspect = gltf_number(lens, "aspectRatio", 0)};
  copy_name(node, made->name);
  copy_name(camera, made->other_name);
  if (!made->name[0]) memcpy(made->name, made->other_name, sizeof made->name);
  if (!made->name[0]) snprintf(made->name, sizeof made->name, "%d", number);
  for (int r = 0; r < 3; ++r) {
    made->from[r] = row[r][3];
    made->forward[r] = -row[r][2];
    made->up[r] = row[r][1];
  }
}

enum result gltf_cameras(struct gltf *gltf, struct error *error) {
  const json_t *nodes = json_object_get(gltf->root, "nodes"), *camera;
  struct scene *scene = gltf->loading->scene;
  int room = 0;
  for (size_t k = 0; k < gltf->shown; ++k) {
    size_t at = gltf->order[k];
    const json_t *node = json_array_get(nodes, at), *number = json_object_get(node, "camera");
    if (!number) continue;
    enum result result = gltf_item(gltf, "cameras", number, &camera, error);
    if (result != RESULT_OK) return result;
    int count = scene->camera_count;
    if (!array_reserve(&scene->cameras, &room, count + 1, sizeof *scene->cameras))
      return result_no_memory(error);
    ++scene->camera_count;
    set_camera(&scene->cameras[count], node, camera, gltf->places[at].row, count);
  }
  return RESULT_OK;
}
