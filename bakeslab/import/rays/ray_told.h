/* ray_told.h - what is told of samples that were estimated by rays.
 *
 * Errors are of luminance, as the root of the integral of their square over the etendue, and
 * relative to that of luminance. */
#ifndef RAY_TOLD_H
#define RAY_TOLD_H

#include "slab/slab.h"

struct ray_estimate_told {
  unsigned long long rays; /* that were added */
  double flux[3];          /* of them; slab_flux_metric of the samples is the same to 1e-6 */
  int samples[SLAB_AXES];  /* of the slab */
  double noise;            /* error of the samples as means over their cells: by the number of rays,
                              and by averaging over cells that are not alike; raised where rays that
                              were held out show more */
  double held_out;   /* what of that rays held out show, of samples by three rays in four; NAN: it
                        is hidden in their own noise */
  double irradiance; /* error of irradiance, by noise and by interpolating means over cells, the RMS
                        over the RMS of irradiance, where it is largest from RAY_ESTIMATE_APERTURES
                        on (slab_accuracy.h); 0 without a tolerance */
  double bins;       /* noise of plain bins, the mean of each cell's own rays, for comparison */
  double square;     /* integral of the squared luminance over the etendue, to weight pages by */
  double flux_noise; /* standard error of the flux, relative: by which rays leave here, and which
                        elsewhere */
  double sample_noise; /* RMS error of the samples' luminance, each counting alike, in the unit of
                          radiance: as noise that is independent between them and does the same to
                          sums over the views, which is what slab_sampling.h hands on */
};

#endif
