/* bake.h - renders a lamp script into light slabs with the stock POV-Ray.
 *
 * Probe (lamp.h), pilot passes everywhere, the rest of the passes where the pilot
 * was noisy (bake_plan.h), all in batches of keyed, verified folders (bake_store.h)
 * by several POV-Ray processes; then sums (bake_sum.h) and the slab. The same options
 * give the same samples, bit for bit, for any number of jobs and shards. */
#ifndef BAKE_H
#define BAKE_H

#include <signal.h>

#include "base/result.h"
#include "batch/bake_options.h"

/* Bakes. `stop`, set by a signal handler, ends it with RESULT_STOPPED; finished
 * batches stay in OUTPUT.partial and the next bake goes on from there. */
enum result bake(const struct bake_options *options, const volatile sig_atomic_t *stop,
                 struct bake_report *report, struct error *error);

#endif
