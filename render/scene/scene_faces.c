#include "scene/scene_faces.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "base/vector.h"

enum { FANS = 8 }; /* corners that are tried */

static enum result no_memory(const struct scene_faces *faces, struct error *error) {
  return result_at(result_no_memory(error), error, "%s", faces->loading->path);
}

/* Room for one more of what a file numbers. */
static enum result one_more(struct scene_faces *faces, void *array, int *room, int count,
                            size_t size, struct error *error) {
  if (count == INT_MAX)
    return result_fail(error, RESULT_BAD, "%s: has more than %d vertices or triangles",
                       faces->loading->path, INT_MAX);
  return scene_grow(array, room, (size_t)count + 1, size) ? RESULT_OK : no_memory(faces, error);
}

/* z is mirrored; no coordinate is -0. */
static void mirror(const double from[3], double to[3]) {
  to[0] = from[0] + 0.0;
  to[1] = from[1] + 0.0;
  to[2] = 0.0 - from[2];
}

enum result scene_faces_position(struct scene_faces *faces, const double xyz[3],
                                 struct error *error) {
  enum result result = one_more(faces, &faces->position, &faces->position_room, faces->positions,
                                sizeof *faces->position, error);
  if (result == RESULT_OK) mirror(xyz, faces->position[faces->positions++]);
  return result;
}

enum result scene_faces_normal(struct scene_faces *faces, const double xyz[3],
                               struct error *error) {
  enum result result = one_more(faces, &faces->normal, &faces->normal_room, faces->normals,
                                sizeof *faces->normal, error);
  if (result == RESULT_OK) mirror(xyz, faces->normal[faces->normals++]);
  return result;
}

enum result scene_faces_uv(struct scene_faces *faces, const double uv[2], struct error *error) {
  enum result result =
      one_more(faces, &faces->uv, &faces->uv_room, faces->uvs, sizeof *faces->uv, error);
  if (result == RESULT_OK) memcpy(faces->uv[faces->uvs++], uv, sizeof *faces->uv);
  return result;
}

void scene_faces_free(struct scene_faces *faces) {
  free(faces->position);
  free(faces->normal);
  free(faces->uv);
  free(faces->vertex);
  free(faces->made_of);
  free(faces->triangle);
}

enum result scene_faces_fail(const struct scene_faces *faces, const char *what,
                             struct error *error) {
  const char *path = faces->loading->path, *mesh = faces->mesh ? faces->mesh : "";
  if (faces->loading->format == SCENE_PLY)
    return result_fail(error, RESULT_BAD, "%s: face %zu %s", path, faces->number, what);
  return result_fail(error, RESULT_BAD, "%s:%zu: face%s%s%s %s", path, faces->number,
                     *mesh ? " of mesh '" : "", mesh, *mesh ? "'" : "", what);
}

static enum result drop(struct scene_faces *faces, size_t *count, const char *what,
                        struct error *error) {
  ++*count;
  return faces->loading->repair ? RESULT_OK : scene_faces_fail(faces, what, error);
}

bool scene_has_area(const double *const corner[3], double normal[3]) {
  double edge[3][3], longest = 0;
  for (int k = 0; k < 3; ++k) {
    vector_subtract(corner[(k + 1) % 3], corner[k], edge[k]);
    longest = fmax(longest, vector_length(edge[k]));
  }
  vector_cross(edge[0], edge[1], normal);
  double area = vector_length(normal);
  return area > FLT_EPSILON * longest * longest && vector_normalise(normal);
}

/* Normals and texture coordinates that are not there become none. */
static enum result check_names(struct scene_faces *faces, struct scene_corner *corner, int count,
                               struct error *error) {
  bool missing = false, shape = faces->loading->needs == SCENE_SHAPE;
  for (int k = 0; k < count; ++k) {
    missing |= corner[k].normal >= faces->normals || corner[k].uv >= faces->uvs;
    if (shape || corner[k].normal >= faces->normals) corner[k].normal = -1;
    if (shape || corner[k].uv >= faces->uvs) corner[k].uv = -1;
    for (int c = 0; c < 2 && corner[k].uv >= 0; ++c)
      if (!isfinite((float)faces->uv[corner[k].uv][c]))
        return scene_faces_fail(faces, "has texture coordinates that are not finite", error);
  }
  if (!missing || shape) return RESULT_OK;
  return drop(faces, &faces->loading->unnamed,
              "has a corner whose normal or texture coordinates are not there; --repair ignores "
              "them",
              error);
}

