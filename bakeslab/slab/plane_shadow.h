/* plane_shadow.h - the irradiance of a slab on a plane parallel to the aperture in the shadow of
 * a straight edge half way: a half plane at half the distance, parallel to both, whose edge runs
 * along u or v through the line from the aperture's middle to that of the lit part. Receivers see
 * all of the aperture, a part of it (the penumbra, as wide as the aperture) or nothing.
 * Approximations of the slab are compared with it, since those of few points give steps, and one
 * of one point a hard shadow. */
#ifndef PLANE_SHADOW_H
#define PLANE_SHADOW_H

#include "slab/plane.h"

/* Lengths in lamp units, x along u and y along v. */
struct plane_shadow_receiver {
  double at[3];
  double until[2]; /* of the aperture, it sees what lies below along u and v; INFINITY: all */
  double edge[2];  /* where the edge is along u and v, INFINITY: none along that axis */
  double rgb[3];   /* irradiance */
  double area;     /* of the plane that it stands for */
};

struct plane_shadow {
  int count;
  struct plane_shadow_receiver *receivers; /* owned */
};

/* Both edges' receivers: as many in the penumbra as in all that is lit. Free with
 * plane_shadow_free, also after a failure. */
enum result plane_shadow_make(const struct slab *slab, double distance, struct plane_shadow *shadow,
                              struct error *error);
void plane_shadow_free(struct plane_shadow *shadow);

/* Whether the edge hides a light at (x, y, z) from a receiver. */
bool plane_shadow_hides(const struct plane_shadow_receiver *receiver, const double light[3]);

/* The irradiance that approximation `k` of `of` gives to a receiver past the edge. */
typedef void plane_shadow_approximation(const void *of, int k,
                                        const struct plane_shadow_receiver *receiver,
                                        double rgb[3]);

/* The relative RMSE over both shadows' receivers, by the area that they stand for; 0 without
 * light. */
double plane_shadow_error(const struct plane_shadow *shadow,
                          plane_shadow_approximation *approximation, const void *of, int k);

#endif
