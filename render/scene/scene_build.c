/* scene_build.c - see scene_build.h. */
#include "scene/scene_build.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* One mesh at its place. */
struct building {
  struct scene_loading *loading;
  const struct scene_mesh *mesh;
  double (*place)[4];
  double cofactor[3][3];
  bool mirrors; /* triangles must be wound the other way */
  bool flat;    /* gets normals of its own: three vertices for each triangle */
};

static void find_cofactors(struct building *building) {
  double rows[3][3];
  for (int r = 0; r < 3; ++r) memcpy(rows[r], building->place[r], sizeof rows[r]);
  for (int r = 0; r < 3; ++r)
    vector_cross(rows[(r + 1) % 3], rows[(r + 2) % 3], building->cofactor[r]);
  building->mirrors = vector_dot(rows[0], building->cofactor[0]) < 0;
}

static void find_position(const struct building *building, int vertex, double out[3]) {
  for (int r = 0; r < 3; ++r) {
    const double *row = building->place[r];
    out[r] = vector_dot(row, building->mesh->position[vertex]) + row[3];
  }
}

/* False where it has no direction. */
static bool find_normal(const struct building *building, int vertex, double out[3]) {
  double side = building->mirrors ? -1 : 1;
  for (int r = 0; r < 3; ++r)
    out[r] = side * vector_dot(building->cofactor[r], building->mesh->normal[vertex]);
  return vector_normalise(out);
}

static void add_vertex(const struct building *building, int vertex, const double *flat_normal) {
  struct scene *scene = building->loading->scene;
  const struct scene_mesh *mesh = building->mesh;
  size_t k = scene->vertices++;
  find_position(building, vertex, scene->position[k]);
  if (!scene->normal) return;
  if (flat_normal)
    memcpy(scene->normal[k], flat_normal, sizeof scene->normal[k]);
  else
    find_normal(building, vertex, scene->normal[k]);
  for (int c = 0; c < 2; ++c) scene->uv[k][c] = mesh->uv ? mesh->uv[vertex][c] : 0;
}

static enum result bad_triangle(const struct building *building, size_t triangle, const char *what,
                                struct error *error) {
  return result_fail(error, RESULT_BAD, "mesh '%s': triangle %zu %s", building->mesh->name,
                     triangle + 1, what);
}

/* The corners that it has, wound as they shall be, and where they are. */
static enum result find_corners(const struct building *building, size_t triangle, int index[3],
                                double (*corner)[3], struct error *error) {
  const struct scene_mesh *mesh = building->mesh;
  int second = building->mirrors ? 2 : 1;
  index[0] = mesh->corners[triangle][0];
  index[1] = mesh->corners[triangle][second];
  index[2] = mesh->corners[triangle][3 - second];
  for (int k = 0; k < 3; ++k) {
    if (index[k] < 0 || (size_t)index[k] >= mesh->vertices)
      return bad_triangle(building, triangle, "has a corner that is no vertex", error);
    find_position(building, index[k], corner[k]);
    for (int c = 0; c < 3; ++c)
      if (!isfinite((float)corner[k][c]))
        return bad_triangle(building, triangle, "has coordinates that are not finite", error);
    const double *uv = mesh->uv ? mesh->uv[index[k]] : NULL;
    if (uv && !(isfinite((float)uv[0]) && isfinite((float)uv[1])))
      return bad_triangle(building, triangle, "has texture coordinates that are not finite", error);
  }
  return RESULT_OK;
}

static enum result add_triangle(struct building *building, size_t triangle, size_t base,
                                struct error *error) {
  struct scene *scene = building->loading->scene;
  int index[3];
  double corner[3][3], normal[3];
  enum result result = find_corners(building, triangle, index, corner, error);
  if (result != RESULT_OK) return result;
  if (!scene_has_area((const double *const[]){corner[0], corner[1], corner[2]}, normal)) {
    ++building->loading->dropped;
    if (building->loading->repair) return RESULT_OK;
    return bad_triangle(building, triangle, "has no area; --repair drops it", error);
  }
  size_t t = scene->triangles++;
  for (int k = 0; k < 3; ++k) {
    scene->corners[t][k] = (int)(building->flat ? scene->vertices : base + (size_t)index[k]);
    if (building->flat) add_vertex(building, index[k], normal);
  }
  if (scene->material) scene->material[t] = building->mesh->material;
  return RESULT_OK;
}

/* Decides whether the mesh gets flat normals. Corners that are no vertex are refused later. */
static enum result check_normals(struct building *building, struct error *error) {
  const struct scene_mesh *mesh = building->mesh;
  const char *what = "has no normals";
  double normal[3];
  building->flat = !mesh->normal;
  for (size_t t = 0; t < mesh->triangles && !building->flat; ++t)
    for (int k = 0; k < 3; ++k) {
      int vertex = mesh->corners[t][k];
      if (vertex < 0 || (size_t)vertex >= mesh->vertices || find_normal(building, vertex, normal))
        continue;
      building->flat = true;
      what = "has a normal without direction";
    }
  if (!building->flat) return RESULT_OK;
  ++building->loading->flat;
  if (building->loading->repair) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "mesh '%s' %s; --repair gives it flat ones", mesh->name,
                     what);
}

enum result scene_build(struct scene_loading *loading, const struct scene_mesh *mesh,
                        double place[3][4], struct error *error) {
  struct building building = {.loading = loading, .mesh = mesh, .place = place};
  enum result result = RESULT_OK;
  find_cofactors(&building);
  if (loading->needs == SCENE_SURFACES) result = check_normals(&building, error);
  size_t vertices = building.flat ? 3 * mesh->triangles : mesh->vertices;
  if (result == RESULT_OK) result = scene_reserve(loading, vertices, mesh->triangles, error);
  size_t base = loading->scene->vertices;
  for (size_t v = 0; v < mesh->vertices && !building.flat && result == RESULT_OK; ++v)
    add_vertex(&building, (int)v, NULL);
  for (size_t t = 0; t < mesh->triangles && result == RESULT_OK; ++t)
    result = add_triangle(&building, t, base, error);
  return result;
}
