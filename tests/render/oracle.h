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
 * and what is visible between them, are exact rationals (oracle_axis.c); the
 * integral over each piece is Gauss-Legendre in long double (oracle.c). */
#ifndef ORACLE_H
#define ORACLE_H

#include "slab/slab.h"

enum { ORACLE_PIECES = 256 }; /* along an axis; more aborts */

/* Where neither grid has a line inside: everything is linear in x. Sample
 * `uv[0] + f`, f going from uv_at[0] to uv_at[1]; the same for st. */
struct oracle_piece {
  long double x, width;
  int uv[2], st[2];
  long double uv_at[2], st_at[2];
};

struct oracle_axis {
  int count; /* 0 where nothing is visible */
  struct oracle_piece piece[ORACLE_PIECES];
};

struct oracle_value {
  long double e[3];
  long double magnitude[3]; /* the integral of |L| */
  long double error;        /* estimated, the largest of the channels; relative to magnitude */
};

/* The visible part along u (`which` 0) or v (1), for a receiver at height
 * z >= 0. z = 0 is the limit from above: the rectangle is then all slopes where
 * the foot is inside, half of them on its border. Aborts unless the lengths
 * of the pieces add up exactly. */
void oracle_axis(const struct slab *slab, const double p[3], int which, struct oracle_axis *axis);

/* Irradiance at p with normal n (any length but 0). 0 behind the uv plane. */
struct oracle_value oracle_irradiance(const struct slab *slab, const double p[3],
                                      const double n[3]);

/* The same for radiance 1 everywhere, by Lambert's polygon formula. z > 0. */
long double oracle_lambert(const struct slab *slab, const double p[3], const double n[3]);

/* The same by the midpoint sum over count x count points of the aperture, each
 * ray looked up by itself: coarse. z > 0. */
void oracle_brute(const struct slab *slab, const double p[3], const double n[3], int count,
                  double rgb[3]);

/* A receiver in the slab's own frame, from its centre. */
struct oracle_place {
  long double p[3], n[3]; /* n: unit */
};
void oracle_place(const struct slab *slab, const double p[3], const double n[3],
                  struct oracle_place *place);

/* What projective textures sum: the light of view i, j, all of it in the middle of its cell, where
 * the ray's direction is looked up. With `error` not NULL, what roundings to single precision
 * can change: of the receiver, the view's place and the direction, 2^-22 of each. */
void oracle_view(const struct slab *slab, const struct oracle_place *place, int i, int j,
                 long double rgb[3], long double error[3]);

/* Unit vectors u', v', normal: rows of lamp space to the slab's own frame. */
void oracle_frame(const struct slab *slab, long double frame[3][3]);

#endif
