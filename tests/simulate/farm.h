/* farm.h - bakes by many workers, simulated: how long they take, and how long workers wait.
 *
 * A worker is a process of one job, and does what bake_run.c and bake_rounds.c do: it joins, goes
 * through the rounds in order, takes the first batch that nobody holds who is alive as far as it
 * can see, sums the pilots, and plans by them; the first to reach the last round sums that too, and
 * writes the slab, for which the others wait before they go on to a lamp that is not done. A worker
 * that died is seen to be dead at once on its own machine, and elsewhere when its lease is over.
 * Times are in seconds. */
#ifndef FARM_H
#define FARM_H

#include <stdbool.h>
#include <stddef.h>

struct farm_batch {
  double seconds; /* by a worker of speed 1 */
  double rays;
};

struct farm_round {
  struct farm_batch *batches; /* owned */
  size_t count;
};

enum { FARM_ROUNDS = 8 };

/* A bake. What a process does besides rendering, by a worker of speed 1. */
struct farm_lamp {
  struct farm_round rounds[FARM_ROUNDS];
  int round_count;
  double join;   /* before its first batch: the trial run and small bakes */
  double read;   /* a ray that it sums */
  double plan;   /* after a pilot */
  double finish; /* who writes the slab, after the last batch */
};

/* Frees the rounds. */
void farm_lamp_free(struct farm_lamp *lamp);

struct farm_workers {
  int count;
  int machine;       /* workers of one */
  double unevenness; /* speeds are uniform in 1 -+ this */
  double dying;      /* part of the workers that die, ... */
  double until;      /* ... at a time uniform in 0 to this */
};

struct farm_result {
  double wall;
  double idle; /* part of the living workers' time in which they wait */
};

/* Runs all lamps, which workers begin by turns. The random numbers are the same in each run.
 * Returns false without memory. */
bool farm_run(const struct farm_lamp *lamps, int lamp_count, const struct farm_workers *workers,
              struct farm_result *result);

#endif
