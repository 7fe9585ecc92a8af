#include "base/result.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void result_one_line(char *text) {
  for (; *text; ++text)
    if (*text == '\n' || *text == '\r') *text = ' ';
}

enum result result_fail(struct error *error, enum result result, const char *format, ...) {
  if (!error) return result;
  char text[sizeof error->text]; /* the old text may be among the arguments */
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  result_one_line(text);
  memcpy(error->text, text, sizeof text);
  return result;
}

enum result result_no_memory(struct error *error) {
  return result_fail(error, RESULT_MEMORY, "out of memory");
}

enum result result_at(enum result result, struct error *error, const char *format, ...) {
  if (result == RESULT_OK || !error) return result;
  char place[sizeof error->text];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(place, sizeof place, format, arguments);
  va_end(arguments);
  return result_fail(error, result, "%s: %s", place, error->text);
}
