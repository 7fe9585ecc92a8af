/* slab_missed.h - the light that a lamp's pages miss, as far as the slab itself shows it: where it
 * is not dark yet at the ends of its window, or beside a rectangle where no other page goes on.
 * The bake measures it (bake_energy.h); this is for slabs that do not tell. */
#ifndef SLAB_MISSED_H
#define SLAB_MISSED_H

#include "slab/slab.h"

enum { SLAB_MISSED_WHERE = 200 };

struct slab_missed {
  double flux;   /* of the pages so far, |radiance|; lamp units */
  double beyond; /* the same beyond their windows, if the radiance at the ends goes on */
  char where[SLAB_MISSED_WHERE]; /* "page 1 high s, ..."; empty: nowhere */
};

/* Adds page `number` (from 0) of a lamp of `count` pages; pages(of, n) gives their geometry. */
enum result slab_missed_add(const struct slab *page, int number, int count,
                            const struct slab *(*pages)(const void *of, int n), const void *of,
                            struct slab_missed *missed, struct error *error);

#endif
