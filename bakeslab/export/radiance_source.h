/* radiance_source.h - how Radiance adds up the light of an aperture, and what that errs.
 *
 * A light polygon is a source. With -dj 0 its light is that of the middles of its parts: it is
 * halved across its longer edge until that is below -ds times the distance, into 64 parts at
 * most (Radiance, rt/srcsamp.c: flatpart, MAXSPART). More polygons, more parts. */
#ifndef RADIANCE_SOURCE_H
#define RADIANCE_SOURCE_H

#include "slab/slab.h"

/* The -ds that is recommended to users, and the distance, in aperture widths (longer edges), at
 * which the number of polygons is chosen. */
extern const double radiance_source_ds;
enum { RADIANCE_SOURCE_MOST = 16 }; /* polygons along an edge */

/* Relative RMS error of irradiance on a plane so many aperture widths away. */
double radiance_source_error(const struct slab *slab, const int polygons[2], double widths);

/* The fewest polygons, along u and v, whose error one aperture width away is the tolerance or
 * less; RADIANCE_SOURCE_MOST along the longer edge where none is. Returns the error. */
double radiance_source_choose(const struct slab *slab, double tolerance, int polygons[2]);

#endif
