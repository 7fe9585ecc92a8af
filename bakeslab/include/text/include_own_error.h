/* include_own_error.h - what an include's header tells of the slab's own error, beside that of
 * its lights, and of both together. */
#ifndef INCLUDE_OWN_ERROR_H
#define INCLUDE_OWN_ERROR_H

#include "slab/slab_accuracy.h"

/* The error by an include's lights alone, at slab_accuracy_apertures: relative RMSE of irradiance;
 * INFINITY: not known. `page` counts those with light. */
typedef void include_lights_error(const void *of, int page, double error[SLAB_ACCURACY_DISTANCES]);

/* Comment lines for each page with light, without the last line end, numbered as the header
 * numbers them: slab_accuracy_table's errors, their parts, and all with the lights'. Free with
 * free. */
enum result include_own_error(const struct slab *slabs, int count, include_lights_error *lights,
                              const void *of, char **text, struct error *error);

#endif
