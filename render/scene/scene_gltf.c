/* scene_gltf.c - the cameras of a glTF file, by its JSON text: assimp knows one name of two, and
 * one node of those that share a camera. */
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "file/json_text.h"
#include "scene/scene_load.h"

/* A node's transform: rows of a 3 x 4 matrix. */
struct place {
  double row[3][4];
};

struct walk {
  struct scene_loading *loading;
  const json_t *nodes, *cameras;
  int room;
};

static struct place place_within(const struct place *parent, const struct place *child) {
  struct place place = {0};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) {
      place.row[r][c] = c == 3 ? parent->row[r][3] : 0;
      for (int k = 0; k < 3; ++k) place.row[r][c] += parent->row[r][k] * child->row[k][c];
    }
  return place;
}

/* False, and nothing is changed, where there is no such array of numbers. */
static bool read_array(const json_t *node, const char *key, size_t count, double *numbers) {
  const json_t *array = json_object_get(node, key);
  if (json_array_size(array) != count) return false;
  for (size_t k = 0; k < count; ++k) numbers[k] = json_number_value(json_array_get(array, k));
  return true;
}

/* `matrix`, column by column, or translation, rotation (a quaternion x, y, z, w) and scale. */
static struct place read_place(const json_t *node) {
  double m[16], move[3] = {0}, q[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
  struct place place;
  if (read_array(node, "matrix", 16, m)) {
    for (int k = 0; k < 12; ++k) place.row[k % 3][k / 3] = m[4 * (k / 3) + k % 3];
    return place;
  }
  read_array(node, "translation", 3, move);
  read_array(node, "rotation", 4, q);
  read_array(node, "scale", 3, scale);
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

static void copy_name(const json_t *from, char name[128]) {
  const char *text = json_string_value(json_object_get(from, "name"));
  snprintf(name, 128, "%s", text ? text : "");
}

/* A camera looks along -z of its node, with y up; z is mirrored, as of meshes. */
static enum result add_camera(struct walk *walk, const json_t *node, const struct place *place,
                              struct error *error) {
  struct scene *scene = walk->loading->scene;
  json_int_t number = json_integer_value(json_object_get(node, "camera"));
  const json_t *camera = number < 0 ? NULL : json_array_get(walk->cameras, (size_t)number);
  const json_t *lens = json_object_get(camera, "perspective");
  if (!camera) return RESULT_OK;
  if (!array_reserve(&scene->cameras, &walk->room, scene->camera_count + 1, sizeof *scene->cameras))
    return result_fail(error, RESULT_MEMORY, "%s: out of memory", walk->loading->path);
  struct scene_camera *made = &scene->cameras[scene->camera_count++];
  *made = (struct scene_camera){.perspective = lens != NULL,
                                .vertical =
                                    json_number_value(json_object_get(lens, "yfov")) * (180 / M_PI),
                                .aspect = json_number_value(json_object_get(lens, "aspectRatio"))};
  copy_name(node, made->name);
  copy_name(camera, made->other_name);
  if (!made->name[0]) memcpy(made->name, made->other_name, sizeof made->name);
  if (!made->name[0]) snprintf(made->name, sizeof made->name, "%d", scene->camera_count - 1);
  for (int r = 0; r < 3; ++r) {
    const double *row = place->row[r], side = r == 2 ? -1 : 1;
    made->from[r] = side * row[3];
    made->forward[r] = -side * row[2];
    made->up[r] = side * row[1];
  }
  return RESULT_OK;
}

/* Nodes that are their own ancestors are deeper than there are nodes. */
static enum result walk_node(struct walk *walk, const json_t *index, const struct place *parent,
                             size_t depth, struct error *error) {
  json_int_t number = json_integer_value(index);
  const json_t *node = number < 0 ? NULL : json_array_get(walk->nodes, (size_t)number);
  if (!node || depth > json_array_size(walk->nodes) || depth > 1000) return RESULT_OK;
  struct place own = read_place(node), place = place_within(parent, &own);
  enum result result = RESULT_OK;
  if (json_object_get(node, "camera")) result = add_camera(walk, node, &place, error);
  size_t k;
  const json_t *child, *children = json_object_get(node, "children");
  json_array_foreach(children, k, child) {
    if (result == RESULT_OK) result = walk_node(walk, child, &place, depth + 1, error);
  }
  return result;
}

/* The JSON text, with a zero at its end: the file, or the first chunk of a .glb. */
static char *read_json(FILE *file) {
  static const char magic[4] = "glTF";
  uint32_t head[5] = {0}; /* magic, version, length; length and type of the chunk */
  long size = 0;
  if (fread(head, 1, sizeof head, file) == sizeof head && !memcmp(head, magic, sizeof magic)) {
    size = (long)head[3];
  } else if (fseek(file, 0, SEEK_END) == 0) {
    size = ftell(file);
    rewind(file);
  }
  char *text = size < 0 ? NULL : malloc((size_t)size + 1);
  if (text) text[fread(text, 1, (size_t)size, file)] = 0;
  return text;
}

enum result scene_gltf_cameras(struct scene_loading *loading, struct error *error) {
  static const struct place still = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  json_t *root = NULL;
  enum result result = RESULT_OK;
  FILE *file = fopen(loading->path, "re");
  if (!file) return result_fail(error, RESULT_IO, "%s: %s", loading->path, strerror(errno));
  char *text = read_json(file);
  fclose(file);
  if (text)
    result = json_read(text, JSON_ALLOW_NUL, &root, error);
  else
    result = result_no_memory(error);
  free(text);
  if (result != RESULT_OK)
    return result_at(result, error, "%s: cannot be read as a mesh", loading->path);
  struct walk walk = {.loading = loading,
                      .nodes = json_object_get(root, "nodes"),
                      .cameras = json_object_get(root, "cameras")};
  json_int_t scene = json_integer_value(json_object_get(root, "scene"));
  const json_t *scenes = json_object_get(root, "scenes"), *index;
  const json_t *shown = scene < 0 ? NULL : json_array_get(scenes, (size_t)scene);
  size_t k;
  json_array_foreach(json_object_get(shown, "nodes"), k, index) {
    if (result == RESULT_OK) result = walk_node(&walk, index, &still, 0, error);
  }
  json_decref(root);
  return result;
}
