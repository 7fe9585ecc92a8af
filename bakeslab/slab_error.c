/* slab_error.c - formats the one line of slab_error.h. */
#include "slab_error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void slab_one_line(char *text) {
  for (; *text; ++text)
    if (*text == '\n' || *text == '\r') *text = ' ';
}

enum slab_result slab_fail(struct slab_error *error, enum slab_result result, const char *format,
                           ...) {
  if (error) {
    char text[sizeof error->text]; /* the old text may be among the arguments */
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    slab_one_line(text);
    memcpy(error->text, text, sizeof text);
  }
  return result;
}
