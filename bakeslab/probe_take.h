/* probe_take.h - a small bake, which tells something of the large one to come. Its batch is
 * kept like all others: the same take again costs nothing. */
#ifndef PROBE_TAKE_H
#define PROBE_TAKE_H

#include "bake_run.h"

struct probe_take {
  struct slab *pages; /* owned */
  int count;
  double traced; /* as in bake_report */
  int depth;
};

/* Bakes slabs[work->lamp->slab_count] with `samples` of `rays` each, whatever theirs are.
 * Free the take with probe_take_free in any case. */
enum slab_result probe_take(const struct bake_work *work, const struct slab *slabs,
                            const struct effects *effects, const int samples[SLAB_AXES], int rays,
                            struct probe_take *take, struct bake_report *report,
                            struct slab_error *error);
void probe_take_free(struct probe_take *take);

#endif
