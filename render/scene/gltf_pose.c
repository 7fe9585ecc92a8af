/* gltf_pose.c - vertices that morph targets and skins move, in the pose that the file has without
 * its animations, see gltf.h. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "scene/gltf.h"

enum result gltf_morph(struct gltf *gltf, const json_t *node, const json_t *mesh,
                       const json_t *primitive, const char *attribute, struct gltf_numbers *numbers,
                       struct error *error) {
  const json_t *weights = json_object_get(node, "weights"), *target;
  size_t k;
  if (!weights) weights = json_object_get(mesh, "weights");
  const struct gltf_wanted wanted = {numbers->width, numbers->width, numbers->count, false};
  json_array_foreach(json_object_get(primitive, "targets"), k, target) {
    double weight = json_number_value(json_array_get(weights, k));
    const json_t *number = json_object_get(target, attribute);
    struct gltf_numbers moves;
    if (weight == 0 || !number) continue;
    enum result result = gltf_read(gltf, number, &wanted, &moves, error);
    if (result != RESULT_OK) return result_at(result, error, "morph target %zu", k);
    size_t count = numbers->count * (size_t)numbers->width;
    for (size_t n = 0; n < count; ++n) numbers->at[n] += weight * moves.at[n];
    free(moves.at);
  }
  return RESULT_OK;
}

/* What a skin asks for; owned. */
struct skin {
  size_t count;
  struct gltf_place *joints; /* [count]: from the mesh as it was bound to the scene */
  double (*sum)[3][4];       /* [vertices]: by their joints and weights */
};

/* place * matrix, which is written column by column. */
static struct gltf_place unbind(const struct gltf_place *place, const double *matrix) {
  struct gltf_place joint = {0};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 4; ++k) joint.row[r][c] += place->row[r][k] * matrix[4 * c + k];
  return joint;
}

static enum result read_joints(struct gltf *gltf, const json_t *json, struct skin *skin,
                               struct error *error) {
  static const double still[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const json_t *joints = json_object_get(json, "joints"), *node, *number;
  const json_t *matrices = json_object_get(json, "inverseBindMatrices");
  struct gltf_numbers bound = {0};
  size_t k;
  skin->count = json_array_size(joints);
  const struct gltf_wanted wanted = {16, 16, skin->count, false};
  enum result result = matrices ? gltf_read(gltf, matrices, &wanted, &bound, error) : RESULT_OK;
  skin->joints = calloc(skin->count + 1, sizeof *skin->joints);
  if (!skin->joints) result = result_no_memory(error);
  json_array_foreach(joints, k, number) {
    if (result == RESULT_OK) result = gltf_item(gltf, "nodes", number, &node, error);
    if (result != RESULT_OK) break;
    size_t at = (size_t)json_integer_value(number);
    if (!gltf->seen[at])
      result = result_fail(error, RESULT_BAD, "its joint, node %zu, is not in the scene", at);
    skin->joints[k] = unbind(&gltf->places[at], bound.at ? bound.at + 16 * k : still);
  }
  free(bound.at);
  return result;
}

/* Adds the joints of one set, JOINTS_0 and so on, to each vertex. */
static enum result add_set(struct gltf *gltf, const json_t *attributes, int set, size_t vertices,
                           struct skin *skin, struct error *error) {
  const struct gltf_wanted whole = {4, 4, vertices, true}, any = {4, 4, vertices, false};
  struct gltf_numbers joints = {0}, weights = {0};
  char names[2][32];
  snprintf(names[0], sizeof names[0], "JOINTS_%d", set);
  snprintf(names[1], sizeof names[1], "WEIGHTS_%d", set);
  enum result result =
      gltf_read(gltf, json_object_get(attributes, names[0]), &whole, &joints, error);
  if (result == RESULT_OK)
    result = gltf_read(gltf, json_object_get(attributes, names[1]), &any, &weights, error);
  for (size_t k = 0; k < 4 * vertices && result == RESULT_OK; ++k) {
    if (weights.at[k] == 0) continue;
    if (joints.at[k] >= (double)skin->count) {
      result = result_fail(error, RESULT_BAD, "has %zu joints, and a vertex asks for number %.0f",
                           skin->count, joints.at[k]);
      break;
    }
    const struct gltf_place *joint = &skin->joints[(size_t)joints.at[k]];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) skin->sum[k / 4][r][c] += weights.at[k] * joint->row[r][c];
  }
  free(joints.at);
  free(weights.at);
  return result;
}

/* Moves a vertex, in the file's right-handed coordinates: the scene's have z mirrored. */
static void move_vertex(double (*sum)[4], double *position, double *normal) {
  double rows[3][3], moved[3], turned[3], cofactor[3];
  for (int r = 0; r < 3; ++r) {
    double side = r == 2 ? -1 : 1;
    for (int c = 0; c < 3; ++c) rows[r][c] = side * sum[r][c];
    moved[r] = vector_dot(rows[r], position) + side * sum[r][3];
  }
  memcpy(position, moved, sizeof moved);
  if (!normal) return;
  for (int r = 0; r < 3; ++r) {
    vector_cross(rows[(r + 1) % 3], rows[(r + 2) % 3], cofactor);
    turned[r] = vector_dot(cofactor, normal);
  }
  memcpy(normal, turned, sizeof turned);
}

enum result gltf_skin(struct gltf *gltf, const json_t *node, const json_t *attributes,
                      struct gltf_numbers *position, struct gltf_numbers *normal,
                      struct gltf_place *place, struct error *error) {
  const json_t *json, *number = json_object_get(node, "skin");
  size_t vertices = position->count;
  struct skin skin = {0};
  char name[32];
  enum result result = gltf_item(gltf, "skins", number, &json, error);
  if (result != RESULT_OK) return result;
  result = read_joints(gltf, json, &skin, error);
  skin.sum = calloc(vertices, sizeof *skin.sum);
  if (!skin.sum) result = result_no_memory(error);
  for (int set = 0; result == RESULT_OK; ++set) {
    snprintf(name, sizeof name, "JOINTS_%d", set);
    if (set > 0 && !json_object_get(attributes, name)) break;
    result = add_set(gltf, attributes, set, vertices, &skin, error);
  }
  for (size_t k = 0; k < vertices && result == RESULT_OK; ++k)
    move_vertex(skin.sum[k], position->at + 3 * k, normal->at ? normal->at + 3 * k : NULL);
  *place = (struct gltf_place){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}}};
  free(skin.joints);
  free(skin.sum);
  return result_at(result, error, "skin %lld", (long long)json_integer_value(number));
}
