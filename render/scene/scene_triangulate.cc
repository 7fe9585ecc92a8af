/* scene_triangulate.cc - scene_faces.h's scene_triangulate, by CGAL's constrained Delaunay
 * triangulations: predicates are exact, and there are no new points.
 *
 * 1. Corners become vertices; those at the same point are one.
 * 2. Edges of the outline are constraints. Vertices on an edge divide it.
 * 3. Crossing an edge of a triangle changes the winding number of the outline by how often the
 *    outline runs along it in the one direction more than in the other. */
#define CGAL_DISABLE_ROUNDING_MATH_CHECK /* flat.mk compiles it as it must be */
#define CGAL_DISABLE_GMP 1               /* degenerate faces are too rare to need it */
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <cmath>
#include <exception>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

extern "C" {
#include "scene/scene_faces.h"
}

using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct visit {
  bool seen = false;
  int winding = 0;
};
using vertex_base = CGAL::Triangulation_vertex_base_with_info_2<int, kernel>;
using face_base =
    CGAL::Triangulation_face_base_with_info_2<visit, kernel,
                                              CGAL::Constrained_triangulation_face_base_2<kernel>>;
using plane = CGAL::Constrained_Delaunay_triangulation_2<
    kernel, CGAL::Triangulation_data_structure_2<vertex_base, face_base>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;
using vertex = plane::Vertex_handle;
using runs = std::map<std::pair<vertex, vertex>, int>;

/* An order of corners in which a triangulation grows fast, where the outline's own is the slowest:
 * CGAL's along a Hilbert curve, the same each time. It begins with three that are not on one line,
 * as those are searched one by one. */
static std::vector<std::size_t> insertion_order(const std::vector<kernel::Point_2> &points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::size_t second = 0, third = 0;
  while (second + 1 < points.size() && points[second] == points[0]) ++second;
  for (std::size_t k = second; k < points.size() && third == 0; ++k)
    if (!CGAL::collinear(points[0], points[second], points[k])) third = k;
  using points_map = CGAL::Pointer_property_map<kernel::Point_2>::const_type;
  CGAL::spatial_sort(
      order.begin(), order.end(),
      CGAL::Spatial_sort_traits_adapter_2<kernel, points_map>(CGAL::make_property_map(points)));
  order.insert(order.begin(), {0, second, third});
  return order;
}

static std::vector<vertex> insert_corners(plane &cdt, const double (*corners)[3], int count, int x,
                                          int y) {
  std::vector<kernel::Point_2> points;
  points.reserve(std::size_t(count));
  for (int k = 0; k < count; ++k) points.emplace_back(corners[k][x], corners[k][y]);
  std::vector<vertex> at(points.size());
  plane::Face_handle near;
  for (const std::size_t k : insertion_order(points)) {
    const std::size_t before = cdt.number_of_vertices();
    at[k] = cdt.insert(points[k], near); // cppcheck-suppress containerOutOfBounds ; k < count
    if (cdt.number_of_vertices() > before) at[k]->info() = int(k);
    near = at[k]->face();
  }
  return at;
}

/* How often the outline runs from the first to the second vertex, less the other way. */
static runs count_runs(const plane &cdt, const std::vector<vertex> &at) {
  runs net;
  for (std::size_t k = 0; k < at.size(); ++k) {
    vertex here = at[k];
    const vertex there = at[(k + 1) % at.size()];
    while (here != there) {
      vertex next;
      plane::Face_handle face;
      int index;
      if (!cdt.includes_edge(here, there, next, face, index)) break;
      ++net[{here, next}];
      --net[{next, here}];
      here = next;
    }
  }
  return net;
}

/* Finds the winding number of each face. False where it is not that of a simple outline. */
static bool wind(plane &cdt, const runs &net, int inside) {
  std::vector<plane::Face_handle> left{cdt.infinite_face()};
  left.back()->info().seen = true;
  while (!left.empty()) {
    const plane::Face_handle face = left.back();
    left.pop_back();
    for (int k = 0; k < 3; ++k) {
      const plane::Face_handle other = face->neighbor(k);
      if (other->info().seen) continue;
      /* The edge as the other face has it on its left side. */
      const auto run = net.find({face->vertex(plane::cw(k)), face->vertex(plane::ccw(k))});
      other->info().seen = true;
      other->info().winding = face->info().winding + (run == net.end() ? 0 : run->second);
      if (other->info().winding != 0 && other->info().winding != inside) return false;
      left.push_back(other);
    }
  }
  return true;
}

enum result scene_triangulate(const double (*corners)[3], int count, const double normal[3],
                              int (*triangles)[3], int *made, bool *crosses, struct error *error) {
  *made = 0;
  *crosses = false;
  int axis = 0;
  for (int c = 1; c < 3; ++c)
    if (std::fabs(normal[c]) > std::fabs(normal[axis])) axis = c;
  try {
    plane cdt;
    const std::vector<vertex> at =
        insert_corners(cdt, corners, count, (axis + 1) % 3, (axis + 2) % 3);
    if (cdt.dimension() < 2) return RESULT_OK;
    for (int k = 0; k < count; ++k)
      if (at[std::size_t(k)] != at[std::size_t((k + 1) % count)])
        cdt.insert_constraint(at[std::size_t(k)], at[std::size_t((k + 1) % count)]);
    const int inside = normal[axis] > 0 ? 1 : -1;
    *crosses = !wind(cdt, count_runs(cdt, at), inside);
    if (*crosses) return RESULT_OK;
    for (const plane::Face_handle face : cdt.finite_face_handles()) {
      if (face->info().winding == 0) continue;
      for (int k = 0; k < 3; ++k)
        triangles[*made][k] = face->vertex(inside > 0 ? k : 2 - k)->info();
      ++*made;
    }
    return RESULT_OK;
  } catch (const plane::Intersection_of_constraints_exception &) {
    *made = 0;
    *crosses = true;
    return RESULT_OK;
  } catch (const std::bad_alloc &) {
    return result_no_memory(error);
  } catch (const std::exception &failure) {
    return result_fail(error, RESULT_BAD, "a face cannot be triangulated: %s", failure.what());
  }
}
