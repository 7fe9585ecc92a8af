/* bake_claim.h - who renders which batch of a folder that several processes share.
 *
 * A claim is a link, `KEY.0`, to its worker's file (bake_worker.h): made in one step that only one
 * can do, over NFS too, and as old as the worker's last sign of life. Where the worker is dead, who
 * makes the link KEY.1 takes the batch over, and so on. Nobody removes the claims of others until
 * the batch is there; who got a claim looks for the batch once more, therefore.
 *
 * A file system without hard links has no claims: batches may be rendered twice there, and nothing
 * else is different. */
#ifndef BAKE_CLAIM_H
#define BAKE_CLAIM_H

#include "batch/bake_worker.h"

/* The claim is another's. */
enum { BAKE_CLAIM_OTHERS = -1 };

/* *claim: its number, where it is ours now; BAKE_CLAIM_OTHERS where somebody alive, or another
 * thread, holds it, or it has just gone. */
enum result bake_claim_take(struct bake_worker *worker, const char *key, int *claim,
                            struct error *error);
/* Gives an unfinished batch to whoever wants it. */
void bake_claim_leave(struct bake_worker *worker, const char *key, int claim);
/* Once a batch is there. */
void bake_claim_end(struct bake_worker *worker, const char *key, int claim);

/* Who holds a key of a folder; false where nobody does, or is dead. */
bool bake_claim_look(const char *folder, const char *key, double now,
                     struct bake_worker_seen *holder);

#endif
