#include "cli/values.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/numbers.h"

/* An option as its message begins: "--jobs 0: must be". */
struct said {
  const struct argp_option *option;
  const char *text;
  struct argp_state *state;
};

__attribute__((format(printf, 2, 3))) static void refuse(const struct said *said,
                                                         const char *format, ...) {
  char must[160];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(must, sizeof must, format, arguments);
  va_end(arguments);
  argp_error(said->state, "--%s %s: must be %s", said->option->name, said->text, must);
}

static double take_real(const struct value *value, const struct said *said) {
  double number = NAN;
  bool read = numbers_real(said->text, 1, &number);
  if (value->kind == VALUE_POSITIVE) {
    if (!read || !(number > 0)) refuse(said, "a positive number");
  } else if (!read || !(number >= value->low && number <= value->high)) {
    if (isfinite(value->high))
      refuse(said, "a number from %g to %g", value->low, value->high);
    else
      refuse(said, "a number from %g on", value->low);
  }
  return number;
}

static int take_whole(const struct value *value, const struct said *said) {
  uint64_t number = 0;
  if (!numbers_whole(said->text, (uint64_t)value->low, (uint64_t)value->high, &number))
    refuse(said, "a whole number from %.0f to %.0f", value->low, value->high);
  return (int)number;
}

/* Which of the words, from 0. */
static int take_word(const struct said *said) {
  const char *words = said->option->arg;
  for (int number = 0;; ++number) {
    size_t length = strcspn(words, "|");
    if (strlen(said->text) == length && !strncmp(said->text, words, length)) return number;
    if (!words[length]) break;
    words += length + 1;
  }
  refuse(said, "one of %s", said->option->arg);
  return 0;
}

static void take(const struct value *value, const struct said *said, void *to) {
  switch (value->kind) {
  case VALUE_EITHER:
    *(bool *)to = take_word(said) == 1;
    return;
  case VALUE_FLAG:
    *(bool *)to = true;
    return;
  case VALUE_TEXT:
    *(const char **)to = said->text;
    return;
  case VALUE_REAL:
  case VALUE_POSITIVE:
    *(double *)to = take_real(value, said);
    return;
  case VALUE_WORD:
    *(int *)to = (int)value->low + take_word(said);
    return;
  case VALUE_WHOLE:
    *(int *)to = take_whole(value, said);
    return;
  case VALUE_SIZE:
    if (!numbers_size(said->text, to))
      refuse(said, "%s, each from 1 to %d", said->option->arg, NUMBERS_MOST_SIZE);
  }
}

error_t values_take(const struct value *values, const struct argp_option *options, int key,
                    const char *text, void *into, struct argp_state *state) {
  while (values->kind && values->key != key) ++values;
  if (!values->kind) return ARGP_ERR_UNKNOWN;
  while (options->key != key) ++options;
  const struct said said = {options, text, state};
  take(values, &said, (char *)into + values->offset);
  return 0;
}
