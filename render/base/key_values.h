/* key_values.h - texts of words KEY=NUMBER[,NUMBER...], as `--light` and `--camera` take them, and
 * the numbers in them. */
#ifndef KEY_VALUES_H
#define KEY_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/result.h"

/* What separates words. */
#define WORDS_BLANKS " \t\r\n"

/* The text starts with one finite number; where it ends. */
bool key_values_number_at(const char *text, const char **end, double *number);

/* `count` finite numbers with commas between them, up to a blank or the end. */
bool key_values_numbers(const char *text, int count, double *numbers);

struct word_key {
  const char *form; /* KEY=..., as users are told */
  int count;
  double *numbers;
  bool seen; /* set by key_values_parse */
};

/* The length of KEY= at the start of the text, 0 where there is none. */
size_t key_values_key(const char *text);

/* Fills the numbers of the keys that the words name. `what` names the whole text in messages,
 * which tell a word that is no key, twice the same, and numbers that are none. */
enum result key_values_parse(const char *what, const char *text, struct word_key *keys, int count,
                             struct error *error);

#endif
