/* parallelogram.c - the smallest parallelogram around points. */
#include "include/cluster/parallelogram.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double cross(const double x[2], const double y[2]) {
  return x[0] * y[1] - x[1] * y[0];
}

static int by_place(const void *a, const void *b) {
  const double *x = a, *y = b;
  if (x[0] != y[0]) return x[0] < y[0] ? -1 : 1;
  return (x[1] > y[1]) - (x[1] < y[1]);
}

/* Whether the hull turns left at its last point, towards `next`. */
static int turns_left(double (*hull)[2], int size, const double next[2]) {
  const double *from = hull[size - 2], *over = hull[size - 1];
  const double first[2] = {over[0] - from[0], over[1] - from[1]};
  const double second[2] = {next[0] - over[0], next[1] - over[1]};
  return cross(first, second) > 0;
}

/* Andrew's monotone chain. `hull` has room for 2 count points. Its corners run
 * to the left; the first is not repeated. */
static int convex_hull(double (*points)[2], int count, double (*hull)[2]) {
  qsort(points, (size_t)count, sizeof *points, by_place);
  int size = 0;
  for (int pass = 0; pass < 2; ++pass) {
    int base = size;
    for (int k = 0; k < count; ++k) {
      const double *next = points[pass ? count - 1 - k : k];
      while (size - base >= 2 && !turns_left(hull, size, next)) --size;
      memcpy(hull[size++], next, sizeof *hull);
    }
    --size; /* the other pass starts there */
  }
  return size > 0 ? size : 1;
}

/* The strip between the parallels to `along` that touch the hull: their places
 * on the unit vector to the left of `along`. */
struct strip {
  double along[2], across[2], low, high;
};

static struct strip strip_along(double (*hull)[2], int size, int edge) {
  const double *from = hull[edge], *to = hull[(edge + 1) % size];
  double length = hypot(to[0] - from[0], to[1] - from[1]);
  struct strip strip = {.low = INFINITY, .high = -INFINITY};
  for (int c = 0; c < 2; ++c) strip.along[c] = (to[c] - from[c]) / length;
  strip.across[0] = -strip.along[1];
  strip.across[1] = strip.along[0];
  for (int k = 0; k < size; ++k) {
    double place = hull[k][0] * strip.across[0] + hull[k][1] * strip.across[1];
    strip.low = fmin(strip.low, place);
    strip.high = fmax(strip.high, place);
  }
  return strip;
}

/* Where the strips meet. */
static struct parallelogram meet(const struct strip *x, const struct strip *y) {
  double sine = cross(x->along, y->along);
  struct parallelogram found;
  double middle[2] = {(x->low + x->high) / 2, (y->low + y->high) / 2};
  for (int c = 0; c < 2; ++c) {
    found.edge[0][c] = x->along[c] * (y->high - y->low) / sine;
    found.edge[1][c] = y->along[c] * (x->high - x->low) / sine;
    /* Along y the first strip is crossed, along x the second, against its across. */
    found.center[c] = (middle[0] * y->along[c] - middle[1] * x->along[c]) / sine;
  }
  return found;
}

static struct parallelogram around_line(double (*hull)[2], int size) {
  struct parallelogram found = {{0}, {{0}}};
  for (int c = 0; c < 2; ++c) {
    found.center[c] = (hull[0][c] + hull[size - 1][c]) / 2;
    found.edge[0][c] = hull[size - 1][c] - hull[0][c];
  }
  return found;
}

static struct parallelogram around_hull(double (*hull)[2], int size, struct strip *strips) {
  struct parallelogram best = {{0}, {{0}}};
  double least = INFINITY;
  for (int k = 0; k < size; ++k) strips[k] = strip_along(hull, size, k);
  for (int k = 0; k < size; ++k)
    for (int m = 0; m < k; ++m) {
      double sine = fabs(cross(strips[k].along, strips[m].along));
      double area = (strips[k].high - strips[k].low) * (strips[m].high - strips[m].low) / sine;
      if (!(sine > 1e-9) || area >= least) continue;
      least = area;
      best = meet(&strips[m], &strips[k]);
    }
  return best;
}

enum result parallelogram_around(double (*points)[2], int count, struct parallelogram *found,
                                 struct error *error) {
  double(*hull)[2] = calloc(2 * (size_t)count + 1, sizeof *hull);
  struct strip *strips = calloc((size_t)count + 1, sizeof *strips);
  enum result result = RESULT_OK;
  if (hull && strips) {
    int size = convex_hull(points, count, hull);
    *found = size > 2 ? around_hull(hull, size, strips) : around_line(hull, size);
  } else {
    result = result_fail(error, RESULT_MEMORY, "out of memory");
  }
  free(hull);
  free(strips);
  return result;
}
