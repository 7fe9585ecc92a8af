#include "batch/bake_grow.h"

#include <string.h>

/* How far a beam is followed along each axis, in samples. Along u and v the next view has had rays
 * of its own; along s and t a tile is wide, and one sample would seldom leave it. */
static const int reach[SLAB_AXES] = {1, 1, 2, 2};

static int raise(int *passes, int tile, int to) {
  bool low = passes[tile] < to;
  if (low) passes[tile] = to;
  return low;
}

int bake_grow(const struct bake_tiles *tiles, const struct bake_sum *sum, int to, int *passes) {
  int raised = 0;
  for (int page = 0; page < tiles->pages; ++page) {
    const struct slab *slab = &tiles->slabs[page];
    for (size_t n = 0; n < slab_sample_count(slab); ++n) {
      int at[SLAB_AXES];
      if (!bake_sum_is_lit(sum, page, n)) continue;
      slab_locate(slab, n, at);
      raised += raise(passes, bake_tile_at(tiles, page, at), to);
      for (int axis = 0; axis < SLAB_AXES; ++axis)
        for (int side = -1; side <= 1; side += 2) {
          int beside[SLAB_AXES];
          memcpy(beside, at, sizeof beside);
          beside[axis] += side * reach[axis];
          if (beside[axis] >= 0 && beside[axis] < slab->samples[axis])
            raised += raise(passes, bake_tile_at(tiles, page, beside), to);
        }
    }
  }
  return raised;
}
