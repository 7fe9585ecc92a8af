/* parallelogram.h - the smallest parallelogram around points of a plane.
 *
 * Some smallest parallelogram has an edge of the points' convex hull on one of
 * each pair of its parallel sides (Schwarz, Teich, Vainshtein, Welzl and Evans,
 * "Minimal enclosing parallelogram with application", 1995), so that trying all
 * pairs of the hull's edges finds it. On the few corners of a cluster's cells
 * that is as fast as their linear algorithm (CGAL's min_parallelogram_2), and
 * needs no library. */
#ifndef PARALLELOGRAM_H
#define PARALLELOGRAM_H

#include "base/result.h"

struct parallelogram {
  double center[2];
  double edge[2][2]; /* full edges */
};

/* Sorts the points. Points on a line
 * get a parallelogram with one edge of length zero, a single point two.
 * Takes time quadratic in the corners of the hull. */
enum result parallelogram_around(double (*points)[2], int count, struct parallelogram *found,
                                 struct error *error);

#endif
