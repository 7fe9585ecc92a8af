/* options.h - what the commands share on the command line: the lights, how their light is
 * summed, occluders and threads. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <argp.h>
#include <stdbool.h>
#include <stdint.h>

#include "gather/method.h"

struct options {
  const char **lights; /* texts of --light, in order; the array is owned */
  int light_count;
  bool repair;
  enum gather_method method;     /* auto */
  double tolerance;              /* the method's */
  int level;                     /* of methods with levels; -1: by solid angle */
  int threads;                   /* as many as there are processors */
  uint64_t seed;                 /* 0 */
  const char *stats;             /* NULL: none */
  bool all_effects;              /* false: skip what cannot be seen */
  int shadow_grid, shadow_edge;  /* 16, 256; coarser where the tolerance allows */
  int shadow_map, shadow_groups; /* of method gl: 2048, 0 (each view) */
  bool gl_separate;              /* method gl: a pass for each view */
  unsigned given;                /* which options were, a bit each */
};

/* Shadows, unless the tolerance allows less. */
enum { OPTIONS_SHADOW_GRID = 16, OPTIONS_SHADOW_EDGE = 256 };

/* Limits of --threads and --level, which commands that take no options_argp have too. */
enum { OPTIONS_MOST_THREADS = 1024, OPTIONS_MOST_LEVEL = 30 };

/* For the `children` of a command's argp. The command sets state->child_inputs to its struct
 * options at ARGP_KEY_INIT; defaults are filled in here. Mistakes end in argp_error; at least
 * one light is asked for. */
extern const struct argp options_argp;

/* The lights only, for commands that sum nothing: --light and --repair. */
extern const struct argp options_lights_argp;

void options_free(struct options *options); /* zeroed options allowed */

#endif
