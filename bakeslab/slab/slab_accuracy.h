/* slab_accuracy.h - the slab's own error: what its finite resolution and the noise of its
 * samples do to the irradiance of what it lights, whatever method sums it.
 *
 * Told from the slab alone. It is halved (means over 2 x 2 cells of s and t, or of u and
 * v) once and twice. With E1 the irradiance by the slab itself, E2 and E4 by the halved
 * ones, r = |E4 - E2| / |E2 - E1| says how fast errors fall with resolution: 4 times a
 * halving where the light is smooth in cells, 2 and less at edges. The error left in E1
 * is then about (E2 - E1) / (r - 1). */
#ifndef SLAB_ACCURACY_H
#define SLAB_ACCURACY_H

#include "slab/slab.h"

/* Relative RMS over a patch that faces the aperture and holds all of the light: the RMS of
 * the error of irradiance (luminance) over the RMS of irradiance. NAN: not known. */
struct slab_accuracy {
  double distance; /* from the aperture, along the normal, in lamp units */
  double st, uv;   /* by resolution; NAN where no axis has 4 samples */
  double noise;    /* by the noise that the bake recorded; NAN where it did not */
  double all;      /* together, of what is known; NAN: nothing is */
};

/* The distances that `bakeslab check --error` states, in apertures: longer edges of the
 * slab's rectangle. */
enum { SLAB_ACCURACY_DISTANCES = 3 };
extern const double slab_accuracy_apertures[SLAB_ACCURACY_DISTANCES];
double slab_aperture(const struct slab *slab);

/* How a slab's samples were taken: slab_json_sampling. */
struct slab_sampling {
  bool points;                     /* rather than means over their cells */
  bool sharpened;                  /* slab_sharpen.h */
  double sample_noise, flux_noise; /* as the bake recorded them (bake_sum.h); NAN: not known */
};

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
