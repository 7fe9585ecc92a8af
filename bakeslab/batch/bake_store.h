/* bake_store.h - OUT.partial/: the finished batches of a bake, kept until the slab
 * is written.
 *
 * A batch is a folder named by a key of everything that it depends on: its scene, the
 * content of every file that the lamp reads, POV-Ray's version. It appears by a rename,
 * whole and verified, so that an interrupted bake loses only the batches in hand, and
 * any number of processes, on one machine or over NFS, fill one store. Who of them renders what
 * bake_claim.h says, and bake_ledger.h what the store is of. The last to leave a finished bake's
 * store removes it. */
#ifndef BAKE_STORE_H
#define BAKE_STORE_H

#include <stdbool.h>

#include "batch/bake_worker.h"

struct bake_store {
  char *directory;
  struct bake_worker *worker; /* this process; owned; NULL: not at work there */
  bool fresh;                 /* nothing was in it when it was opened */
};

/* Opens or makes the store beside the output, removes what dead workers left in hand, and what is
 * left of a bake that is done. `jobs` is what others are told. */
enum result bake_store_open(const char *output, int jobs, struct bake_store *store,
                            struct error *error);
/* Leaves the store, which is kept for later unless it is empty, is to be copied even if it is, is
 * of no more use, or is done: the slab is written. Who leaves an empty, dropped or done one as the
 * last removes it, with all that is in it. */
enum bake_store_end { BAKE_STORE_KEPT, BAKE_STORE_SHARD, BAKE_STORE_DROPPED, BAKE_STORE_DONE };
void bake_store_close(struct bake_store *store, enum bake_store_end end);
/* Whether somebody has closed it as done. */
bool bake_store_is_done(const struct bake_store *store);

/* Whether somebody else is at work there. */
bool bake_store_has_others(const struct bake_store *store);
/* Removes the lists of rounds (bake_ledger.h). */
void bake_store_drop_lists(const struct bake_store *store);

/* 32 hexadecimal digits and a 0 from texts up to a NULL. */
void bake_store_key(char key[33], ...) __attribute__((sentinel));
/* Whether a name is such a key: that of a batch's folder. */
bool bake_store_is_key(const char *name);

/* The folder of a batch; the caller frees the string. */
char *bake_store_path(const struct bake_store *store, const char *key);
/* Makes an empty folder to work in, nobody else's, for a batch, or NULL for something else. The
 * caller frees the string. */
enum result bake_store_scratch(const struct bake_store *store, const char *key, char **scratch,
                               struct error *error);
/* Moves a scratch folder in place. Someone else's copy, there already, is as good. */
enum result bake_store_commit(const struct bake_store *store, const char *scratch, const char *key,
                              struct error *error);

#endif
