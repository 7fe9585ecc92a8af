/* vector.h - vectors of three doubles. */
#ifndef VECTOR_H
#define VECTOR_H

#include <math.h>
#include <stdbool.h>

static inline double vector_dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static inline bool vector_is_zero(const double x[3]) {
  return x[0] == 0 && x[1] == 0 && x[2] == 0;
}

static inline void vector_cross(const double x[3], const double y[3], double out[3]) {
  double z[3] = {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  for (int c = 0; c < 3; ++c) out[c] = z[c];
}

static inline void vector_subtract(const double x[3], const double y[3], double out[3]) {
  for (int c = 0; c < 3; ++c) out[c] = x[c] - y[c];
}

/* Neither overflows nor underflows, whatever the unit of length. */
static inline double vector_length(const double x[3]) {
  return hypot(hypot(x[0], x[1]), x[2]);
}

/* Boxes by their corners: one around nothing, and one that also holds x. */
static inline void vector_box(double low[3], double high[3]) {
  for (int c = 0; c < 3; ++c) {
    low[c] = INFINITY;
    high[c] = -INFINITY;
  }
}

static inline void vector_widen(double low[3], double high[3], const double x[3]) {
  for (int c = 0; c < 3; ++c) {
    low[c] = fmin(low[c], x[c]);
    high[c] = fmax(high[c], x[c]);
  }
}

/* False where it has no direction: zero or not finite. */
static inline bool vector_normalise(double x[3]) {
  double length = vector_length(x);
  if (!(length > 0) || !isfinite(length)) return false;
  for (int c = 0; c < 3; ++c) x[c] /= length;
  return true;
}

#endif
