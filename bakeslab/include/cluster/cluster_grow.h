/* cluster_grow.h - more lights, where most is left to explain. */
#ifndef CLUSTER_GROW_H
#define CLUSTER_GROW_H

#include "include/cluster/cluster_target.h"

/* Adds those candidates that explain most of what the lights leave of the target, until there
 * are `wanted`, for which `lights` has room, or none explains anything. */
enum result cluster_grow(const struct cluster_target *target,
                         const struct cluster_light *candidates, int candidate_count,
                         struct cluster_light *lights, int *count, int wanted, struct error *error);

#endif
