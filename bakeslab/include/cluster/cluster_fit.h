/* cluster_fit.h - all numbers of some lights, fitted to a target. */
#ifndef CLUSTER_FIT_H
#define CLUSTER_FIT_H

#include "include/cluster/cluster_target.h"

/* Keeps a light on the aperture, and its lobe such that the receivers see it. */
void cluster_limit(const struct cluster_target *target, struct cluster_light *light);

/* Refines the lights, drops those that are dark then, and makes their flux that of the target
 * in each channel. Their rgb are in the target's unit. */
enum result cluster_fit(const struct cluster_target *target, struct cluster_light *lights,
                        int *count, struct error *error);

#endif
