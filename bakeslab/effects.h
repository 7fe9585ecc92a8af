/* effects.h - what of a lamp is simulated: the words of canned.inc's Canned_Needs and of
 * `bakeslab bake --effects`, and how far each is taken. */
#ifndef EFFECTS_H
#define EFFECTS_H

#include <stdbool.h>
#include <stdio.h>

#include "slab_error.h"

enum effect { INTERREFLECTION, CAUSTICS, EXTENDED_SOURCE, DEEP_TRACE, EFFECTS };

struct effects {
  int level[EFFECTS]; /* 0: off; from 1 on: how far (effect_setting) */
  bool named;         /* somebody asked for these, rather than for all */
};

const char *effect_word(enum effect effect);

/* What a level from 1 on stands for: bounces, photons, lights along the source, trace level. */
int effect_setting(enum effect effect, int level);
int effect_levels(enum effect effect); /* the last level */

/* "all", "none" or words separated by blanks or commas, each at canned.inc's own setting;
 * names the source ("--effects") where a word is unknown. */
enum slab_result effects_parse(const char *text, const char *source, struct effects *effects,
                               struct slab_error *error);

bool effects_any(const struct effects *effects);

/* Declares for canned.inc which effects a scene has. */
void effects_declare(const struct effects *effects, FILE *scene);

#endif
