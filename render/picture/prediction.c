/* prediction.c - see prediction.h.
 *
 * 1. The inverse of the normal equations of value = p0 + p1 x + p2 y.
 * 2. The leverage of each place. What of a value's error is left when it is fitted with the others
 *    is 1 minus that, so that its distance from the plane through the others alone is its residual
 *    over it (D. M. Allen, "The relationship between variable selection and data augmentation and a
 *    method for prediction", Technometrics 16, 1974). Where that is 0, the plane is level. */
#include "picture/prediction.h"

#include <math.h>

#include "base/vector.h"

static void set_level(int count, struct prediction *prediction) {
  *prediction = (struct prediction){.inverse[0][0] = 1.0 / count};
  for (int k = 0; k < count; ++k) prediction->free[k] = 1 - 1.0 / count;
}

void prediction_make(const struct prediction_places *places, struct prediction *prediction) {
  double n = places->count, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (int k = 0; k < places->count; ++k) {
    const double *at = places->at[k];
    x += at[0], y += at[1];
    xx += at[0] * at[0], xy += at[0] * at[1], yy += at[1] * at[1];
  }
  const double symmetric[6] = {xx * yy - xy * xy, xy * y - x * yy, x * xy - xx * y,
                               n * yy - y * y,    x * y - n * xy,  n * xx - x * x};
  static const int cofactor[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  double determinant = n * symmetric[0] + x * symmetric[1] + y * symmetric[2];
  set_level(places->count, prediction);
  if (!(determinant > 1e-6)) return;
  struct prediction tilted;
  for (int k = 0; k < 9; ++k)
    tilted.inverse[k / 3][k % 3] = symmetric[cofactor[k / 3][k % 3]] / determinant;
  for (int k = 0; k < places->count; ++k) {
    const double at[3] = {1, places->at[k][0], places->at[k][1]};
    tilted.free[k] = 1;
    for (int i = 0; i < 3; ++i) tilted.free[k] -= at[i] * vector_dot(tilted.inverse[i], at);
    if (tilted.free[k] < 1e-6) return;
  }
  *prediction = tilted;
}

double prediction_value(const struct prediction_places *places, const struct prediction *prediction,
                        const double *values, double x, double y, double *value) {
  double sums[3] = {0}, p[3], low = INFINITY, high = -INFINITY, off = 0;
  for (int k = 0; k < places->count; ++k) {
    sums[0] += values[k];
    sums[1] += values[k] * places->at[k][0];
    sums[2] += values[k] * places->at[k][1];
    low = fmin(low, values[k]);
    high = fmax(high, values[k]);
  }
  for (int i = 0; i < 3; ++i) p[i] = vector_dot(prediction->inverse[i], sums);
  for (int k = 0; k < places->count; ++k) {
    const double *at = places->at[k];
    off = fmax(off, fabs(p[0] + p[1] * at[0] + p[2] * at[1] - values[k]) / prediction->free[k]);
  }
  *value = fmin(fmax(p[0] + p[1] * x + p[2] * y, low), high);
  return off;
}
