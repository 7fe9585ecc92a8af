/* oracle.h - the irradiance that a light slab gives to a receiver, from the
 * text of light-slab(5) alone: it shares no code with what it checks.
 *
 *   E = int over the aperture of L(P to Q) max(0, N.omega) (n.omega) / R^2 dA
 *
 * for a receiver at Q with normal N, unoccluded, in lamp space and lamp units.
 * With the slopes x = (a - qx)/z, y = (b - qy)/z from the receiver's foot
 * (qx, qy) and height z, this is free of scale:
 *
 *   E = int int L (Nx x + Ny y - Nz)+ / (1 + x^2 + y^2)^2 dx dy
 *
 * and along an axis s = kappa qx - (1 - kappa z) x. All lines of both grids,
 * and what is visible between them, are exact rationals (exact.h); the
 * integral over each piece is Gauss-Legendre in long double (irradiance.c). */
#ifndef ORACLE_H
#define ORACLE_H

#include <math.h>

#include "oracle/exact.h"
#include "slab/slab.h"

struct oracle_value {
  long double e[3];
  long double magnitude[3]; /* the integral of |L| */
  long double error;        /* estimated, the largest of the channels; relative to magnitude */
};

/* Irradiance at p with normal n (any length but 0). 0 behind the uv plane. */
struct oracle_value oracle_irradiance(const struct slab *slab, const double p[3],
                                      const double n[3]);

/* The same for radiance 1 everywhere, by Lambert's polygon formula. z > 0. */
long double oracle_lambert(const struct slab *slab, const double p[3], const double n[3]);

/* The same by the midpoint sum over count x count points of the aperture, each
 * ray looked up by itself: coarse. z > 0. With `eye` not NULL, the highlight instead that is seen
 * along it: the integral of L (N.H)^shininess over the solid angle. */
void oracle_brute(const struct slab *slab, const double p[3], const double n[3],
                  const double eye[3], double shininess, int count, double rgb[3]);

/* A receiver in the slab's own frame u', v', normal, from its centre; and the slab there. */
struct oracle_place {
  long double p[3], n[3]; /* n: unit */
  long double half[2];    /* of the aperture's edges */
  long double kappa;      /* 1/D */
};
void oracle_place(const struct slab *slab, const double p[3], const double n[3],
                  struct oracle_place *place);

/* What projective textures sum: the light of view i, j, all of it in the middle of its cell, where
 * the ray's direction is looked up. With `error` not NULL, what roundings to single precision
 * can change: of the receiver, the view's place and the direction, 2^-22 of each. */
void oracle_view(const struct slab *slab, const struct oracle_place *place, int i, int j,
                 long double rgb[3], long double error[3]);

/* NaN where x or y is, unlike fmaxl: the largest of some errors then fails every comparison. */
static inline long double oracle_larger(long double x, long double y) {
  return x > y || isnan(x) ? x : y;
}

#endif
