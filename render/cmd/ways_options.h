/* ways_options.h - the part of `renderslab tradeoff` that goes all the way, from a lamp script to
 * the picture. */
#ifndef WAYS_OPTIONS_H
#define WAYS_OPTIONS_H

#include <argp.h>

#include "cmd/world.h"
#include "tradeoff/ways.h"

struct ways_options {
  const char *errors; /* the ladder as text; NULL: not given */
  const char *bakes;
  int pictures; /* 0: not given */
  double time_limit;
  bool all;
  double ladder[WAYS_MOST_RUNGS]; /* of `errors`, or the usual one */
  int rungs;
};

/* Do the light and the options ask for it? A lamp script, or the ladder. */
bool ways_options_ask(const struct ways_options *ways, const struct options *lights);

/* Reads the ladder and refuses, by argp_error, what does not go together. */
void ways_options_check(struct ways_options *ways, const struct options *lights,
                        struct argp_state *state);

/* Loads the scene, measures, and writes plot, table and words. `output` and `plot` may be NULL;
 * the words go to standard output, unless the table goes there, which has them too. */
enum result ways_options_run(struct world *world, const struct ways_options *ways,
                             const char *output, const char *plot, struct error *error);

#endif
