/* slab_resample.h - other resolutions and parts of a slab. */
#ifndef SLAB_RESAMPLE_H
#define SLAB_RESAMPLE_H

#include "slab/slab.h"

/* A slab of the same light on `samples` cells: each axis is handled by itself.
 * Fewer samples are means over the new cells, in which an old cell counts by
 * the share that overlaps (any ratio; the mean of all samples is kept). More
 * samples are interpolated at the new centres, as slab_lookup does. The same
 * number is copied. `out` is a new slab, which the caller frees. */
enum result slab_resample(const struct slab *in, const int samples[SLAB_AXES], struct slab *out,
                          struct error *error);

/* The part of a slab with sample indices first[axis] <= index < end[axis]: a
 * smaller rectangle, with its own centre, and a smaller window. Every ray that
 * passes both keeps its place in lamp space. `out` is a new slab. */
enum result slab_crop(const struct slab *in, const int first[SLAB_AXES], const int end[SLAB_AXES],
                      struct slab *out, struct error *error);

#endif
