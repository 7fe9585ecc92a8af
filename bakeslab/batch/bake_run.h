/* bake_run.h - renders the batches of a round by several POV-Ray processes. */
#ifndef BAKE_RUN_H
#define BAKE_RUN_H

#include "base/progress.h"
#include "batch/bake_options.h"
#include "batch/bake_scene.h"
#include "batch/bake_store.h"
#include "batch/bake_sum.h"

/* How many rays samples get, and which batches this process renders. */
struct bake_effort {
  int rays;          /* passes: 1 or an even number; the mean where adaptive */
  int rays_max;      /* for the noisiest tiles, where adaptive */
  bool adaptive;     /* tiles get passes by their noise; else all get the same */
  int shard, shards; /* this process renders batches shard, shard + shards, ... */
  enum bake_wave wave;
};

/* All that a round needs besides itself; nothing is owned. */
struct bake_work {
  const struct bake_options *options;
  struct bake_effort effort;
  const struct povray *povray;
  const struct lamp_source *source;
  const struct lamp *lamp;
  const struct bake_store *store;
  const struct slab *slabs; /* lamp->slab_count of them */
  struct bake_look look;
  char plan[33]; /* key of the whole bake (bake_ledger.h); empty: of a small one */
  const volatile sig_atomic_t *stop;
};

/* What helps where photons are lost. */
#define BAKE_PHOTONS_ADVICE                                                                        \
  "give the glass or mirror `photons { target ... }` and keep its centre off the bulb's, or "      \
  "leave "                                                                                         \
  "caustics out"

/* What an interrupted bake says. */
enum result bake_run_stopped(const struct bake_work *work, struct error *error);

/* The keys of a round's batches. */
enum result bake_run_keys(const struct bake_work *work, struct bake_round *round,
                          struct error *error);

/* Renders what the store lacks of a round and nobody else holds, and waits for what others do;
 * `part`: of this shard's batches alone. With a sum, all of the round is added to that, in order.
 * On an error or a stop all processes end and their scratch folders go; finished batches stay. */
enum result bake_run(const struct bake_work *work, const struct bake_round *round, bool part,
                     struct bake_sum *sum, struct bake_report *report, struct error *error);

#endif
