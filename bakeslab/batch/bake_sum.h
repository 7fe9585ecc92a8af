/* bake_sum.h - sums the passes of a bake into samples and estimates their noise.
 *
 * POV-Ray's pixels are half floats: sums of them are exact in double precision, so
 * that their order does not matter. Batches must come in order all the same, since sums
 * of squares are rounded. Noise is estimated from the variance of the pairs' means as if
 * their offsets were random. They fill the cell more evenly than that, so the estimate is
 * rather too high; from the two pairs of four rays it is a rough one. That of the flux is the
 * lesser of this and of what neighbouring views differ by. */
#ifndef BAKE_SUM_H
#define BAKE_SUM_H

#include "batch/bake_plan.h"

struct bake_sum;

enum result bake_sum_new(const struct bake_tiles *tiles, int most_passes, struct bake_sum **sum,
                         struct error *error);
void bake_sum_free(struct bake_sum *sum);

/* Adds the rays of a round's batch: 3 floats a ray, unit by unit. */
void bake_sum_add(struct bake_sum *sum, const struct bake_round *round,
                  const struct bake_batch *batch, const float *rgb);

/* Standard deviation of what a pair adds to the flux by a sample (luminance, RMS over the tile's),
 * by tile. */
enum result bake_sum_deviation(const struct bake_sum *sum, double *deviation, struct error *error);

/* Whether a ray of a sample, in the raster's order, met light, that of the search too. */
bool bake_sum_is_lit(const struct bake_sum *sum, int page, size_t sample);

/* The luminous flux of a sample by its rays so far, up to a factor. */
double bake_sum_light(const struct bake_sum *sum, int page, size_t sample);

struct bake_noise {
  bool known;    /* `sample` is: it needs two pairs */
  double sample; /* RMS standard error of the samples' luminance */
  double mean;   /* mean luminance of all samples, to relate it to */
  double flux;   /* standard error of the flux, relative; NAN: not known */
  double rays;   /* mean number of rays a sample */
};

/* The samples: sums divided by their passes and by the gain. Fills each page's rgb. */
enum result bake_sum_finish(const struct bake_sum *sum, double gain, struct slab *pages,
                            struct error *error);
/* `offsets` are those of the passes. */
void bake_sum_noise(const struct bake_sum *sum, double gain, enum bake_offsets offsets,
                    struct bake_noise *noise);

#endif
