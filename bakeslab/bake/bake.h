/* bake.h - renders a lamp script into light slabs with the stock POV-Ray.
 *
 * Batches are rendered by several POV-Ray processes and kept until the slab is written
 * (bake_store.h). The same options give the same samples, bit for bit, for any number of jobs and
 * shards. */
#ifndef BAKE_H
#define BAKE_H

#include <signal.h>

#include "base/result.h"
#include "batch/bake_options.h"

/* Bakes options->lamp into options->output. `stop`, set by a signal handler, ends it with
 * RESULT_STOPPED; finished batches stay in OUTPUT.partial and the next bake goes on from there. */
enum result bake(const struct bake_options *options, const volatile sig_atomic_t *stop,
                 struct bake_report *report, struct error *error);

#endif
