/* probe_resolution.h - the fewest samples with which a slab lights what is at a distance and
 * beyond within a tolerance. A small bake shows how its error falls with resolution. */
#ifndef PROBE_RESOLUTION_H
#define PROBE_RESOLUTION_H

#include "batch/bake_run.h"

struct probe_resolution {
  double distance; /* from here on, in lamp units */
  char line[320];  /* what was decided, one line */
};

/* Sets samples of slabs[work->lamp->slab_count], alike on all pages, for options->tolerance
 * at options->for_distance (0: 4 apertures) and beyond; those that the user fixed stay. With
 * for_distance the st planes are put there where that needs fewer samples, their windows
 * widened so that they hold the same rays. Where no resolution meets the tolerance it takes the
 * best. */
enum result probe_resolution(const struct bake_work *work, struct slab *slabs,
                             struct probe_resolution *resolution, struct bake_report *report,
                             struct error *error);

#endif
