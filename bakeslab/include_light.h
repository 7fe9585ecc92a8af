/* include_light.h - what every kind of include asks of a slab's radiance. */
#ifndef INCLUDE_LIGHT_H
#define INCLUDE_LIGHT_H

#include "slab.h"

/* Largest value of any channel; 0 for a page without light. */
double include_peak(const struct slab *slab);

/* No light of POV-Ray's that an include uses can take light away: refuses negative
 * radiance. `page` counts from 0. */
enum slab_result include_check_radiance(const struct slab *slab, int page,
                                        struct slab_error *error);

/* Refuses a lamp of which all pages are black. */
enum slab_result include_no_light(struct slab_error *error);

#endif
