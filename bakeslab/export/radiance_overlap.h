/* radiance_overlap.h - pages that share an aperture, as those of several groups of bulbs do: their
 * light adds up, but of two polygons in one place Radiance sees only one. */
#ifndef RADIANCE_OVERLAP_H
#define RADIANCE_OVERLAP_H

#include "slab/slab.h"

/* Whether the apertures lie in one plane, face one side, and overlap. */
bool radiance_overlap(const struct slab *a, const struct slab *b);

/* *sum, of two pages that are slab_alike, which has samples or is zero, becomes the sum of a and b;
 * the caller frees it. */
enum result radiance_overlap_add(const struct slab *a, const struct slab *b, struct slab *sum,
                                 struct error *error);

#endif
