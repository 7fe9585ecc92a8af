/* ray_etendue.h - the etendue of a slab's cells: area times projected solid angle, the flux of a
 * cell at radiance 1.
 *
 * With x = s - kappa a and y = t - kappa b it is the integral of da db ds dt / (1 + x^2 + y^2)^2
 * (slab_flux.c), in squared metres times steradians, with a relative error below 1e-9. */
#ifndef RAY_ETENDUE_H
#define RAY_ETENDUE_H

#include "slab/slab.h"

/* One number a cell, in the order of slab->rgb's pixels. The caller frees it; NULL without
 * memory. */
double *ray_etendue(const struct slab *slab);

#endif
