/* cluster_seed.h - candidates for lights, from the slab's samples alone. */
#ifndef CLUSTER_SEED_H
#define CLUSTER_SEED_H

#include "include/cluster/cluster_light.h"
#include "slab/slab.h"

/* Groups of the slab's cells, many and few, with lobes narrower and wider; their rgb is
 * nothing. `distance` in aperture widths. `candidates` is owned by the caller, also after a
 * failure. */
enum result cluster_seed(const struct slab *slab, double distance,
                         struct cluster_light **candidates, int *count, struct error *error);

/* Points along the lights' edges: close enough for soft shadows, and at most so many in
 * all, but one for each light. */
void cluster_set_sizes(struct cluster_light *lights, int count, int most);

#endif
