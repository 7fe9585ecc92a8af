/* bake_rounds.h - the rays of a bake, summed: one everywhere, more around what they find, and the
 * rest of the passes where those were noisy. */
#ifndef BAKE_ROUNDS_H
#define BAKE_ROUNDS_H

#include "batch/bake_run.h"

struct bake_rounds {
  struct bake_tiles tiles;
  struct bake_sum *sum; /* whole, unless work->effort.shards > 1 */
};

/* What the user asks for. */
struct bake_effort bake_effort_of(const struct bake_options *options);

/* Passes of the first round; all of them, where there is no other. */
int bake_rounds_first(const struct bake_work *work);

/* Renders and sums work->slabs, showing progress under the label. Free the rounds with
 * bake_rounds_free in any case. */
enum result bake_rounds_run(const struct bake_work *work, const char *label,
                            struct bake_rounds *rounds, struct bake_report *report,
                            struct error *error);
void bake_rounds_free(struct bake_rounds *rounds);

#endif
