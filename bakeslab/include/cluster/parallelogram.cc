/* parallelogram.cc - CGAL's min_parallelogram_2, behind parallelogram.h. Exact numbers are CGAL's
 * own and Boost's, since GMP's would be one more library to load; the modes of rounding that CGAL
 * checks as the program starts are not used. */
#define CGAL_DISABLE_ROUNDING_MATH_CHECK
#include <CGAL/MP_Float.h>
#include <CGAL/boost_mp.h>
/* the numbers come first */
#include <CGAL/Simple_cartesian.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/min_quadrilateral_2.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <exception>
#include <iterator>
#include <vector>

extern "C" {
#include "include/cluster/parallelogram.h"
}

/* A hull needs no division: these numbers are much faster. */
using hull_point = CGAL::Simple_cartesian<CGAL::MP_Float>::Point_2;
using point = CGAL::Simple_cartesian<boost::multiprecision::cpp_rational>::Point_2;

static std::vector<point> hull_of(const double (*points)[2], int count) {
  std::vector<hull_point> all, hull;
  std::vector<point> found;
  for (int k = 0; k < count; ++k) all.emplace_back(points[k][0], points[k][1]);
  CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(hull));
  for (const hull_point &p : hull)
    found.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()));
  return found;
}

/* Counterclockwise from the leftmost. */
static std::array<point, 4> corners_around(const std::vector<point> &hull) {
  if (hull.size() < 3) return {hull.front(), hull.back(), hull.back(), hull.front()};
  std::array<point, 4> corners;
  CGAL::min_parallelogram_2(hull.begin(), hull.end(), corners.begin());
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

enum result parallelogram_around(const double (*points)[2], int count, parallelogram *found,
                                 error *error) {
  try {
    const std::array<point, 4> corners = corners_around(hull_of(points, count));
    for (int c = 0; c < 2; ++c) {
      double at[4];
      for (int k = 0; k < 4; ++k) at[k] = CGAL::to_double(corners[k][c]);
      found->center[c] = (at[0] + at[2]) / 2;
      found->edge[0][c] = at[1] - at[0];
      found->edge[1][c] = at[3] - at[0];
    }
    return RESULT_OK;
  } catch (const std::bad_alloc &) {
    return result_fail(error, RESULT_MEMORY, "out of memory");
  } catch (const std::exception &failure) {
    return result_fail(error, RESULT_BAD, "no parallelogram: %s", failure.what());
  }
}
