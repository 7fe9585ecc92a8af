/* slab_sharpen.h - lowers the blur of interpolating cell means.
 *
 * A bake's samples are means over their cells. Interpolated, they are blurred once more:
 * along an axis the mean of the interpolated radiance over cell k is
 *     (L[k-1] + 6 L[k] + L[k+1]) / 8,   (7 L[0] + L[1]) / 8 at the borders,
 * because half a cell is linear on either side of the centre and constant at a border.
 * Sharpening along s and t solves this for L, so that the interpolated radiance of each
 * view has the means that the bake measured. The columns of the system sum to 1: the
 * sum of a view's samples, which is its radiance integrated over ds dt, stays as it is. */
#ifndef SLAB_SHARPEN_H
#define SLAB_SHARPEN_H

#include "slab/slab.h"

enum slab_sharpening {
  SLAB_SHARPEN_EXACT,   /* keeps all cell means; samples beside edges may be negative */
  SLAB_SHARPEN_POSITIVE /* keeps the sums of views; no sample becomes negative */
};

/* Sharpens along s and t. POSITIVE limits what a sample gives to its neighbours in the
 * view, by flux-corrected transport (Zalesak 1979), to what it has: light moves between
 * neighbours only, and cells that are not beside black ones keep their means. All channels
 * are limited alike, so that colours stay. */
enum result slab_sharpen(struct slab *slab, enum slab_sharpening how, struct error *error);

/* The inverse of SLAB_SHARPEN_EXACT: each sample becomes the mean of the interpolated
 * radiance over its cell of s and t. */
enum result slab_unsharpen(struct slab *slab, struct error *error);

/* The same on one line of `count` numbers, a `stride` apart, in place; `scratch` has room
 * for 2 count numbers. */
void slab_sharpen_line(double *line, int count, size_t stride, double *scratch);
void slab_unsharpen_line(double *line, int count, size_t stride);

#endif
