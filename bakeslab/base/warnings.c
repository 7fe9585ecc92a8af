#include "base/warnings.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/result.h"

int warnings_kept(const struct warnings *warnings) {
  return warnings->count < WARNINGS_KEPT ? warnings->count : WARNINGS_KEPT;
}

void warnings_add(struct warnings *warnings, const char *format, ...) {
  char line[WARNING_LINE];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  result_one_line(line);
  int kept = warnings_kept(warnings);
  for (int n = 0; n < kept; ++n)
    if (!strcmp(warnings->lines[n], line)) return;
  if (kept < WARNINGS_KEPT) memcpy(warnings->lines[kept], line, sizeof line);
  ++warnings->count;
  if (warnings->tell) warnings->tell(line);
}
