/* slab_variant.h - copies of a slab that err as the slab itself may: what a sum over one of them
 * differs by tells what the slab's own error does to that sum (slab_accuracy.h; renderslab's
 * picture/image_error.h). */
#ifndef SLAB_VARIANT_H
#define SLAB_VARIANT_H

#include "slab/slab_sampling.h"

enum slab_variant {
  SLAB_ST_2,  /* s and t with half the samples */
  SLAB_ST_4,  /* a quarter */
  SLAB_UV_2,  /* u and v likewise */
  SLAB_UV_4,  /*  */
  SLAB_NOISY, /* the samples' recorded noise once more, without what they all share (flux_noise) */
  SLAB_ROUNDED, /* rounded to LogLuv once more */
  SLAB_VARIANTS
};

/* Makes the copy, which slab_free frees; its rgb is NULL where there is none: too few samples to
 * halve, no recorded noise, a slab that was never LogLuv. Halved samples are means over the cells
 * that they cover (slab_resample.h); a sharpened slab is made means again before, and sharpened
 * after. Noise and rounding have signs that look random, but are always the same. */
enum result slab_variant_make(const struct slab *slab, const struct slab_sampling *sampling,
                              enum slab_variant which, struct slab *copy, struct error *error);

#endif
