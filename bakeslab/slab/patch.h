/* patch.h - irradiance on a patch of receivers that face the aperture, by the luminance of a
 * slab's samples at any resolution.
 *
 * The receivers are a grid of PATCH_SIDE x PATCH_SIDE at the distance z from the aperture, over
 * the part of that plane that the light reaches. The ray from the point (a, b) of the aperture to
 * the receiver (x, y) has the slopes (x - a)/z and (y - b)/z: of the sixteen corners of its
 * interpolation, u and s depend on x alone, v and t on y alone. Rows of the raster are combined
 * once for all receivers with the same y. */
#ifndef PATCH_H
#define PATCH_H

#include "slab/slab.h"

/* Receivers along a side: a prime, and they are moved off their grid, so that they are not all at
 * the same places between samples. */
enum { PATCH_SIDE = 37, PATCH_RECEIVERS = PATCH_SIDE * PATCH_SIDE };

/* A slab's luminance; NULL: there is none. */
struct patch_light {
  int samples[SLAB_AXES];
  float *luminance; /* a raster as a slab's; owned */
};

enum result patch_light_make(const struct slab *slab, struct patch_light *light,
                             struct error *error);

/* The part of each axis (a, b, s, t) that is not black, by the mean of |L| cos^4 over the other
 * axes: above 1/1000 of the axis's peak. */
struct patch_extent {
  double low[SLAB_AXES], high[SLAB_AXES];
};

/* `light` is the slab's own. */
enum result patch_extent_find(const struct slab *slab, const struct patch_light *light,
                              struct patch_extent *extent, struct error *error);

struct patch {
  const struct slab *slab; /* geometry; not owned */
  double distance;
  double at[2][PATCH_SIDE];  /* receivers along u and v, in lamp units */
  int points[2];             /* of the sum over the aperture, along u and v */
  struct patch_tap *taps[2]; /* owned */
  float *row;                /* owned */
};

/* Free it with patch_free in any case. */
enum result patch_make(const struct slab *slab, double distance, const struct patch_extent *extent,
                       struct patch *patch, struct error *error);
void patch_free(struct patch *patch);

/* Irradiance by a light of the slab's frame at all receivers, rows of u, but for the factor
 * area / z^2: the mean of L cos^4 over the aperture. */
void patch_irradiance(const struct patch *patch, const struct patch_light *light,
                      double e[PATCH_RECEIVERS]);

#endif
