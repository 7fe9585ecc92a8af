/* bake_status.h - how far a bake is, by what lies in OUT.partial/: for people, schedulers and
 * scripts, without POV-Ray and without the lamp. */
#ifndef BAKE_STATUS_H
#define BAKE_STATUS_H

#include "batch/bake_ledger.h"

struct bake_status_round {
  struct bake_list list;         /* owned */
  char *state;                   /* [list.count]: one of the letters below; owned */
  size_t done, claimed, missing; /* batches */
  double rays, rays_done;
};
#define BAKE_STATUS_DONE 'd'
#define BAKE_STATUS_CLAIMED 'c'
#define BAKE_STATUS_MISSING 'm'

struct bake_status_claim {
  char key[33];
  struct bake_worker_seen holder;
  double since; /* seconds ago */
  int round;    /* from 0 */
};

struct bake_status {
  struct bake_ledger ledger;
  int round_count, claim_count, worker_count;
  struct bake_status_round *rounds;
  struct bake_status_claim *claims; /* of the rounds' batches, by workers that are alive */
  struct bake_worker_seen *workers; /* those at work, and the dead */
  bool planned;                     /* all rounds are */
  bool written;                     /* the slab is, and somebody is just leaving */
  int jobs;                         /* of workers that are alive */
  double rays, rays_done;           /* in all: told, or about; done */
  double seconds; /* until all is baked, by the jobs at work or by one; NAN: not known */
};

/* Looks at a folder. Free with bake_status_free in any case. */
enum result bake_status(const char *folder, struct bake_status *status, struct error *error);
void bake_status_free(struct bake_status *status);

/* The shards of the last round, from 1, that have batches which are neither there nor in hand, or
 * all where the next round is not planned yet: "1,4-6", as job arrays take them; empty: none. The
 * caller frees it. Refused where the bake is not in shards. */
enum result bake_status_shards(const char *folder, const struct bake_status *status, char **text,
                               struct error *error);

#endif
