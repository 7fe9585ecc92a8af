/* bake_planes.h - the planes around a lamp through which a small bake looks for light that its
 * pages miss (bake_energy.h). */
#ifndef BAKE_PLANES_H
#define BAKE_PLANES_H

#include "batch/bake_run.h"

/* The planes of a lamp of `count` pages, one after the other: rectangles with windows NEAR theirs
 * and FAR beyond, WIDE rectangles, and those sides of the box around all pages that have no page,
 * where the pages face away from its middle. `open` are these without windows. */
enum bake_planes_kind { PLANES_NEAR, PLANES_FAR, PLANES_WIDE, PLANES_SIDE };

struct bake_planes {
  const struct slab *pages; /* as they are */
  int count, sides;
  struct slab *baked, *open; /* [PLANES_SIDE * count + sides]; own nothing */
};

/* Of the work's pages, which are not owned. Free with bake_planes_free, also after a failure. */
enum result bake_planes_make(const struct bake_work *work, struct bake_planes *planes,
                             struct error *error);
void bake_planes_free(struct bake_planes *planes);

#endif