static enum result check_corners(const struct scene_faces *faces, const struct scene_corner *corner,
                                 int count, struct error *error) {
  for (int k = 0; k < count; ++k) {
    if (corner[k].position < 0 || corner[k].position >= faces->positions)
      return scene_faces_fail(faces, "has a corner that is no vertex", error);
    for (int c = 0; c < 3; ++c)
      if (!isfinite((float)faces->position[corner[k].position][c]))
        return scene_faces_fail(faces, "has coordinates that are not finite", error);
  }
  return RESULT_OK;
}

static const double *at(const struct scene_faces *faces, const struct scene_corner *corner) {
  return faces->position[corner->position];
}

/* Twice the area, along the normal (M. Newell); of edges from the first corner, whose digits do
 * not cancel far from the origin. */
static void face_normal(const struct scene_faces *faces, const struct scene_corner *corners,
                        int count, double normal[3]) {
  double edge[2][3], cross[3];
  for (int c = 0; c < 3; ++c) normal[c] = 0;
  vector_subtract(at(faces, &corners[1]), at(faces, &corners[0]), edge[0]);
  for (int k = 2; k < count; ++k) {
    vector_subtract(at(faces, &corners[k]), at(faces, &corners[0]), edge[1]);
    vector_cross(edge[0], edge[1], cross);
    for (int c = 0; c < 3; ++c) normal[c] += cross[c];
    memcpy(edge[0], edge[1], sizeof edge[0]);
  }
}

/* Does the corner see all others, each further around it, within a turn? Then the triangles are a
 * fan. */
static bool make_fan(const struct scene_faces *faces, const struct scene_corner *corners, int count,
                     const double normal[3], int apex) {
  double first[3], edge[3], cross[3], own[3];
  bool behind = false; /* more than half a turn from the first edge */
  vector_subtract(at(faces, &corners[(apex + 1) % count]), at(faces, &corners[apex]), first);
  for (int k = 0; k < count - 2; ++k) {
    int *triangle = faces->triangle[k];
    triangle[0] = apex;
    triangle[1] = (apex + k + 1) % count;
    triangle[2] = (apex + k + 2) % count;
    const double *corner[3] = {at(faces, &corners[apex]), at(faces, &corners[triangle[1]]),
                               at(faces, &corners[triangle[2]])};
    if (!scene_has_area(corner, own) || !(vector_dot(own, normal) > 0)) return false;
    vector_subtract(corner[2], corner[0], edge);
    vector_cross(first, edge, cross);
    bool ahead = vector_dot(cross, normal) > 0;
    if (behind && ahead) return false;
    behind = !ahead;
  }
  return true;
}

/* Fills faces->triangle; *made is how many there are. */
static enum result triangulate(struct scene_faces *faces, const struct scene_corner *corners,
                               int count, int *made, bool *crosses, struct error *error) {
  double normal[3];
  *crosses = false;
  *made = count - 2;
  if (count > INT_MAX / 2) return scene_faces_fail(faces, "has too many corners", error);
  if (!array_reserve(&faces->triangle, &faces->triangle_room, 2 * count, sizeof *faces->triangle))
    return no_memory(faces, error);
  for (int k = 0; k < 3; ++k) faces->triangle[0][k] = k;
  if (count == 3) return RESULT_OK;
  face_normal(faces, corners, count, normal);
  for (int apex = 0; apex < count && apex < FANS; ++apex)
    if (make_fan(faces, corners, count, normal, apex)) return RESULT_OK;
  *made = 0;
  if (vector_is_zero(normal)) return RESULT_OK;
  double(*points)[3] = malloc((size_t)count * sizeof *points);
  if (!points) return no_memory(faces, error);
  for (int k = 0; k < count; ++k) memcpy(points[k], at(faces, &corners[k]), sizeof *points);
  enum result result = scene_triangulate((const double(*)[3])points, count, normal, faces->triangle,
                                         made, crosses, error);
  free(points);
  return result_at(result, error, "%s", faces->loading->path);
}

/* A normal that has a direction. */
static bool has_normal(const struct scene_faces *faces, const struct scene_corner *corner) {
  double normal[3];
  if (corner->normal < 0) return false;
  memcpy(normal, faces->normal[corner->normal], sizeof normal);
  return vector_normalise(normal);
}

/* Decides whether the face gets flat normals. */
static enum result check_normals(struct scene_faces *faces, const struct scene_corner *corners,
                                 int count, bool *flat, struct error *error) {
  const char *what = "has no normals; --repair gives it flat ones";
  *flat = false;
  for (int k = 0; k < count && !*flat; ++k) {
    if (has_normal(faces, &corners[k])) continue;
    *flat = true;
    if (corners[k].normal >= 0)
      what = "has a normal without direction; --repair gives it flat ones";
  }
  if (!*flat || faces->told_flat) return RESULT_OK;
  faces->told_flat = true;
  ++faces->loading->flat;
  return faces->loading->repair ? RESULT_OK : scene_faces_fail(faces, what, error);
}

