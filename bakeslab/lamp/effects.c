#include "lamp/effects.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_STEPS = 6, MOST_SETTING = 100000000 };

/* `variable` passes the setting to canned.inc. */
static const struct {
  const char *word, *variable;
  int ladder[MOST_STEPS];
  int usual;
} table[EFFECTS] = {
    [INTERREFLECTION] = {"interreflection", "Canned_Bake_Bounces", {1, 2, 3, 4, 5}, 2},
    [CAUSTICS] = {"caustics", "Canned_Bake_Photons", {100000, 400000, 1600000}, 400000},
    [EXTENDED_SOURCE] = {"extended_source", "Canned_Bake_Source_Lights", {5, 9, 17}, 17},
    [DEEP_TRACE] = {"deep_trace", "Canned_Bake_Trace_Level", {30, 60, 120}, 30},
};

const char *effect_word(enum effect effect) {
  return table[effect].word;
}

const int *effect_ladder(enum effect effect) {
  return table[effect].ladder;
}

/* The setting in "=N" or, before the next word, the usual one; 0 for anything else. */
static int parse_setting(const char *text, int usual) {
  char *end;
  if (!strchr(" ,=", *text)) return 0;
  if (*text != '=') return usual;
  long value = strtol(text + 1, &end, 10);
  bool good = end > text + 1 && strchr(" ,", *end) && value >= 1 && value <= MOST_SETTING;
  return good ? (int)value : 0;
}

enum result effects_parse(const char *text, const char *source, struct effects *effects,
                          struct error *error) {
  *effects = (struct effects){.named = strcmp(text, "all") != 0};
  for (int k = 0; k < EFFECTS; ++k) effects->setting[k] = effects->named ? 0 : table[k].usual;
  if (!effects->named || !strcmp(text, "none")) return RESULT_OK;
  for (const char *at = text; *(at += strspn(at, " ,")); at += strcspn(at, " ,")) {
    int k = 0;
    size_t n = strcspn(at, " ,=");
    while (k < EFFECTS && (strlen(table[k].word) != n || strncmp(at, table[k].word, n))) ++k;
    if (k == EFFECTS)
      return result_fail(error, RESULT_BAD,
                         "%s: \"%.*s\" is no effect; there are: %s %s %s %s, all and none", source,
                         (int)n, at, table[0].word, table[1].word, table[2].word, table[3].word);
    effects->setting[k] = parse_setting(at + n, table[k].usual);
    if (!effects->setting[k])
      return result_fail(error, RESULT_BAD, "%s: \"%.*s\": no whole number from 1 on", source,
                         (int)strcspn(at, " ,"), at);
  }
  return RESULT_OK;
}

bool effects_any(const struct effects *effects) {
  for (int k = 0; k < EFFECTS; ++k)
    if (effects->setting[k]) return true;
  return false;
}

void effects_declare(const struct effects *effects, FILE *scene) {
  const char *blank = "";
  fputs("#declare Canned_Bake_Effects = \"", scene);
  for (int k = 0; k < EFFECTS; ++k) {
    if (!effects->setting[k]) continue;
    fprintf(scene, "%s%s", blank, table[k].word);
    blank = " ";
  }
  fputs("\";\n", scene);
  for (int k = 0; k < EFFECTS; ++k)
    if (effects->setting[k])
      fprintf(scene, "#declare %s = %d;\n", table[k].variable, effects->setting[k]);
}
