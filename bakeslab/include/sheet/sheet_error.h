/* sheet_error.h - what a sum over few lights gets wrong.
 *
 * Compares the irradiance on planes parallel to the aperture: the sum over a
 * level's lights against the integral of the quadrilinear slab. The number of
 * receivers follows from a bound on the work, about a second for a page. */
#ifndef SHEET_ERROR_H
#define SHEET_ERROR_H

#include "include/sheet/sheet_level.h"

/* Sets `error[]` of each level: root of the mean squared error over the plane,
 * relative to the root of the mean squared irradiance. INFINITY where the sheet stands
 * behind the plane. */
enum result sheet_measure(const struct slab *slab, struct sheet_level *levels, int count,
                          struct error *error);

/* The same at one distance, in aperture widths; `errors` has room for one more
 * than the levels. */
void sheet_measure_at(const struct slab *slab, const struct sheet_level *levels, int count,
                      double distance, double *errors);

#endif
