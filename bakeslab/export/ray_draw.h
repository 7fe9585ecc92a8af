/* ray_draw.h - rays drawn from the light of a lamp, each with its share of the flux.
 *
 * 1. A sample is drawn by its luminance: the places k of a golden sequence (frac(shift + k phi)) in
 *    the running sum, so that the first rays of any number are spread over all of the light.
 * 2. A ray is drawn from what the sample adds to quadrilinear radiance: a hat along each axis,
 *    half of it flat at the ends.
 * 3. Its flux is proportional to the cosine and solid angle per slopes, (1 + p^2 + q^2)^-2 with p
 *    and q the slopes against the normal; all together give the flux of the slab. */
#ifndef RAY_DRAW_H
#define RAY_DRAW_H

#include <stdint.h>

#include "slab/slab.h"

struct ray_draw; /* owned by whoever opened it; refers to the slabs */

/* Refuses negative light and a lamp without light. */
enum result ray_draw_open(const struct slab *slabs, int count, uint64_t rays, uint64_t seed,
                          struct ray_draw **draw, struct error *error);
void ray_draw_close(struct ray_draw *draw); /* NULL allowed */

/* Flux of all rays: luminance's, with lengths in metres. */
double ray_draw_flux(const struct ray_draw *draw);

/* Ray k, from 0: a point of the aperture in metres, a unit direction, its flux. Any order gives
 * the same rays. */
void ray_draw_ray(const struct ray_draw *draw, uint64_t k, double ray[7]);

#endif
