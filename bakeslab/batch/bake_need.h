/* bake_need.h - when a bake has shot enough: how much of their noise the samples may keep. */
#ifndef BAKE_NEED_H
#define BAKE_NEED_H

#include "batch/bake_run.h"

/* The distance at which errors of irradiance are asked for, in lamp units: --for-distance, or four
 * apertures of the page. */
double bake_need_distance(const struct bake_options *options, const struct slab *page);

/* The part of the variance of the samples that may stay: what changes irradiance by no more than
 * options->noise, or, where that is 0, by little beside what the resolution does, as the samples by
 * now show both. 0 where there is no limit, or nothing to tell it by. */
enum result bake_need(const struct bake_work *work, const struct bake_sum *sum, double *part,
                      struct error *error);

#endif
