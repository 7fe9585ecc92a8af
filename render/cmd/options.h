/* options.h - what the commands share on the command line: the lights, how their light is
 * summed, occluders and threads. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <argp.h>
#include <stdbool.h>
#include <stdint.h>

#include "gather/gather.h"
#include "gl/gl_sum.h"

struct options {
  const char **lights; /* texts of --light, in order; the array is owned */
  int light_count;
  enum gather_method method; /* auto */
  double tolerance;          /* 0.01; 1e-6 for the method reference */
  int level;                 /* of methods levels; -1: by solid angle */
  int threads;               /* as many as there are processors */
  uint64_t seed;             /* 0 */
  const char *stats;         /* NULL: none */
  bool repair;
  bool all_effects;              /* false: skip what cannot be seen */
  int shadow_grid, shadow_edge;  /* 16, 256; coarser where the tolerance allows */
  int shadow_map, shadow_groups; /* of method gl: 2048, 0 (each view) */
  bool gl_separate;              /* method gl: a pass for each view */
  unsigned given;                /* which options were, a bit each */
};

/* Shadows, unless the tolerance allows less. */
enum { OPTIONS_SHADOW_GRID = 16, OPTIONS_SHADOW_EDGE = 256 };

/* For the `children` of a command's argp. The command sets state->child_inputs to its struct
 * options at ARGP_KEY_INIT; defaults are filled in here. Mistakes end in argp_error; at least
 * one light is asked for. */
extern const struct argp options_argp;

/* The lights only, for commands that sum nothing: --light and --repair. */
extern const struct argp options_lights_argp;

void options_free(struct options *options); /* zeroed options allowed */

/* Loads all lights. *lights is an array of options->light_count, freed with
 * options_free_lights; NULL after a failure. */
enum result options_load_lights(const struct options *options, struct light **lights,
                                struct error *error);
void options_free_lights(struct light *lights, int count); /* NULL allowed */

/* How to sum; `occlusion` may be NULL. `aids` are gather_prepare's for the same lights. */
struct gather_settings options_settings(const struct options *options, const struct light *lights,
                                        const struct gather_prepared *aids,
                                        const struct occlusion *occlusion);

/* How to sum by the method gl; `occluders` may be NULL. */
struct gl_sum_settings options_gl_settings(const struct options *options,
                                           const struct light *lights,
                                           const struct gather_prepared *aids,
                                           const struct scene *occluders);

/* The whole text is one finite number; one whole number from `low` to `high`; `count` finite
 * numbers with commas between them. */
bool options_number(const char *text, double *number);
bool options_count(const char *text, uint64_t low, uint64_t high, uint64_t *count);
bool options_numbers(const char *text, int count, double *numbers);

#endif