/* Room for so many more vertices and triangles, and for what is known of them. */
static enum result reserve(struct scene_faces *faces, int vertices, int triangles,
                           struct error *error) {
  const struct scene *scene = faces->loading->scene;
  enum result result = scene_reserve(faces->loading, (size_t)vertices, (size_t)triangles, error);
  if (result != RESULT_OK) return result_at(result, error, "%s", faces->loading->path);
  int v = (int)scene->vertices + vertices;
  if (!array_reserve(&faces->vertex, &faces->vertex_room, faces->positions,
                     sizeof *faces->vertex) ||
      (faces->loading->needs == SCENE_SURFACES &&
       !array_reserve(&faces->made_of, &faces->made_of_room, v, sizeof *faces->made_of)))
    return no_memory(faces, error);
  while (faces->vertex_count < faces->positions) faces->vertex[faces->vertex_count++] = -1;
  return RESULT_OK;
}

/* The vertex of a corner: a new one, unless the newest one there is alike. `flat`: the normal of
 * the triangle, or NULL. */
static int find_vertex(struct scene_faces *faces, const struct scene_corner *corner,
                       const double *flat) {
  struct scene *scene = faces->loading->scene;
  int k = faces->vertex[corner->position];
  bool surfaces = scene->normal != NULL;
  if (k >= 0 && !surfaces) return k;
  if (k >= 0 && !flat && faces->made_of[k][0] == corner->normal &&
      faces->made_of[k][1] == corner->uv)
    return k;
  k = (int)scene->vertices++;
  memcpy(scene->position[k], at(faces, corner), sizeof scene->position[k]);
  faces->vertex[corner->position] = k;
  if (!surfaces) return k;
  memcpy(scene->normal[k], flat ? flat : faces->normal[corner->normal], sizeof scene->normal[k]);
  vector_normalise(scene->normal[k]);
  for (int c = 0; c < 2; ++c) scene->uv[k][c] = corner->uv < 0 ? 0 : faces->uv[corner->uv][c];
  faces->made_of[k][0] = flat ? -2 : corner->normal; /* a flat one is never alike */
  faces->made_of[k][1] = corner->uv;
  return k;
}

/* Adds those of the face's triangles that have an area; returns how many. Mirroring turns them
 * over. */
static int add_triangles(struct scene_faces *faces, const struct scene_corner *corners, int made,
                         bool flat) {
  struct scene *scene = faces->loading->scene;
  size_t before = scene->triangles;
  for (int k = 0; k < made; ++k) {
    const struct scene_corner *corner[3] = {&corners[faces->triangle[k][0]],
                                            &corners[faces->triangle[k][2]],
                                            &corners[faces->triangle[k][1]]};
    const double *position[3] = {at(faces, corner[0]), at(faces, corner[1]), at(faces, corner[2])};
    double normal[3];
    if (!scene_has_area(position, normal)) continue;
    size_t t = scene->triangles++;
    for (int c = 0; c < 3; ++c)
      scene->corners[t][c] = find_vertex(faces, corner[c], flat ? normal : NULL);
    if (scene->material) scene->material[t] = faces->material;
  }
  return (int)(scene->triangles - before);
}

enum result scene_faces_add(struct scene_faces *faces, struct scene_corner *corners, int count,
                            struct error *error) {
  struct scene_loading *loading = faces->loading;
  int made = 0;
  bool crosses = false, flat = false;
  enum result result = check_corners(faces, corners, count, error);
  if (result == RESULT_OK) result = check_names(faces, corners, count, error);
  if (result == RESULT_OK && count < 3)
    return drop(faces, &loading->dropped, "has less than three corners; --repair drops it", error);
  if (result == RESULT_OK) result = triangulate(faces, corners, count, &made, &crosses, error);
  if (result == RESULT_OK && crosses)
    return drop(faces, &loading->crossing, "crosses itself; --repair drops it", error);
  if (result == RESULT_OK && loading->needs == SCENE_SURFACES)
    result = check_normals(faces, corners, count, &flat, error);
  if (result == RESULT_OK) result = reserve(faces, 3 * made, made, error);
  if (result != RESULT_OK) return result;
  if (add_triangles(faces, corners, made, flat) > 0) return RESULT_OK;
  return drop(faces, &loading->dropped, "has no area; --repair drops it", error);
}
