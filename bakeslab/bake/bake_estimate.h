/* bake_estimate.h - what a bake is going to be, before it begins: samples, rays, time, memory and
 * size of the file. */
#ifndef BAKE_ESTIMATE_H
#define BAKE_ESTIMATE_H

#include "batch/bake_run.h"

enum { BAKE_ESTIMATE_LINE = 400 };

struct bake_estimate {
  double samples, rays;
  double seconds;       /* to wait for the slab, if the machine does nothing else */
  double memory, bytes; /* of all processes at once; of the file */
};

/* For the work's pages. */
enum result bake_estimate(const struct bake_work *work, struct bake_estimate *estimate,
                          struct bake_report *report, struct error *error);

/* In words; `why` tells how the samples were chosen. */
void bake_estimate_say(const struct bake_work *work, const struct bake_estimate *estimate,
                       const char *why, char line[BAKE_ESTIMATE_LINE]);

#endif
