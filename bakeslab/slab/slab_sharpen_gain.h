/* slab_sharpen_gain.h - whether sharpening a slab makes it better. */
#ifndef SLAB_SHARPEN_GAIN_H
#define SLAB_SHARPEN_GAIN_H

#include "slab/slab_accuracy.h"
#include "slab/slab_sharpen.h"

/* Sharpening pays where the error of irradiance becomes at most so many times what it was. */
extern const double slab_sharpen_pays;

/* The error of irradiance of the sharpened slab over that of this one, whose samples are cell
 * means, as is to be expected from coarser copies: the largest at slab_accuracy_apertures. NAN:
 * not known, since neither s nor t has 4 samples, or there is no light. */
enum result slab_sharpen_gain(const struct slab *means, const struct slab_sampling *sampling,
                              enum slab_sharpening how, double *gain, struct error *error);

#endif
