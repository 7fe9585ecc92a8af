/* probe_bake.h - a small bake, by which the full one is planned. Its batches are kept
 * like all others: the same small bake again costs nothing. */
#ifndef PROBE_BAKE_H
#define PROBE_BAKE_H

#include "batch/bake_run.h"

struct probe_bake {
  struct slab *pages; /* owned */
  int count;
  double cpu;    /* seconds of POV-Ray; of batches that were found, by its own count */
  double traced; /* these three as in bake_report */
  int depth;
  char photons_lost[48];
};

/* Bakes slabs[work->lamp->slab_count] with `samples` (NULL: as many as they say) of `rays` each.
 * Free it with probe_bake_free in any case. */
enum result probe_bake(const struct bake_work *work, const struct slab *slabs,
                       const struct effects *effects, const int samples[SLAB_AXES], int rays,
                       struct probe_bake *bake, struct bake_report *report, struct error *error);
void probe_bake_free(struct probe_bake *bake);

#endif
