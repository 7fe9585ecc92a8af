/* tradeoff.h - what accuracy costs in time: the receivers of one picture gather their light by
 * every method at a ladder of settings, and the results are compared with the reference.
 *
 * Only the gathering is timed: what the camera sees is found before. Errors have two sources,
 * the sum over micro lights and the edges of shadows: the method auto is also measured with
 * coarser and finer shadows, and each sum against one with the same shadows too. */
#ifndef TRADEOFF_H
#define TRADEOFF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/tiles.h"
#include "gather/gather.h"
#include "picture/shade.h"

enum { TRADEOFF_MOST_REPEATS = 99, TRADEOFF_MOST_RUNGS = 256 };
enum { TRADEOFF_NO_LEVEL = -2 };     /* -1: by solid angle, as in gather.h */
enum { TRADEOFF_FINER_SHADOWS = 4 }; /* times, of the reference with which all are compared */

/* Tolerance of the reference with which all are compared. */
extern const double tradeoff_truth;

struct tradeoff_settings {
  struct shade shade;
  struct gather_settings gather; /* lights, seed, occlusion, usual shadows; the rest is the
                                    ladder's */
  bool methods[GATHER_METHODS];  /* which to measure; not METHOD_OPENGL */
  bool matte;                    /* no shadows, no highlights: methods that are matte_only too */
  int levels;                    /* the last that is measured; -1: all */
  double finest;                 /* tolerance at which the ladder ends, > 0 */
  int threads;                   /* >= 1 */
  int repeats;                   /* 1..TRADEOFF_MOST_REPEATS */
  tiles_progress *progress;      /* may be NULL */
  void *progress_context;
};

/* RMS and largest relative error of a picture: the root of the mean square over that of the
 * reference; the largest error of a pixel over its own light, or over a hundredth of the
 * picture's mean where it is darker. */
struct tradeoff_error {
  double rms, most;
};

/* Median, lowest and highest of the repeats. */
struct tradeoff_spread {
  double middle, low, high;
};

/* One method at one setting. */
struct tradeoff_rung {
  enum gather_method method;
  double tolerance; /* 0: it has none */
  int level;        /* TRADEOFF_NO_LEVEL: it has none */
  int shadow_grid, shadow_edge;
  bool shadows;                     /* one of those that differ by their shadows alone */
  bool refused;                     /* the method cannot do this scene: nothing else is known */
  struct tradeoff_spread cpu, wall; /* seconds for all receivers; CPU of all threads */
  struct tradeoff_error error;      /* against the reference */
  struct tradeoff_error sum;        /* against that with the usual shadows; unless `shadows` */
  struct gather_counts counts;

  int repeats; /* measured so often: what took over a second once */
  double cpus[TRADEOFF_MOST_REPEATS], walls[TRADEOFF_MOST_REPEATS];
};

/* What a method made of the slabs first. */
struct tradeoff_prepared {
  bool made;
  struct gather_prepared prepared;
  double cpu;   /* seconds */
  size_t bytes; /* of memory that it keeps */
};

struct tradeoff {
  size_t receivers;
  int count;
  struct tradeoff_rung *rungs; /* owned */
  struct tradeoff_prepared prepared[GATHER_METHODS];
  char refusal[GATHER_METHODS][200]; /* why a method cannot do this scene; "" */
  double truth_cpu;
};

/* Measures. Refuses a picture in which nothing is lit. Free with tradeoff_free, also after a
 * failure. */
enum result tradeoff_measure(const struct tradeoff_settings *settings, struct tradeoff *tradeoff,
                             struct error *error);
void tradeoff_free(struct tradeoff *tradeoff); /* zeroed allowed */

/* The rungs, in the order of the methods, by their dials (tradeoff_ladder.c): methods without one
 * have one rung, those with levels one a level and one by solid angle, those with a tolerance one
 * for each from 0.1 down to settings->finest. Then, where there are shadows, auto with other ones.
 * `levels` is how many there are besides level 0. Returns how many rungs. */
int tradeoff_ladder(const struct tradeoff_settings *settings, int levels,
                    struct tradeoff_rung rungs[TRADEOFF_MOST_RUNGS]);

/* What was measured and how, for the head of the table. */
struct tradeoff_about {
  const char *command, *mesh;
  size_t slab_bytes; /* of the slabs in memory */
};

/* The table and a script for gnuplot, without its terminal (tradeoff_write.c). */
void tradeoff_print(FILE *file, const struct tradeoff_settings *settings,
                    const struct tradeoff *tradeoff, const struct tradeoff_about *about);
void tradeoff_plot(FILE *file, const struct tradeoff *tradeoff, const struct tradeoff_about *about);

#endif
