/* light_text.c - see light_text.h. */
#include "light_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* `count` finite numbers with commas between them, up to `end`. */
static bool parse_numbers(const char *text, const char *end, int count, double *numbers) {
  for (int k = 0; k < count; ++k) {
    char *after;
    if (text >= end) return false;
    numbers[k] = strtod(text, &after);
    if (after == text || after > end || !isfinite(numbers[k])) return false;
    text = after;
    if (k + 1 < count && *text++ != ',') return false;
  }
  return text == end;
}

struct key {
  const char *name;
  int count;
  double *numbers;
  bool *seen;
};

static const char *skip_blanks(const char *text) {
  return text + strspn(text, " \t\r\n");
}

/* The length of the name of a KEY= at the start of the text; 0 where there is none. */
static size_t key_length(const char *text) {
  size_t length = strspn(text, "abcdefghijklmnopqrstuvwxyz");
  return text[length] == '=' ? length : 0;
}

static const char *end_of_path(const char *text) {
  const char *end = text;
  for (const char *word = skip_blanks(text); *word; word = skip_blanks(end)) {
    if (word > text && key_length(word) > 0) break;
    end = word + strcspn(word, " \t\r\n");
  }
  return end;
}

static enum slab_result parse_key(const char *text, const char *word, const char *end,
                                  const struct key *keys, struct slab_error *error) {
  size_t length = key_length(word);
  for (const struct key *key = keys; key->name; ++key) {
    if (strlen(key->name) != length || strncmp(key->name, word, length) != 0) continue;
    if (*key->seen) return slab_fail(error, SLAB_BAD, "--light %s: %s= twice", text, key->name);
    *key->seen = true;
    if (parse_numbers(word + length + 1, end, key->count, key->numbers)) return SLAB_OK;
    return slab_fail(error, SLAB_BAD, "--light %s: %s= takes %d finite number%s%s", text, key->name,
                     key->count, key->count > 1 ? "s" : "",
                     key->count > 1 ? " with commas between them" : "");
  }
  return slab_fail(error, SLAB_BAD,
                   "--light %s: `%.*s' is none of at=, toward=, up=, matrix=, scale= and gain=",
                   text, (int)(end - word), word);
}

static enum slab_result check(const char *text, const struct light_text *light,
                              struct slab_error *error) {
  if (light->has_matrix && (light->has_at || light->has_toward || light->has_up))
    return slab_fail(error, SLAB_BAD, "--light %s: matrix= excludes at=, toward= and up=", text);
  if (!(light->scale > 0))
    return slab_fail(error, SLAB_BAD, "--light %s: scale=%g, must be positive", text, light->scale);
  return SLAB_OK;
}

enum slab_result light_text_parse(const char *text, struct light_text *light,
                                  struct slab_error *error) {
  bool scale = false, gain = false;
  *light = (struct light_text){.scale = 1, .gain = 1, .up = {0, 1, 0}};
  const struct key keys[] = {{"at", 3, light->at, &light->has_at},
                             {"toward", 3, light->toward, &light->has_toward},
                             {"up", 3, light->up, &light->has_up},
                             {"matrix", 12, light->matrix[0], &light->has_matrix},
                             {"scale", 1, &light->scale, &scale},
                             {"gain", 1, &light->gain, &gain},
                             {NULL, 0, NULL, NULL}};
  text = skip_blanks(text);
  const char *end = end_of_path(text);
  if (end == text) return slab_fail(error, SLAB_BAD, "--light: names no slab");
  light->path = strndup(text, (size_t)(end - text));
  if (!light->path) return slab_fail(error, SLAB_MEMORY, "out of memory");
  enum slab_result result = SLAB_OK;
  for (const char *word = skip_blanks(end); *word && result == SLAB_OK; word = skip_blanks(end)) {
    end = word + strcspn(word, " \t\r\n");
    result = parse_key(text, word, end, keys, error);
  }
  if (result == SLAB_OK) result = check(text, light, error);
  if (result != SLAB_OK) light_text_free(light);
  return result;
}

void light_text_free(struct light_text *light) {
  free(light->path);
  *light = (struct light_text){0};
}
