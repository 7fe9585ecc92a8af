/* kernel.h - the weight of radiance in a receiver's irradiance, or in its highlight, by direction,
 * in the frame of a page.
 *
 * With x and y the slopes from the receiver to a point of the aperture (strips.h), the
 * direction to it is (x, y, -1)/r, r^2 = 1 + x^2 + y^2, the solid angle dx dy/r^3, and
 *     irradiance: g/r^4 dx dy with g = n_x x + n_y y - n_z (n the receiver's normal),
 *     gloss: (N.H)^shininess/r^3 dx dy (scene.h),
 * both where g > 0, above the receiver's tangent plane. */
#ifndef KERNEL_H
#define KERNEL_H

#include <stdbool.h>

struct kernel {
  double normal[3]; /* unit */
  double eye[3];    /* unit */
  double shininess; /* 0: matte */
};

/* g at a slope. */
double kernel_height(const struct kernel *kernel, double x, double y);

/* The range of g over a rectangle of slopes. */
void kernel_heights(const struct kernel *kernel, const double low[2], const double high[2],
                    double range[2]);

/* A highlight is about exp(-m x^2/8) for the exponent m. It has no poles, but Gauss rules need
 * as many nodes for it as for a function with poles at this distance; INFINITY for matte. */
double kernel_pole(const struct kernel *kernel);

/* Irradiance kernel at (x[k], y); not clamped at the tangent plane. `x` and `out` have room
 * for a multiple of SIMD_LANES. */
void kernel_matte(const struct kernel *kernel, const double *x, double y, int count, double *out);

/* Gloss kernel, 0 below the tangent plane. */
void kernel_gloss(const struct kernel *kernel, const double *x, double y, int count, double *out);

#endif
