#include "base/key_values.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/numbers.h"

size_t key_values_key(const char *text) {
  size_t length = strspn(text, "abcdefghijklmnopqrstuvwxyz");
  if (length > 0 && text[length] == '.') do
      ++length;
    while (isalnum((unsigned char)text[length]) || text[length] == '_');
  return length > 0 && text[length] == '=' ? length + 1 : 0;
}

static struct key_value *find(struct key_value *keys, int count, const char *word) {
  size_t length = key_values_key(word);
  for (int k = 0; k < count && length > 0; ++k)
    if (!strncmp(keys[k].form, word, length)) return &keys[k];
  return NULL;
}

static enum result unknown(const char *what, const char *word, int length,
                           const struct key_value *keys, int count, struct error *error) {
  char known[256] = "";
  size_t used = 0;
  for (int k = 0; k < count && used < sizeof known; ++k)
    used += (size_t)snprintf(known + used, sizeof known - used, " %s", keys[k].form);
  return result_fail(error, RESULT_BAD, "%s: '%.*s' is none of%s", what, length, word, known);
}

/* The numbers of the word that ends there. */
static bool read_numbers(const struct key_value *key, const char *word, const char *end) {
  const char *numbers = word + key_values_key(word);
  if (numbers_read(numbers, ',', key->count, key->numbers) == end) return true;
  if (!key->colour || numbers_read(numbers, ',', 1, key->numbers) != end) return false;
  key->numbers[1] = key->numbers[2] = key->numbers[0];
  return true;
}

enum result key_values_parse(const char *what, const char *text, struct key_value *keys, int count,
                             struct error *error) {
  for (const char *word = text + strspn(text, NUMBERS_BLANKS); *word;) {
    int length = (int)strcspn(word, NUMBERS_BLANKS);
    struct key_value *key = find(keys, count, word);
    if (!key) return unknown(what, word, length, keys, count, error);
    if (key->seen) return result_fail(error, RESULT_BAD, "%s: %s is there twice", what, key->form);
    if (!read_numbers(key, word, word + length))
      return result_fail(error, RESULT_BAD, "%s: '%.*s' is not %s with finite numbers", what,
                         length, word, key->form);
    key->seen = true;
    word += length;
    word += strspn(word, NUMBERS_BLANKS);
  }
  return RESULT_OK;
}
