/* probe_bake.h - a small bake, by which the full one is planned or weighed. Its batches are kept
 * like all others: the same small bake again costs nothing. A small bake is one POV-Ray process or
 * two, so that several run at once, each waited for by a thread of its own, and beside the full one
 * too; with --jobs 1 each runs when it is waited for. */
#ifndef PROBE_BAKE_H
#define PROBE_BAKE_H

#include <pthread.h>

#include "batch/bake_run.h"

struct probe_bake {
  struct slab *pages; /* owned */
  int count;
  double cpu;    /* seconds of POV-Ray; of batches that were found, by its own count */
  double traced; /* these three as in bake_report */
  int depth;
  char photons_lost[48];
  struct probe_bake_run *run; /* while it runs; owned */
};

/* Starts to bake slabs[work->lamp->slab_count] with `samples` (NULL: as many as they say) of `rays`
 * each. The lamp and all else that `work` points to, but for the slabs and effects, stay until
 * probe_bake_wait. Free the bake with probe_bake_free in any case. */
enum result probe_bake_start(const struct bake_work *work, const struct slab *slabs,
                             const struct effects *effects, const int samples[SLAB_AXES], int rays,
                             struct probe_bake *bake, struct error *error);

/* Waits until it is done, and adds its time to the report. A bake that was not started, {0}, has
 * no pages. */
enum result probe_bake_wait(struct probe_bake *bake, struct bake_report *report,
                            struct error *error);

/* Both. */
enum result probe_bake(const struct bake_work *work, const struct slab *slabs,
                       const struct effects *effects, const int samples[SLAB_AXES], int rays,
                       struct probe_bake *bake, struct bake_report *report, struct error *error);

/* Lets one that still runs come to its end. */
void probe_bake_free(struct probe_bake *bake);

#endif
