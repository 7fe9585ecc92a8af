/* bake_ledger.h - what OUT.partial/ is of: the file `bake`, and for each round `round.N`, the keys
 * of its batches. Processes of one bake find there that they are; others, and what looks on
 * (bake_status.h, bake_gather.h), read what there is to do.
 *
 * `bake` is a JSON object of the members below; `round.N` (from 1) begins with a line
 * "LABEL BATCHES", and has a line "KEY RAYS" for each batch, in order. */
#ifndef BAKE_LEDGER_H
#define BAKE_LEDGER_H

#include "batch/bake_run.h"

struct bake_ledger {
  char plan[33];     /* key of the next four: the same plan, the same slab, bit for bit */
  char version[32];  /* of bakeslab */
  char povray[64];   /* version */
  char files[33];    /* key of the content of all that the lamp reads */
  char settings[33]; /* key of samples, windows, rays, effects and what else decides samples */
  char lamp[256];    /* the script, as the user named it */
  int shards;        /* into how many it is shared out; 0: into none so far */
  double rays;       /* about how many there are to be in all */
};

enum { BAKE_LEDGER_DIFFERENCE = 256 };

/* What this process bakes. */
enum result bake_ledger_make(const struct bake_work *work, struct bake_ledger *ledger,
                             struct error *error);

/* Reads that of a folder; RESULT_BAD, naming the folder, where there is none. */
enum result bake_ledger_read(const char *folder, struct bake_ledger *ledger, struct error *error);
/* Writes it, whole or not at all; `whose` is put into the name of the file until it is. */
enum result bake_ledger_write(const char *folder, const char *whose,
                              const struct bake_ledger *ledger, struct error *error);

/* In words, where `other` is of another bake: "POV-Ray 3.7, not 3.8". */
void bake_ledger_difference(const struct bake_ledger *ledger, const struct bake_ledger *other,
                            char text[BAKE_LEDGER_DIFFERENCE]);

/* Makes the store one of this plan, which its worker tells others. Refused while somebody is at
 * work on another plan, and where shards of another one, or of another number, lie there. */
enum result bake_ledger_join(const struct bake_store *store, const struct bake_ledger *ledger,
                             struct error *error);

/* Lists the batches of a round, whose keys are known. */
enum result bake_ledger_list(const struct bake_store *store, int number,
                             const struct bake_round *round, struct error *error);

/* Copies the list of a round from another folder of the plan. */
enum result bake_ledger_copy_list(const struct bake_store *store, const char *folder, int number,
                                  struct error *error);

/* The label of the last round; after others more may follow. */
#define BAKE_LEDGER_LAST "bake"

/* A list that was read. */
struct bake_list {
  char label[16];
  size_t count;
  struct bake_list_batch {
    char key[33];
    size_t rays;
  } * batches; /* owned */
};
/* Reads the list of a round; a round that is not there has no label. The caller frees
 * list->batches in any case. */
enum result bake_ledger_read_list(const char *folder, int number, struct bake_list *list,
                                  struct error *error);

#endif
