/* key_values.c - see key_values.h. */
#include "base/key_values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool key_values_number_at(const char *text, const char **end, double *number) {
  char *after;
  if (strchr(WORDS_BLANKS, *text)) return false; /* strtod would skip it; \0 too */
  *number = strtod(text, &after);
  *end = after;
  return after > text && isfinite(*number);
}

bool key_values_numbers(const char *text, int count, double *numbers) {
  for (int k = 0; k < count; ++k) {
    if (k > 0 && *text++ != ',') return false;
    if (!key_values_number_at(text, &text, &numbers[k])) return false;
  }
  return strchr(WORDS_BLANKS, *text) != NULL;
}

size_t key_values_key(const char *text) {
  size_t length = strspn(text, "abcdefghijklmnopqrstuvwxyz");
  return length > 0 && text[length] == '=' ? length + 1 : 0;
}

static struct word_key *find(struct word_key *keys, int count, const char *word) {
  size_t length = key_values_key(word);
  for (int k = 0; k < count && length > 0; ++k)
    if (!strncmp(keys[k].form, word, length)) return &keys[k];
  return NULL;
}

static enum result unknown(const char *what, const char *word, int length,
                           const struct word_key *keys, int count, struct error *error) {
  char known[256] = "";
  size_t used = 0;
  for (int k = 0; k < count && used < sizeof known; ++k)
    used += (size_t)snprintf(known + used, sizeof known - used, " %s", keys[k].form);
  return result_fail(error, RESULT_BAD, "%s: '%.*s' is none of%s", what, length, word, known);
}

enum result key_values_parse(const char *what, const char *text, struct word_key *keys, int count,
                             struct error *error) {
  for (const char *word = text + strspn(text, WORDS_BLANKS); *word;) {
    int length = (int)strcspn(word, WORDS_BLANKS);
    struct word_key *key = find(keys, count, word);
    if (!key) return unknown(what, word, length, keys, count, error);
    if (key->seen) return result_fail(error, RESULT_BAD, "%s: %s is there twice", what, key->form);
    if (!key_values_numbers(word + key_values_key(word), key->count, key->numbers))
      return result_fail(error, RESULT_BAD, "%s: '%.*s' is not %s with finite numbers", what,
                         length, word, key->form);
    key->seen = true;
    word += length;
    word += strspn(word, WORDS_BLANKS);
  }
  return RESULT_OK;
}
