/* gltf_mesh.c - a mesh of a glTF file at a node, primitive by primitive, see gltf.h. */
#include <stdio.h>
#include <stdlib.h>

#include "scene/gltf.h"

enum { TRIANGLES = 4, STRIP, FAN };

/* A primitive. The numbers are owned. */
struct piece {
  struct gltf *gltf;
  const json_t *node, *mesh, *primitive, *attributes;
  char name[160];
  int mode;
  int material;
  const struct gltf_look *look;
  struct gltf_numbers position, normal, uv, corner;
};

/* Reads an attribute for each vertex, and moves it by the morph targets; nothing where there is
 * none. */
static enum result read_attribute(struct piece *piece, const char *name,
                                  const struct gltf_wanted *wanted, struct gltf_numbers *numbers,
                                  struct error *error) {
  const json_t *number = json_object_get(piece->attributes, name);
  if (!number) return RESULT_OK;
  enum result result = gltf_read(piece->gltf, number, wanted, numbers, error);
  if (result == RESULT_OK)
    result =
        gltf_morph(piece->gltf, piece->node, piece->mesh, piece->primitive, name, numbers, error);
  return result_at(result, error, "mesh '%s': %s", piece->name, name);
}

/* u and v of the material's texture, v up. */
static enum result read_uv(struct piece *piece, struct error *error) {
  const struct gltf_wanted wanted = {2, 2, piece->position.count, false};
  struct scene_loading *loading = piece->gltf->loading;
  const struct gltf_look *look = piece->look;
  char name[32];
  bool inside = true;
  snprintf(name, sizeof name, "TEXCOORD_%d", look->set);
  enum result result = read_attribute(piece, name, &wanted, &piece->uv, error);
  if (result == RESULT_OK && !piece->uv.at)
    return scene_unread(loading, error, "mesh '%s' has a texture without texture coordinates",
                        piece->name);
  for (size_t k = 0; k < piece->uv.count; ++k) {
    double *uv = piece->uv.at + 2 * k, turned[2];
    for (int c = 0; c < 2; ++c) {
      const double *row = look->place[c];
      turned[c] = row[0] * uv[0] + row[1] * uv[1] + row[2];
      inside = inside && turned[c] > -1e-3 && turned[c] < 1 + 1e-3;
    }
    uv[0] = turned[0];
    uv[1] = 1 - turned[1];
  }
  if (result != RESULT_OK || inside || look->repeats) return result;
  return scene_ignore(loading, SCENE_EDGES, piece->name) ? RESULT_OK : result_no_memory(error);
}

/* Colours multiply the material's: only white ones change nothing. */
static enum result check_colours(struct piece *piece, struct error *error) {
  const struct gltf_wanted wanted = {3, 4, piece->position.count, false};
  struct gltf_numbers colour = {0};
  bool white = true;
  enum result result = read_attribute(piece, "COLOR_0", &wanted, &colour, error);
  for (size_t k = 0; k < colour.count; ++k)
    for (int c = 0; c < 3; ++c)
      white = white && colour.at[k * (size_t)colour.width + (size_t)c] == 1;
  free(colour.at);
  if (result != RESULT_OK || white) return result;
  return scene_unread(piece->gltf->loading, error, "mesh '%s' has colours at its vertices",
                      piece->name);
}

static enum result read_surface(struct piece *piece, struct error *error) {
  const struct gltf_wanted wanted = {3, 3, piece->position.count, false};
  enum result result = gltf_material(piece->gltf, json_object_get(piece->primitive, "material"),
                                     piece->name, &piece->material, &piece->look, error);
  if (result == RESULT_OK) result = read_attribute(piece, "NORMAL", &wanted, &piece->normal, error);
  if (result == RESULT_OK && piece->look) result = read_uv(piece, error);
  return result == RESULT_OK ? check_colours(piece, error) : result;
}

/* Compressed data are in no accessor, unless the file has both. */
static enum result read_positions(struct piece *piece, struct error *error) {
  static const char draco[] = "KHR_draco_mesh_compression";
  const struct gltf_wanted wanted = {3, 3, 0, false};
  const json_t *number = json_object_get(piece->attributes, "POSITION"), *accessor;
  if (!number) return result_fail(error, RESULT_BAD, "mesh '%s' has no POSITION", piece->name);
  enum result result = gltf_item(piece->gltf, "accessors", number, &accessor, error);
  if (result == RESULT_OK && gltf_extension(piece->primitive, draco) &&
      !json_object_get(accessor, "bufferView"))
    result = result_fail(error, RESULT_BAD, "is compressed by %s, which is not supported", draco);
  if (result != RESULT_OK) return result_at(result, error, "mesh '%s'", piece->name);
  return read_attribute(piece, "POSITION", &wanted, &piece->position, error);
}

/* The number of a vertex, or -1 for one that is not there. */
static int find_vertex(const struct piece *piece, size_t corner) {
  if (!piece->corner.at) return (int)corner;
  double number = piece->corner.at[corner];
  return number < (double)piece->position.count ? (int)number : -1;
}

