/* slab_profile.h - the mean radiance along each axis of a slab, and whether its borders cut light
 * off. */
#ifndef SLAB_PROFILE_H
#define SLAB_PROFILE_H

#include "slab/slab.h"

/* axis[a][k] is the mean of |L| (sum of the channels) over all samples with index k along
 * axis a. Free it with slab_profile_free in any case. */
struct slab_profile {
  int samples[SLAB_AXES];
  double *axis[SLAB_AXES];
};

enum result slab_profile(const struct slab *slab, struct slab_profile *profile,
                         struct error *error);
void slab_profile_free(struct slab_profile *profile);

/* The last sample at the low (0) or high (1) end of an axis, relative to the axis's brightest, if
 * that is above the limit, so that light must be cut off there; else 0. The limit is 2 % for s and
 * t, since light fades out towards the ends of the window, and 50 % for u and v, since the uv
 * rectangle usually ends where the lamp's opening does. 0 for an axis of one sample. */
double slab_profile_cut_off(const struct slab_profile *profile, int axis, int end);
double slab_profile_limit(int axis);

#endif
