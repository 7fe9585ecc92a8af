/* bake_provenance.h - how a slab was baked: the JSON value of its "provenance", the same for the
 * same bake on any machine. */
#ifndef BAKE_PROVENANCE_H
#define BAKE_PROVENANCE_H

#include "bake/bake_energy.h"
#include "batch/bake_run.h"
#include "probe/probe.h"
#include "probe/probe_resolution.h"
#include "probe/probe_window.h"

struct bake_origin {
  struct bake_noise noise;
  bool probed;
  struct probe probe;                 /* where probed */
  struct probe_windows window;        /* no line: as declared */
  struct probe_resolution resolution; /* with options->tolerance */
  struct bake_energy energy;
  char *housing; /* SDL, or NULL */
};

/* The caller frees the text. */
enum result bake_provenance(const struct bake_work *work, const struct bake_origin *origin,
                            const struct warnings *warnings, char **text, struct error *error);

#endif
