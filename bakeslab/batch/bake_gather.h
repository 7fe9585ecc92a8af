/* bake_gather.h - brings together what shards baked in folders of their own: batches of copies of
 * OUT.partial/ go into one. */
#ifndef BAKE_GATHER_H
#define BAKE_GATHER_H

#include "batch/bake_ledger.h"

struct bake_gather {
  size_t batches;                 /* that are new there */
  size_t had;                     /* that were there, with the same pixels */
  size_t damaged;                 /* cut off or unreadable: left out */
  size_t differ;                  /* of other pixels than what is there, which stays */
  void (*warn)(const char *line); /* called for each of the latter two; or NULL */
};

/* Copies what is whole of the folders into OUTPUT.partial, which is made if need be. Refuses,
 * before anything is copied, folders of different bakes, versions, or numbers of shards. */
enum result bake_gather(const char *const *folders, int count, const char *output,
                        struct bake_gather *gather, struct error *error);

#endif
