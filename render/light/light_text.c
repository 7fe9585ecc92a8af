#include "light/light_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/kelvin.h"
#include "base/key_values.h"
#include "base/numbers.h"

enum { OWN_KEYS = 9, CHANNEL_FORM = SLAB_CHANNEL_SIZE + 16 };

/* Where the file's name ends: before the first KEY=VALUE. */
static const char *end_of_path(const char *text) {
  const char *end = text;
  for (const char *word = text; *word; word = end + strspn(end, NUMBERS_BLANKS)) {
    if (word > text && key_values_key(word) > 0) break;
    end = word + strcspn(word, NUMBERS_BLANKS);
  }
  return end;
}

/* What is said of brightness and colour. `keys` are those of lumens, kelvin, metres and gain. */
static enum result check_brightness(const char *what, const struct light_text *light,
                                    const struct key_value keys[4], struct error *error) {
  if (keys[0].seen && !(light->lumens > 0))
    return result_fail(error, RESULT_BAD, "%s: lumens=%g, must be positive", what, light->lumens);
  if (keys[1].seen && !(light->kelvin >= KELVIN_LEAST && light->kelvin <= KELVIN_MOST))
    return result_fail(error, RESULT_BAD, "%s: kelvin=%g, must be from %d to %d", what,
                       light->kelvin, KELVIN_LEAST, KELVIN_MOST);
  if (keys[2].seen && !(light->metres > 0))
    return result_fail(error, RESULT_BAD, "%s: metres=%g, must be positive", what, light->metres);
  if (keys[2].seen && !keys[0].seen)
    return result_fail(error, RESULT_BAD, "%s: metres= is the unit for lumens=, which is missing",
                       what);
  if (keys[0].seen && keys[3].seen)
    return result_fail(error, RESULT_BAD, "%s: lumens= and gain=: give one of them", what);
  return RESULT_OK;
}

static enum result check(const char *what, const struct light_text *light, struct error *error) {
  if (light->has_matrix && (light->has_at || light->has_toward || light->has_up))
    return result_fail(error, RESULT_BAD, "%s: matrix= excludes at=, toward= and up=", what);
  if (!(light->scale > 0))
    return result_fail(error, RESULT_BAD, "%s: scale=%g, must be positive", what, light->scale);
  for (int n = 0; n < light->channel_count; ++n)
    if (light->channels[n].gain < 0)
      return result_fail(error, RESULT_BAD, "%s: gain.%s=%g, must not be negative", what,
                         light->channels[n].name, light->channels[n].gain);
  return RESULT_OK;
}

/* Makes a key of each word gain.NAME=. The words themselves are read later, with all others. */
static enum result find_channels(const char *what, const char *text, struct light_text *light,
                                 char forms[LIGHT_CHANNELS][CHANNEL_FORM], struct key_value *keys,
                                 struct error *error) {
  static const char prefix[] = "gain.";
  for (const char *word = text + strspn(text, NUMBERS_BLANKS); *word;) {
    size_t key = key_values_key(word), start = strlen(prefix);
    if (key > start + 1 && !strncmp(word, prefix, start)) {
      struct light_channel *channel = &light->channels[light->channel_count];
      int length = (int)(key - start) - 1, n = 0;
      if (light->channel_count == LIGHT_CHANNELS || length >= SLAB_CHANNEL_SIZE)
        return result_fail(error, RESULT_BAD, "%s: '%.*s' is one channel too many, or too long",
                           what, (int)key - 1, word);
      snprintf(channel->name, sizeof channel->name, "%.*s", length, word + start);
      while (strcmp(light->channels[n].name, channel->name) != 0) ++n;
      if (n == light->channel_count) { /* else it is there twice, as its key finds out */
        ++light->channel_count;
        snprintf(forms[n], CHANNEL_FORM, "gain.%s=G", channel->name);
        keys[n] = (struct key_value){forms[n], 1, &channel->gain, false, false};
      }
    }
    word += strcspn(word, NUMBERS_BLANKS);
    word += strspn(word, NUMBERS_BLANKS);
  }
  return RESULT_OK;
}

enum result light_text_parse(const char *text, struct light_text *light, struct error *error) {
  *light = (struct light_text){.scale = 1, .gain = {1, 1, 1}, .up = {0, 1, 0}};
  char forms[LIGHT_CHANNELS][CHANNEL_FORM];
  struct key_value keys[OWN_KEYS + LIGHT_CHANNELS] = {
      {"at=X,Y,Z", 3, light->at, false, false},
      {"toward=X,Y,Z", 3, light->toward, false, false},
      {"up=X,Y,Z", 3, light->up, false, false},
      {"matrix=12 numbers", 12, light->matrix[0], false, false},
      {"scale=S", 1, &light->scale, false, false},
      {"lumens=L", 1, &light->lumens, false, false},
      {"kelvin=K", 1, &light->kelvin, false, false},
      {"metres=M", 1, &light->metres, false, false},
      {"gain=G|R,G,B", 3, light->gain, false, true}};
  char what[256];
  snprintf(what, sizeof what, "--light %s", text);
  text += strspn(text, NUMBERS_BLANKS);
  const char *end = end_of_path(text);
  if (end == text) return result_fail(error, RESULT_BAD, "%s: names no slab", what);
  light->path = strndup(text, (size_t)(end - text));
  if (!light->path) return result_no_memory(error);
  enum result result = find_channels(what, end, light, forms, keys + OWN_KEYS, error);
  if (result == RESULT_OK)
    result = key_values_parse(what, end, keys, OWN_KEYS + light->channel_count, error);
  light->has_at = keys[0].seen;
  light->has_toward = keys[1].seen;
  light->has_up = keys[2].seen;
  light->has_matrix = keys[3].seen;
  if (result == RESULT_OK) result = check(what, light, error);
  if (result == RESULT_OK) result = check_brightness(what, light, keys + 5, error);
  if (result != RESULT_OK) light_text_free(light);
  return result;
}

void light_text_free(struct light_text *light) {
  free(light->path);
  *light = (struct light_text){0};
}
