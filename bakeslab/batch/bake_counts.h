/* bake_counts.h - what POV-Ray's logs say of finished batches. */
#ifndef BAKE_COUNTS_H
#define BAKE_COUNTS_H

#include "batch/bake_options.h"
#include "batch/bake_plan.h"
#include "lamp/lamp.h"

struct bake_counts {
  const struct effects *effects; /* these three, not owned, are set beforehand */
  const struct lamp *lamp;
  const struct slab *slabs;
  double traced, traced_cpu, depth; /* as in bake_report */
  char photons_lost[48];
};

/* Adds those of a batch of a round, which is in `directory`. */
void bake_counts_add(struct bake_counts *counts, const struct bake_round *round, size_t batch,
                     const char *directory);
void bake_counts_report(const struct bake_counts *counts, struct bake_report *report);

#endif
