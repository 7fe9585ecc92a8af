/* stats.h - what a command did and what it cost, for --stats: one JSON object.
 *
 *   command, method, tolerance, threads
 *   seconds: {phase: wall seconds, ..., total}
 *   receivers, microlights, nodes, black_microlights, shadow_rays, open_views,
 *   pages_behind
 *   effects: {name: {simulated: true or false, reason: text}, ...}
 *   slab_errors: [{light, page, apertures, about}, ...]: relative RMS errors that the slabs
 *   themselves have at some distances (slab_accuracy.h); digits below them mean nothing
 *   error_estimate: largest predicted relative error of a receiver's matte light; null where
 *   the method predicts none */
#ifndef STATS_H
#define STATS_H

#include <stdbool.h>

#include "cmd/options.h"
#include "light/light.h"
#include "microlight/receiver.h"

enum { STATS_PHASES = 8, STATS_EFFECTS = 8 };

struct stats {
  const char *command; /* not owned, as all texts but the reasons */
  const char *method;
  double tolerance;
  int threads;
  struct gather_counts counts;

  /* By the functions below: */
  int phase_count, effect_count;
  double start; /* of the last phase, seconds; 0 while none goes on */
  struct stats_phase {
    const char *name;
    double seconds;
  } phases[STATS_PHASES];
  struct stats_effect {
    const char *name;
    bool simulated;
    char reason[160];
  } effects[STATS_EFFECTS];
};

/* Those of the command that is running, in its phase "load". */
struct stats stats_start(const struct options *options);

/* Ends the phase that goes on, if any, and starts the next; NULL starts none. What comes after
 * STATS_PHASES is added to the last. */
void stats_phase(struct stats *stats, const char *name);

/* Says whether an effect was simulated, and why. What comes after STATS_EFFECTS is dropped. */
void stats_effect(struct stats *stats, const char *name, bool simulated, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Writes the object, whole or not at all; "-" is stdout, and NULL leaves it at that. Ends the phase
 * that goes on. Estimates the slabs' own errors, which takes a moment. */
enum result stats_write(struct stats *stats, const struct light *lights, int count,
                        const char *path, struct error *error);

#endif
