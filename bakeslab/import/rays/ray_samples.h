/* ray_samples.h - from sums of rays on a grid to the samples of a slab on that grid. */
#ifndef RAY_SAMPLES_H
#define RAY_SAMPLES_H

#include "import/rays/ray_bins.h"
#include "import/rays/ray_told.h"

/* Fills a new slab, which the caller frees, and all of `told` but irradiance. `whole`:
 * luminous flux of all rays of the source. */
enum result ray_samples(const struct ray_bins *bins, double whole, struct slab *slab,
                        struct ray_estimate_told *told, struct error *error);

#endif
