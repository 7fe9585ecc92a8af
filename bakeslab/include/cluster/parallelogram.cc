/* parallelogram.cc - CGAL's min_parallelogram_2, behind parallelogram.h. The exact numbers are
 * Boost's, since GMP's would be one more library to load; the modes of rounding that CGAL checks
 * as the program starts are not used. */
#define CGAL_DISABLE_ROUNDING_MATH_CHECK
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
#include <map>
#include <utility>
#include <vector>

extern "C" {
#include "include/cluster/parallelogram.h"
}

using point = CGAL::Simple_cartesian<boost::multiprecision::cpp_rational>::Point_2;

/* Counterclockwise. Of points above each other, only the ends can be corners: exact numbers are
 * slow. */
static std::vector<point> hull_of(const double (*points)[2], int count) {
  std::map<double, std::pair<double, double>> ends; /* by x: the least and the greatest y */
  std::vector<point> all, hull;
  for (int k = 0; k < count; ++k) {
    const double x = points[k][0], y = points[k][1];
    auto &end = ends.try_emplace(x, y, y).first->second;
    end = {std::min(end.first, y), std::max(end.second, y)};
  }
  for (const auto &[x, y] : ends) {
    all.emplace_back(x, y.first);
    all.emplace_back(x, y.second);
  }
  CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(hull));
  return hull;
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
      for (std::size_t k = 0; k < 4; ++k) at[k] = CGAL::to_double(corners[k][c]);
      found->center[c] = (at[0] + at[2]) / 2;
      found->edge[0][c] = at[1] - at[0];
      found->edge[1][c] = at[3] - at[0];
    }
    return RESULT_OK;
  } catch (const std::bad_alloc &) {
    return result_no_memory(error);
  } catch (const std::exception &failure) {
    return result_fail(error, RESULT_BAD, "no parallelogram: %s", failure.what());
  }
}
