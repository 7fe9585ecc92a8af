/* effects.h - what of a lamp is simulated: the words of canned.inc's Canned_Needs and of
 * `bakeslab bake --effects`. */
#ifndef EFFECTS_H
#define EFFECTS_H

#include <stdbool.h>

#include "slab_error.h"

/* Every word there is, separated by blanks. */
extern const char effects_all[];

struct effects {
  char words[128]; /* of effects_all, in its order */
  bool named;      /* somebody asked for these, rather than for all */
};

/* Reads "all", "none" or words separated by blanks or commas; names the source ("--effects")
 * where a word is unknown. */
enum slab_result effects_parse(const char *text, const char *source, struct effects *effects,
                               struct slab_error *error);
bool effects_has(const struct effects *effects, const char *word);

#endif
