/* bake_store.h - OUT.partial/: the finished batches of a bake, kept until the slab
 * is written.
 *
 * A batch is a folder named by a key of everything that it depends on: its scene, the
 * content of every file that the lamp reads, POV-Ray's version. It appears by a rename,
 * whole and verified, so that an interrupted bake loses only the batches in hand, and
 * several processes or machines can fill one store. */
#ifndef BAKE_STORE_H
#define BAKE_STORE_H

#include <stdbool.h>

#include "base/result.h"

struct bake_store {
  char *directory;
  int lock;
  bool fresh; /* nothing was in it when it was opened */
};

/* Opens or makes the store beside the output. Shards share it; a bake that is to
 * assemble wants it alone and is refused while other processes are at work. One that was
 * killed is not, even where a child of it still runs. A process opens a store once. */
enum result bake_store_open(const char *output, bool shared, struct bake_store *store,
                            struct error *error);
/* Closes the store; `finished` removes it with all that is in it. */
void bake_store_close(struct bake_store *store, bool finished);

/* 32 hexadecimal digits and a 0 from texts up to a NULL. */
void bake_store_key(char key[33], ...) __attribute__((sentinel));

/* The folder of a batch; the caller frees the string. */
char *bake_store_path(const struct bake_store *store, const char *key);
/* Makes an empty folder to work in, nobody else's; the caller frees the string. */
enum result bake_store_scratch(const struct bake_store *store, char **scratch, struct error *error);
/* Moves a scratch folder in place. Someone else's copy, there already, is as good. */
enum result bake_store_commit(const struct bake_store *store, const char *scratch, const char *key,
                              struct error *error);

#endif