/* Every second triangle of a strip is wound the other way (3.7.2.1). */
static void find_corners(const struct piece *piece, size_t triangle, int corners[3]) {
  size_t swap = piece->mode == STRIP ? triangle % 2 : 0;
  size_t first = piece->mode == TRIANGLES ? 3 * triangle : piece->mode == STRIP ? triangle : 0;
  size_t next = piece->mode == TRIANGLES ? 3 * triangle + 1 : triangle + 1;
  corners[0] = find_vertex(piece, first);
  corners[1] = find_vertex(piece, next + swap);
  corners[2] = find_vertex(piece, next + 1 - swap);
}

/* Strips are sewn together by triangles that have a corner twice. */
static bool is_seam(const struct piece *piece, const int corners[3]) {
  return piece->mode == STRIP && corners[0] >= 0 &&
         (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]);
}

static enum result add_triangles(struct piece *piece, struct gltf_place *place,
                                 struct error *error) {
  struct scene_loading *loading = piece->gltf->loading;
  size_t corners = piece->corner.at ? piece->corner.count : piece->position.count;
  size_t most = piece->mode == TRIANGLES ? corners / 3 : corners < 3 ? 0 : corners - 2;
  if (piece->mode == TRIANGLES && corners % 3 != 0) {
    ++loading->dropped;
    if (!loading->repair)
      return result_fail(error, RESULT_BAD,
                         "mesh '%s' has %zu corners, which is no whole number of triangles; "
                         "--repair drops the rest",
                         piece->name, corners);
  }
  int(*triangle)[3] = malloc((most + 1) * sizeof *triangle);
  if (!triangle) return result_no_memory(error);
  size_t count = 0;
  for (size_t k = 0; k < most; ++k) {
    find_corners(piece, k, triangle[count]);
    if (!is_seam(piece, triangle[count])) ++count;
  }
  free(piece->corner.at);
  piece->corner.at = NULL;
  struct scene_mesh mesh = {.name = piece->name,
                            .vertices = piece->position.count,
                            .triangles = count,
                            .position = (double(*)[3])piece->position.at,
                            .normal = (double(*)[3])piece->normal.at,
                            .uv = (double(*)[2])piece->uv.at,
                            .corners = triangle,
                            .material = piece->material};
  enum result result = scene_build(loading, &mesh, place->row, error);
  free(triangle);
  return result;
}

static enum result read_piece(struct piece *piece, struct gltf_place *place, struct error *error) {
  const struct gltf_wanted whole = {1, 1, 0, true};
  const json_t *indices = json_object_get(piece->primitive, "indices");
  struct scene_loading *loading = piece->gltf->loading;
  double mode = gltf_number(piece->primitive, "mode", TRIANGLES);
  if (!(mode >= 0 && mode <= FAN))
    return result_fail(error, RESULT_BAD, "mesh '%s' has the mode %g, which is none", piece->name,
                       mode);
  piece->mode = (int)mode;
  if (piece->mode < TRIANGLES)
    return scene_ignore(loading, SCENE_LINES, piece->name) ? RESULT_OK : result_no_memory(error);
  enum result result = read_positions(piece, error);
  if (result == RESULT_OK && loading->needs == SCENE_SURFACES) result = read_surface(piece, error);
  if (result == RESULT_OK && json_object_get(piece->node, "skin") &&
      json_object_get(piece->attributes, "JOINTS_0"))
    result = gltf_skin(piece->gltf, piece->node, piece->attributes, &piece->position,
                       &piece->normal, place, error);
  if (result == RESULT_OK && indices)
    result = result_at(gltf_read(piece->gltf, indices, &whole, &piece->corner, error), error,
                       "mesh '%s': indices", piece->name);
  return result == RESULT_OK ? add_triangles(piece, place, error) : result;
}

/* Its own name, the node's, or the number of the mesh; and which of several primitives it is. */
static void name_piece(struct piece *piece, size_t number, size_t count) {
  const char *name = json_string_value(json_object_get(piece->mesh, "name"));
  char digits[32];
  snprintf(digits, sizeof digits, "%lld",
           (long long)json_integer_value(json_object_get(piece->node, "mesh")));
  if (!name) name = json_string_value(json_object_get(piece->node, "name"));
  int length = snprintf(piece->name, sizeof piece->name, "%.127s", name ? name : digits);
  if (count > 1)
    snprintf(piece->name + length, sizeof piece->name - (size_t)length, "-%zu", number);
}

enum result gltf_mesh(struct gltf *gltf, const json_t *node, const struct gltf_place *place,
                      struct error *error) {
  const json_t *mesh, *primitive;
  size_t k;
  enum result result = gltf_item(gltf, "meshes", json_object_get(node, "mesh"), &mesh, error);
  if (result != RESULT_OK) return result;
  const json_t *primitives = json_object_get(mesh, "primitives");
  json_array_foreach(primitives, k, primitive) {
    struct piece piece = {.gltf = gltf,
                          .node = node,
                          .mesh = mesh,
                          .primitive = primitive,
                          .attributes = json_object_get(primitive, "attributes")};
    struct gltf_place at = *place;
    name_piece(&piece, k, json_array_size(primitives));
    if (result == RESULT_OK) result = read_piece(&piece, &at, error);
    free(piece.position.at);
    free(piece.normal.at);
    free(piece.uv.at);
    free(piece.corner.at);
  }
  return result;
}
