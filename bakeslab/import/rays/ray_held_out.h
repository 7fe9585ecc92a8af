/* ray_held_out.h - what rays that were held out show of the error of an estimate by the others. */
#ifndef RAY_HELD_OUT_H
#define RAY_HELD_OUT_H

#include "import/rays/ray_bins.h"

/* Integrals of squared luminance over the etendue. */
struct ray_held_out {
  double
      least; /* of the error: it is more, but for a chance of one in a thousand; 0: nothing shows */
  double likely; /* of the error, as far as that grid shows it; NAN: nothing shows */
};

/* Of the estimate by ray_partition. `etendue`: of each cell. */
enum result ray_held_out(const struct ray_bins *bins, const double *etendue,
                         struct ray_held_out *held_out, struct error *error);

#endif
