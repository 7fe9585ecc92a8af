/* slab_accuracy.h - the slab's own error: what its finite resolution and the noise of its
 * samples do to the irradiance of what it lights, whatever method sums it. Estimated from the
 * slab alone, by Richardson extrapolation from coarser copies of it (slab_accuracy.c). */
#ifndef SLAB_ACCURACY_H
#define SLAB_ACCURACY_H

#include "slab/slab_sampling.h"

/* Relative RMS over a patch that faces the aperture and holds all of the light: the RMS of
 * the error of irradiance (luminance) over the RMS of irradiance. NAN: not known. */
struct slab_accuracy {
  double distance;   /* from the aperture, along the normal, in lamp units */
  double st, uv;     /* by resolution; NAN where no axis has 4 samples */
  double resolution; /* st and uv together; they may cancel. NAN where neither is known */
  double noise;      /* by the noise that the bake recorded; NAN where it did not */
  double logluv;     /* by rounding to LogLuv; 0 where the file has none */
  double all;        /* resolution, noise and logluv together, of what is known; NAN: neither of the
                        first two is */
};

/* The distances that `bakeslab check --error` states, in apertures: longer edges of the
 * slab's rectangle (plane_width). */
enum { SLAB_ACCURACY_DISTANCES = 3 };
extern const double slab_accuracy_apertures[SLAB_ACCURACY_DISTANCES];

/* How much an error by resolution grows by a halving, as observed from the steps from the slab to
 * half its samples and from there to a quarter, within bounds. `st`: along s and t, else u and v.
 */
double slab_accuracy_ratio(bool st, bool sharpened, double once, double twice);

/* Fills accuracy[count] for the given distances, in lamp units. A slab without light, or
 * whose light goes by all of a patch, has the error 0. */
enum result slab_accuracy_estimate(const struct slab *slab, const struct slab_sampling *sampling,
                                   int count, const double *distances,
                                   struct slab_accuracy *accuracy, struct error *error);

/* The same at slab_accuracy_apertures. */
enum result slab_accuracy_table(const struct slab *slab, const struct slab_sampling *sampling,
                                struct slab_accuracy accuracy[SLAB_ACCURACY_DISTANCES],
                                struct error *error);

#endif
