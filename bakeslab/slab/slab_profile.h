/* slab_profile.h - where along its axes a slab has light, and whether that ends there. */
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

/* The part of an axis's brightest sample that the last one at its low (0) or high (1) end
 * has, where that is so bright that light must be cut off there; else 0. Light that fades
 * out leaves the ends of the st window dark: more than 2 % is too much. The uv rectangle
 * usually ends where the lamp's opening does, so only 50 % says that this may go on. A
 * 1-wide axis says nothing. */
double slab_profile_cut_off(const struct slab_profile *profile, int axis, int end);
double slab_profile_limit(int axis);

#endif
