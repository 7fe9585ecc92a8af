/* values.h - what options say: a table tells for each what it may say and where that goes.
 *
 * A command's argp parser hands values_take the keys that it does not look at itself:
 *
 *   static const struct value values[] = {
 *       {'j', VALUE_WHOLE, offsetof(struct arguments, jobs), 1, 1024},
 *       {VALUE_KEY(struct arguments, dry), VALUE_FLAG, offsetof(struct arguments, dry), 0, 0},
 *       {0}};
 *   ...
 *   default: return values_take(values, options, key, text, arguments, state); */
#ifndef VALUES_H
#define VALUES_H

#include <argp.h>
#include <stddef.h>

/* The key of an option without a letter, by the member that it sets: other members, other keys. */
#define VALUE_KEY(type, member) (256 + (int)offsetof(type, member))

/* Into what, of which type, at the offset. */
enum value_kind {
  VALUE_FLAG = 1, /* bool: true */
  VALUE_TEXT,     /* const char *: the text, which argv owns */
  VALUE_REAL,     /* double: from low to high, INFINITY for no end */
  VALUE_POSITIVE, /* double: above 0 */
  VALUE_WHOLE,    /* int: from low to high */
  VALUE_SIZE,     /* int[2]: NxM, as numbers_size */
  VALUE_WORD,     /* int: low + the number of a word among those of the option's `arg`, "a|b|c" */
  VALUE_EITHER    /* bool: the second of two such words */
};

struct value {
  int key; /* of the option */
  enum value_kind kind;
  size_t offset; /* in what values_take fills */
  double low, high;
};

/* Puts what the option `key` says into the struct at `into`. `values` ends with a zero row,
 * `options` is argp's table. Ends in argp_error, naming the option, where that is not allowed;
 * returns ARGP_ERR_UNKNOWN where no row has the key. */
error_t values_take(const struct value *values, const struct argp_option *options, int key,
                    const char *text, void *into, struct argp_state *state);

#endif
