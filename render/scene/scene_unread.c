/* scene_unread.c - what a mesh asks for and we do not do; and files beside it. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "scene/scene_load.h"

char *scene_beside(const char *path, const char *name) {
  const char *slash = strrchr(path, '/');
  int length = slash && name[0] != '/' ? (int)(slash - path) + 1 : 0;
  char *joined;
  return asprintf(&joined, "%.*s%s", length, path, name) < 0 ? NULL : joined;
}

enum result scene_unread(struct scene_loading *loading, struct error *error, const char *format,
                         ...) {
  ++loading->unread;
  if (loading->repair) return RESULT_OK;
  char what[768];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(what, sizeof what, format, arguments);
  va_end(arguments);
  return result_fail(error, RESULT_BAD, "%s, which is not supported; --repair ignores it", what);
}
