/* effects.c - see effects.h. */
#include "effects.h"

#include <string.h>

const char effects_all[] = "interreflection caustics extended_source deep_trace";

/* Whether the list, separated by blanks or commas, holds the word of this length. */
static bool listed(const char *list, const char *word, size_t length) {
  for (const char *at = list; *(at += strspn(at, " ,"));) {
    size_t n = strcspn(at, " ,");
    if (n == length && !strncmp(at, word, n)) return true;
    at += n;
  }
  return false;
}

bool effects_has(const struct effects *effects, const char *word) {
  return listed(effects->words, word, strlen(word));
}

enum slab_result effects_parse(const char *text, const char *source, struct effects *effects,
                               struct slab_error *error) {
  *effects = (struct effects){.named = strcmp(text, "all") != 0};
  if (!effects->named) text = effects_all;
  if (!strcmp(text, "none")) text = "";
  for (const char *at = text; *(at += strspn(at, " ,"));) {
    size_t n = strcspn(at, " ,");
    if (!listed(effects_all, at, n))
      return slab_fail(error, SLAB_BAD, "%s: \"%.*s\" is no effect; there are: %s", source, (int)n,
                       at, effects_all);
    at += n;
  }
  for (const char *at = effects_all; *(at += strspn(at, " "));) {
    size_t n = strcspn(at, " ");
    if (listed(text, at, n)) {
      if (effects->words[0]) strcat(effects->words, " ");
      strncat(effects->words, at, n);
    }
    at += n;
  }
  return SLAB_OK;
}
