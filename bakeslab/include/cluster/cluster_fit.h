/* cluster_fit.h - all numbers of some lights, fitted to a target. */
#ifndef CLUSTER_FIT_H
#define CLUSTER_FIT_H

#include "base/progress.h"
#include "include/cluster/cluster_target.h"

/* What the fit has done and may do, in points of lights that were evaluated at receivers, some 30
 * ns each; what else it does is counted as so many of them. */
struct cluster_work {
  double done, most;         /* INFINITY: no bound */
  struct progress *progress; /* or NULL */
  double begun, part;        /* of what it shows: where this work begins, and its share */
};

/* Counts more work, and shows it where there is a bound. */
void cluster_work_add(struct cluster_work *work, double more);

/* Keeps a light on the aperture, and its lobe such that the receivers see it. */
void cluster_limit(const struct cluster_target *target, struct cluster_light *light);

/* Refines the lights, as long as there is work left, drops those that are dark then, and makes
 * their flux that of the target in each channel. Their rgb are in the target's unit. */
enum result cluster_fit(const struct cluster_target *target, struct cluster_light *lights,
                        int *count, struct cluster_work *work, struct error *error);

#endif
