/* slab_error.c - formats the one line of slab_error.h. */
#include "slab_error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum slab_result slab_fail(struct slab_error *error, enum slab_result result, const char *format,
                           ...) {
  if (error) {
    char text[sizeof error->text]; /* the old text may be among the arguments */
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *c = text; *c; ++c)
      if (*c == '\n' || *c == '\r') *c = ' ';
    memcpy(error->text, text, sizeof text);
  }
  return result;
}
