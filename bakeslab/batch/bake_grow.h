/* bake_grow.h - where a bake looks again: at what its rays found, and around it. */
#ifndef BAKE_GROW_H
#define BAKE_GROW_H

#include "batch/bake_sum.h"

/* Whether most of the light that the first rays met has some beside it. Where it has not, the
 * search met a source smaller than a sample by chance, and missed as much elsewhere. */
bool bake_grow_has_beams(const struct bake_tiles *tiles, const struct bake_sum *sum);

/* Raises passes[], by tile, to at least `to` where a sample met light, or one that did is within a
 * few samples: the beam that it belongs to may be there too. Returns how many tiles it raised. */
int bake_grow(const struct bake_tiles *tiles, const struct bake_sum *sum, int to, int *passes);

#endif
