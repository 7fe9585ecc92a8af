#include "batch/bake_order.h"

/* A number from the process's name, so that processes begin at different places. */
static size_t own_number(const struct bake_store *store) {
  size_t hash = 0;
  for (const char *id = store->worker->name.id; *id; ++id) hash = 31 * hash + (unsigned char)*id;
  return hash;
}

/* The end of the batches from one on that are more than half as large. */
static size_t end_of_size(const struct bake_round *round, size_t from) {
  size_t end = from;
  while (end < round->batch_count && 2 * round->batches[end].rays > round->batches[from].rays)
    ++end;
  return end;
}

size_t bake_order(const struct bake_round *round, const struct bake_store *store, int shard,
                  int shards, bool part, size_t *order) {
  size_t step = (size_t)shards, count = round->batch_count, filled = 0;
  for (size_t turn = 0; turn < (part ? 1 : step); ++turn)
    for (size_t k = ((size_t)shard + turn) % step; k < count; k += step) order[filled++] = k;
  if (shards > 1 || !bake_store_has_others(store)) return filled;
  size_t number = own_number(store);
  for (size_t from = 0, end; from < count; from = end) {
    end = end_of_size(round, from);
    for (size_t k = from; k < end; ++k) order[k] = from + (k - from + number) % (end - from);
  }
  return filled;
}
