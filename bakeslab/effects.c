/* effects.c - see effects.h. */
#include "effects.h"

#include <string.h>

enum { MOST_LEVELS = 5 };

/* The variable by which canned.inc learns the setting. */
static const struct {
  const char *word, *variable;
  int settings[MOST_LEVELS]; /* up to a 0 */
  int usual;                 /* level of an effect that is asked for: canned.inc's own */
} table[EFFECTS] = {
    [INTERREFLECTION] = {"interreflection", "Canned_Bake_Bounces", {1, 2, 3, 4, 5}, 2},
    [CAUSTICS] = {"caustics", "Canned_Bake_Photons", {100000, 400000, 1600000}, 2},
    [EXTENDED_SOURCE] = {"extended_source", "Canned_Bake_Source_Lights", {5, 9, 17}, 3},
    [DEEP_TRACE] = {"deep_trace", "Canned_Bake_Trace_Level", {30, 60, 120}, 1},
};

const char *effect_word(enum effect effect) {
  return table[effect].word;
}

int effect_setting(enum effect effect, int level) {
  return table[effect].settings[level - 1];
}

int effect_levels(enum effect effect) {
  int level = 0;
  while (level < MOST_LEVELS && table[effect].settings[level]) ++level;
  return level;
}

enum slab_result effects_parse(const char *text, const char *source, struct effects *effects,
                               struct slab_error *error) {
  *effects = (struct effects){.named = strcmp(text, "all") != 0};
  for (int k = 0; k < EFFECTS; ++k) effects->level[k] = effects->named ? 0 : table[k].usual;
  if (!effects->named || !strcmp(text, "none")) return SLAB_OK;
  for (const char *at = text; *(at += strspn(at, " ,"));) {
    size_t n = strcspn(at, " ,");
    int k = 0;
    while (k < EFFECTS && (strlen(table[k].word) != n || strncmp(at, table[k].word, n))) ++k;
    if (k == EFFECTS)
      return slab_fail(error, SLAB_BAD,
                       "%s: \"%.*s\" is no effect; there are: %s %s %s %s, all and none", source,
                       (int)n, at, table[0].word, table[1].word, table[2].word, table[3].word);
    effects->level[k] = table[k].usual;
    at += n;
  }
  return SLAB_OK;
}

bool effects_any(const struct effects *effects) {
  for (int k = 0; k < EFFECTS; ++k)
    if (effects->level[k]) return true;
  return false;
}

void effects_declare(const struct effects *effects, FILE *scene) {
  const char *blank = "";
  fputs("#declare Canned_Bake_Effects = \"", scene);
  for (int k = 0; k < EFFECTS; ++k) {
    if (!effects->level[k]) continue;
    fprintf(scene, "%s%s", blank, table[k].word);
    blank = " ";
  }
  fputs("\";\n", scene);
  for (int k = 0; k < EFFECTS; ++k)
    if (effects->level[k])
      fprintf(scene, "#declare %s = %d;\n", table[k].variable,
              effect_setting((enum effect)k, effects->level[k]));
}
