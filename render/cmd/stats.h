/* stats.h - what a command did and what it cost, for --stats: one JSON object.
 *
 *   command, method, tolerance, threads
 *   seconds: {phase: wall seconds, ..., total}
 *   receivers, microlights, nodes, black_microlights, shadow_rays, open_views,
 *   pages_behind
 *   effects: {name: {simulated: true or false, reason: text}, ...}
 *   slab_errors: [{light, page, apertures, about}, ...]: relative RMS errors that the slabs
 *   themselves have at some distances (slab_accuracy.h); digits below them mean nothing
 *   imported: [{light, source, kind, assumptions, flux_in, flux_out, error, error_is}, ...], of
 *   lamps whose light was imported (slab_source.h); left out where there are none
 *   error: {noise, resolution, logluv, sum, shadows, all}, of a picture (image_error.h): RMS over
 *   mean; null where it is not known; `all` is that of what is known
 *   error_estimate: largest predicted relative error of a receiver's matte light; null where
 *   the method predicts none */
#ifndef STATS_H
#define STATS_H

#include <stdbool.h>

#include <jansson.h>

#include "cmd/world.h"
#include "picture/image_error.h"

struct stats {
  struct gather_counts counts; /* set by the command */

  /* By the functions below: */
  unsigned long mark;  /* json_text.h */
  json_t *seconds;     /* of the phases that have ended; owned */
  json_t *effects;     /* owned */
  json_t *error;       /* of a picture; NULL until it is known; owned */
  const char *phase;   /* that goes on; not owned */
  double start, total; /* seconds: its start; of all phases */
};

/* In the phase "load". To be followed by stats_end. */
struct stats stats_start(void);

/* Ends the phase that goes on, if any, and starts the next, of another name than all before; NULL:
 * none. */
void stats_phase(struct stats *stats, const char *name);

/* Says whether an effect was simulated, and why. */
void stats_effect(struct stats *stats, const char *name, bool simulated, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Notes the error of a picture. */
void stats_error(struct stats *stats, const struct image_error *told);

/* The end of a command. Where `result` is RESULT_OK and --stats was given: ends the phase that goes
 * on and writes the object, whole or not at all, to a file or to "-", stdout; estimates the slabs'
 * own errors for that, which takes a moment. Frees what is owned. */
enum result stats_end(struct stats *stats, const struct world *world, enum result result,
                      struct error *error);

#endif
