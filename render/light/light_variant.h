/* light_variant.h - lights whose slabs are replaced by copies that err (slab_variant.h), where they
 * stand. */
#ifndef LIGHT_VARIANT_H
#define LIGHT_VARIANT_H

#include "light/light.h"
#include "slab/slab_variant.h"

/* Makes *copies, an array of `count` lights, which light_variant_free frees. A page of which there
 * is no such copy keeps its samples; *lack is set to the number of such pages that have light. */
enum result light_variant_make(const struct light *lights, int count, enum slab_variant which,
                               struct light **copies, int *lack, struct error *error);
void light_variant_free(struct light *copies, int count); /* NULL allowed */

#endif
