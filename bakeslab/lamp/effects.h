/* effects.h - the effects of a lamp that are simulated, and how far each is taken: the words of
 * canned.inc's Canned_Needs and of `bakeslab bake --effects`. */
#ifndef EFFECTS_H
#define EFFECTS_H

#include <stdbool.h>
#include <stdio.h>

#include "base/result.h"

enum effect { INTERREFLECTION, CAUSTICS, EXTENDED_SOURCE, DEEP_TRACE, EFFECTS };

struct effects {
  int setting[EFFECTS]; /* 0: off; else how far: bounces, photons, lights along the source,
                           trace level */
  bool named;           /* by the user or the script, rather than "all" */
};

const char *effect_word(enum effect effect);

/* The settings to try, one after the other, up to a 0. */
const int *effect_ladder(enum effect effect);

/* "all", "none", or words separated by blanks or commas, each alone, at canned.inc's own
 * setting, or as "word=setting"; names the source ("--effects") of what is wrong. */
enum result effects_parse(const char *text, const char *source, struct effects *effects,
                          struct error *error);

bool effects_any(const struct effects *effects);

/* Declares for canned.inc which effects a scene has. */
void effects_declare(const struct effects *effects, FILE *scene);

#endif
