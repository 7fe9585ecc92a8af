/* parallelogram.h - the smallest parallelogram around points of a plane, by CGAL (Schwarz, Teich,
 * Vainshtein, Welzl and Evans, "Minimal enclosing parallelogram with application", 1995), in
 * exact arithmetic. */
#ifndef PARALLELOGRAM_H
#define PARALLELOGRAM_H

#include "base/result.h"

struct parallelogram {
  double center[2];
  double edge[2][2]; /* full edges from its leftmost corner (of two, the lower one), edge[1]
                        counterclockwise of edge[0] */
};

/* Of one or more finite points. Points on a line get a parallelogram whose edge[1] is zero, a
 * single point one whose edges both are. Of parallelograms equally small it is the first by the
 * direction of their sides, counterclockwise from x. Corners are exact, then rounded. */
enum result parallelogram_around(const double (*points)[2], int count, struct parallelogram *found,
                                 struct error *error);

#endif
