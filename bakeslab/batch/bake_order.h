/* bake_order.h - in which order a process tries the batches of a round: the largest first, so that
 * many end together; those of its shard before others; and, where others are at work on the folder,
 * from a place of its own among those of one size, so that they do not all try the same ones. */
#ifndef BAKE_ORDER_H
#define BAKE_ORDER_H

#include "batch/bake_plan.h"
#include "batch/bake_store.h"

/* Fills order[round->batch_count]; of shards, from 0, with those of the others after its own, or,
 * `part`, without them. Returns how many there are. */
size_t bake_order(const struct bake_round *round, const struct bake_store *store, int shard,
                  int shards, bool part, size_t *order);

#endif
