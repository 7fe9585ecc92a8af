/* probe_bake.h - a small bake, which tells something of the large one to come. Its batch is
 * kept like all others: the same take again costs nothing. */
#ifndef PROBE_BAKE_H
#define PROBE_BAKE_H

#include "batch/bake_run.h"

struct probe_bake {
  struct slab *pages; /* owned */
  int count;
  double traced; /* as in bake_report */
  int depth;
};

/* Bakes slabs[work->lamp->slab_count] with `samples` of `rays` each, whatever theirs are.
 * Free the take with probe_bake_free in any case. */
enum result probe_bake(const struct bake_work *work, const struct slab *slabs,
                       const struct effects *effects, const int samples[SLAB_AXES], int rays,
                       struct probe_bake *take, struct bake_report *report, struct error *error);
void probe_bake_free(struct probe_bake *take);

#endif
