/* include_light.h - what every kind of include asks of a slab's radiance. */
#ifndef INCLUDE_LIGHT_H
#define INCLUDE_LIGHT_H

#include "slab/slab.h"

/* Largest value of any channel; 0 for a page without light. */
double include_peak(const struct slab *slab);

/* No light of POV-Ray's that an include uses can take light away: refuses negative
 * radiance. `page` counts from 0. */
enum result include_check_radiance(const struct slab *slab, int page, struct error *error);

/* Refuses a lamp of which all pages are black. */
enum result include_no_light(struct error *error);

#endif
