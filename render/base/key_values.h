/* key_values.h - texts of words KEY=NUMBER[,NUMBER...], as `--light` and `--camera` take them. A
 * key is of small letters; a part after a dot may have capitals, digits and _. */
#ifndef KEY_VALUES_H
#define KEY_VALUES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/result.h"

struct key_value {
  const char *form; /* KEY=..., as users are told */
  int count;        /* of numbers */
  double *numbers;
  bool seen;   /* set by key_values_parse */
  bool colour; /* one number stands for all three */
};

/* The length of KEY= at the start of the text; 0: there is none. */
size_t key_values_key(const char *text);

/* Fills the numbers of the keys that the words name. Refuses unknown keys, keys that are there
 * twice and numbers that are not finite; `what` names the whole text in messages. */
enum result key_values_parse(const char *what, const char *text, struct key_value *keys, int count,
                             struct error *error);

#endif
