/* export_overlap.h - pages that share an aperture, as those of several groups of bulbs do: their
 * light adds up, but of two polygons in one place other renderers see only one. */
#ifndef EXPORT_OVERLAP_H
#define EXPORT_OVERLAP_H

#include "slab/slab.h"

struct export_joined {
  struct slab *pages; /* those of the lamp, or sums of several; owned but for what they point to */
  float **sums;       /* samples of the sums, else NULL; owned */
  int *numbers;       /* of the lamp's page, or of the first of several, from 1 on; owned */
  int count;
};

/* Adds pages that are slab_alike, and leaves all others as they are, in order; the slabs must
 * outlive them. RESULT_BAD where pages with light overlap and are not alike. Free with
 * export_joined_free, also after a failure. */
enum result export_join(const struct slab *slabs, int count, struct export_joined *joined,
                        struct error *error);
void export_joined_free(struct export_joined *joined);

#endif
