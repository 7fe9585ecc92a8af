/* probe.h - finds out which effects a lamp needs, by small bakes of the same rays that differ in
 * one setting each.
 *
 * Effects are tried on top of those that matter, the most expensive last; one that matters is
 * taken further (more bounces, photons, lights, levels) until that changes nothing that matters,
 * or there is no further. A change matters above the threshold: that part of the flux, or twice
 * that part of the RMS of the light by direction or by position. */
#ifndef PROBE_H
#define PROBE_H

#include "batch/bake_run.h"

/* What a setting changes. */
struct probe_change {
  double flux; /* relative to the flux with it, signed; INFINITY: from no light to some */
  double rms;  /* by direction, all positions together, or by position: the larger one;
                  relative to the RMS with it */
  double rays; /* with it, relative to without: rays that POV-Ray traced, a measure of time
                  that does not depend on the machine */
};

struct probe_effect {
  struct probe_change first; /* what it changes at all */
  struct probe_change next;  /* what the next setting would change, or the last one changed */
  bool tried;                /* there is a next */
  bool converged;            /* and it does not matter */
};

struct probe {
  struct probe_effect effects[EFFECTS];
};

/* Fills *effects with those that matter, and tells in *probe why. */
enum result probe_effects(const struct bake_work *work, struct effects *effects,
                          struct probe *probe, struct bake_report *report, struct error *error);

/* Takes caustics out of *effects, with a warning, where the photons of this lamp are lost. */
enum result probe_photons(const struct bake_work *work, struct effects *effects,
                          struct bake_report *report, struct error *error);

enum { PROBE_LINE = 160 };

/* What was decided on an effect and why, one line: "on: flux +36 %, ...". */
void probe_say(const struct probe *probe, const struct effects *effects, enum effect effect,
               char line[PROBE_LINE]);

#endif
