/* bake_rounds.h - the rays of a bake, summed: one everywhere, more around what they find, and the
 * rest of the passes where those were noisy. */
#ifndef BAKE_ROUNDS_H
#define BAKE_ROUNDS_H

#include "batch/bake_run.h"

struct bake_rounds {
  struct bake_tiles tiles;
  struct bake_sum *sum; /* of all rays, where `whole` */
  int number;           /* of rounds that were begun; of pilots, where `waits` */
  bool whole; /* the slab may be made of the sum, by this process: the claim on it is held */
  bool waits; /* for the batches of other shards, before it goes on */
  bool grows; /* more pilots follow the first, as long as there is something new */
  int claim;  /* on the plan, where whole */
};

/* What the user asks for. */
struct bake_effort bake_effort_of(const struct bake_options *options);

/* Whether each POV-Ray process costs as much as many rays do. */
bool bake_rounds_are_dear(const struct bake_work *work);

/* Passes of the first round; all of them, where there is no other. */
int bake_rounds_first(const struct bake_work *work);

/* Renders and sums work->slabs, showing progress under the label. Free the rounds with
 * bake_rounds_free in any case. */
enum result bake_rounds_run(const struct bake_work *work, const char *label,
                            struct bake_rounds *rounds, struct bake_report *report,
                            struct error *error);
void bake_rounds_free(struct bake_rounds *rounds);

#endif
