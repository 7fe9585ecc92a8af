#include "batch/bake_grow.h"

#include <string.h>

/* How far a beam is followed along each axis, in samples. Along u and v the next view has had rays
 * of its own; along s and t a tile is wide, and one sample would seldom leave it. */
static const int reach[SLAB_AXES] = {1, 1, 2, 2};

/* The sample that is some samples from at[] along an axis, in its page's raster; false: there is
 * none. */
static bool step_to(const struct slab *slab, const int at[SLAB_AXES], int axis, int steps,
                    int beside[SLAB_AXES], size_t *sample) {
  memcpy(beside, at, SLAB_AXES * sizeof *beside);
  beside[axis] += steps;
  if (beside[axis] < 0 || beside[axis] >= slab->samples[axis]) return false;
  *sample = slab_pixel(slab, beside);
  return true;
}

bool bake_grow_has_beams(const struct bake_tiles *tiles, const struct bake_sum *sum) {
  double all = 0, together = 0;
  for (int page = 0; page < tiles->pages; ++page)
    for (size_t n = 0; n < slab_sample_count(&tiles->slabs[page]); ++n) {
      double light = bake_sum_light(sum, page, n);
      int at[SLAB_AXES], beside[SLAB_AXES];
      size_t other;
      bool alone = true;
      if (light == 0) continue;
      slab_locate(&tiles->slabs[page], n, at);
      for (int k = 0; k < 2 * SLAB_AXES; ++k)
        if (step_to(&tiles->slabs[page], at, k / 2, k % 2 ? 1 : -1, beside, &other))
          alone &= !bake_sum_is_lit(sum, page, other);
      all += light;
      together += alone ? 0 : light;
    }
  return together > 0.5 * all;
}

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
      int at[SLAB_AXES], beside[SLAB_AXES];
      size_t other;
      if (!bake_sum_is_lit(sum, page, n)) continue;
      slab_locate(slab, n, at);
      raised += raise(passes, bake_tile_at(tiles, page, at), to);
      for (int k = 0; k < 2 * SLAB_AXES; ++k)
        if (step_to(slab, at, k / 2, reach[k / 2] * (k % 2 ? 1 : -1), beside, &other))
          raised += raise(passes, bake_tile_at(tiles, page, beside), to);
    }
  }
  return raised;
}
