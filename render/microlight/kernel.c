#include "microlight/kernel.h"

#include <math.h>
#include <string.h>

#include "base/simd.h"

double kernel_height(const struct kernel *kernel, double x, double y) {
  return kernel->normal[0] * x + kernel->normal[1] * y - kernel->normal[2];
}

void kernel_heights(const struct kernel *kernel, const double low[2], const double high[2],
                    double range[2]) {
  const double *n = kernel->normal;
  range[0] = n[0] * (n[0] > 0 ? low[0] : high[0]) + n[1] * (n[1] > 0 ? low[1] : high[1]) - n[2];
  range[1] = n[0] * (n[0] > 0 ? high[0] : low[0]) + n[1] * (n[1] > 0 ? high[1] : low[1]) - n[2];
}

double kernel_pole(const struct kernel *kernel) {
  return kernel->shininess > 0 ? 6 / sqrt(kernel->shininess) : INFINITY;
}

SIMD_INLINE void kernel_matte_body(const struct kernel *kernel, const double *x, double y,
                                   int count, double *out) {
  const double along = kernel->normal[0], rest = kernel->normal[1] * y - kernel->normal[2];
  const double square = 1 + y * y;
  for (int k = 0; k < count; k += 4) {
    simd_double4 slope = SIMD_LOAD(simd_doubles4, x + k), value = slope * slope + square;
    value = (slope * along + rest) / (value * value);
    memcpy(out + k, &value, sizeof value);
  }
}

SIMD_DISPATCH(kernel_matte,
              (const struct kernel *kernel, const double *x, double y, int count, double *out),
              (kernel, x, y, count, out))

void kernel_gloss(const struct kernel *kernel, const double *x, double y, int count, double *out) {
  const double *n = kernel->normal, *eye = kernel->eye;
  for (int k = 0; k < count; ++k) {
    double r = sqrt(1 + x[k] * x[k] + y * y);
    double h[3] = {x[k] / r + eye[0], y / r + eye[1], -1 / r + eye[2]};
    double along = h[0] * n[0] + h[1] * n[1] + h[2] * n[2];
    double length = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    bool lit = kernel_height(kernel, x[k], y) > 0 && along > 0;
    out[k] = lit ? pow(along / length, kernel->shininess) / (r * r * r) : 0;
  }
}
