/* include_fill.h - fills a template with a lamp's name and numbers.
 *
 * A template, X.inc.in, is a text for POV-Ray in which
 *   @          stands for the lamp's name;
 *   @{key}     for a value: a number as %.15g unless told otherwise, as in @{key:.3g};
 *   @{key[2]}  for one of several numbers;
 *   @{if key}  leaves out the rest of its line, or all of it where it stands at the line's
 *              start, if the value is 0 or no text.
 * Each line ends with a line end; the last one's is left to the line that asked for the text.
 * base/embed.sh makes of X.inc.in the program's array X_inc. */
#ifndef INCLUDE_FILL_H
#define INCLUDE_FILL_H

#include <stdio.h>

/* A key, and what it stands for: the first of these that is not NULL, or the number. Lists
 * end with a value that has no key; it may have `more`, another list. */
struct include_value {
  const char *key;
  const char *part; /* a template, filled with the same values */
  const char *text;
  void (*write)(const char *text, FILE *out); /* how it is written; NULL: as it is */
  void (*print)(const void *of, FILE *out);   /* without the last line end */
  const void *of;
  const double *numbers;
  double number;
  const struct include_value *more;
};

/* A key without a value stays in the text as it is. The caller checks the stream. */
void include_fill(const char *template, const char *name, const struct include_value *values,
                  FILE *out);

#endif
