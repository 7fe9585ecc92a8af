/* scene_repair.cc - scene_load.h's scene_repair, by CGAL's Polygon Mesh Processing. The modes of
 * rounding that CGAL checks as the program starts are not used. */
#define CGAL_DISABLE_ROUNDING_MATH_CHECK
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <exception>
#include <vector>

extern "C" {
#include "scene/scene_load.h"
}

namespace soup = CGAL::Polygon_mesh_processing;
using point = CGAL::Simple_cartesian<double>::Point_3;

/* A polygon for CGAL that knows which triangle it was. */
struct triangle : std::array<std::size_t, 3> {
  std::size_t number;
  void resize(std::size_t) {
  }
};

/* Whether each triangle stays. */
static std::vector<bool> find_first(const struct scene *scene) {
  std::vector<point> points;
  std::vector<triangle> triangles(scene->triangles);
  for (std::size_t k = 0; k < scene->vertices; ++k) {
    const double *at = scene->position[k];
    points.emplace_back(at[0], at[1], at[2]);
  }
  for (std::size_t t = 0; t < scene->triangles; ++t) {
    for (std::size_t k = 0; k < 3; ++k) triangles[t][k] = std::size_t(scene->corners[t][k]);
    triangles[t].number = t;
  }
  soup::merge_duplicate_points_in_polygon_soup(points, triangles);
  soup::merge_duplicate_polygons_in_polygon_soup(points, triangles);
  std::vector<bool> stays(scene->triangles);
  for (const triangle &one : triangles) stays[one.number] = true;
  return stays;
}

enum result scene_repair(struct scene_loading *loading, struct error *error) {
  struct scene *scene = loading->scene;
  try {
    const std::vector<bool> stays = find_first(scene);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < scene->triangles; ++t) {
      if (!stays[t]) continue;
      for (int k = 0; k < 3; ++k) scene->corners[kept][k] = scene->corners[t][k];
      if (scene->material) scene->material[kept] = scene->material[t];
      ++kept;
    }
    loading->repeated = scene->triangles - kept;
    scene->triangles = kept;
    return RESULT_OK;
  } catch (const std::bad_alloc &) {
    return result_at(result_no_memory(error), error, "%s", loading->path);
  } catch (const std::exception &failure) {
    return result_fail(error, RESULT_BAD, "%s: cannot be repaired: %s", loading->path,
                       failure.what());
  }
}
