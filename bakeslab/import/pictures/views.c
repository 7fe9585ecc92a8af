#include "import/pictures/views.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A conversion at `at`: %u or %v, with a number of digits; NULL: none. */
static const char *read_conversion(const char *at, int *axis, int *digits) {
  char *end = NULL;
  *digits = 0;
  if (*at != '%') return NULL;
  if (isdigit((unsigned char)at[1])) {
    long number = strtol(at + 1, &end, 10);
    if (number > 9) return NULL;
    *digits = (int)number;
  }
  at = end ? end : at + 1;
  if (*at != 'u' && *at != 'v') return NULL;
  *axis = *at == 'v';
  return at + 1;
}

enum result views_check(const char *pattern, struct error *error) {
  int count[2] = {0, 0}, axis, digits;
  const char *slash = strrchr(pattern, '/');
  for (const char *at = pattern; *at;) {
    const char *end = read_conversion(at, &axis, &digits);
    if (*at == '%' && (!end || at < slash))
      return result_fail(error, RESULT_BAD,
                         "the pattern must have %%u and %%v, as in view_%%02u_%%02v.exr, in the "
                         "file's name, and no other %%");
    if (end) ++count[axis];
    at = end ? end : at + 1;
  }
  if (count[0] == 1 && count[1] == 1) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "the pattern must have one %%u and one %%v, as in view_%%02u_%%02v.exr");
}

char *views_name(const char *pattern, int i, int j) {
  char *name = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&name, &size);
  if (!out) return NULL;
  for (const char *at = pattern; *at;) {
    int axis, digits;
    const char *end = read_conversion(at, &axis, &digits);
    if (end)
      fprintf(out, "%0*d", digits, axis ? j : i);
    else
      putc(*at, out);
    at = end ? end : at + 1;
  }
  if (fclose(out) == 0) return name;
  free(name);
  return NULL;
}

/* Whether a name fits the pattern (without folder), and which view it is. Where two numbers stand
 * side by side, all ways to part them are tried. */
static bool fits(const char *pattern, const char *name, int at[2]) {
  int axis, digits, number = 0;
  const char *end = read_conversion(pattern, &axis, &digits);
  if (!end) return *pattern == *name && (!*pattern || fits(pattern + 1, name + 1, at));
  for (int length = 1; isdigit((unsigned char)name[length - 1]); ++length) {
    number = 10 * number + (name[length - 1] - '0');
    if (number >= VIEWS_MOST) return false;
    at[axis] = number;
    bool whole = length == (digits > 1 ? digits : 1) || (length > digits && name[0] != '0');
    if (whole && fits(end, name + length, at)) return true;
  }
  return false;
}

enum result views_count(const char *pattern, int count[2], struct error *error) {
  const char *slash = strrchr(pattern, '/'), *base = slash ? slash + 1 : pattern;
  char *folder = slash ? strndup(pattern, (size_t)(slash - pattern) + 1) : strdup(".");
  if (!folder) return result_no_memory(error);
  DIR *directory = opendir(folder);
  int at[2] = {0, 0};
  enum result result = RESULT_OK;
  count[0] = count[1] = 0;
  if (!directory) result = result_fail(error, RESULT_IO, "%s: %s", folder, strerror(errno));
  for (struct dirent *entry; directory && (entry = readdir(directory));)
    if (fits(base, entry->d_name, at))
      for (int axis = 0; axis < 2; ++axis)
        if (at[axis] >= count[axis]) count[axis] = at[axis] + 1;
  if (result == RESULT_OK && count[0] == 0)
    result = result_fail(error, RESULT_BAD, "no file in %s has such a name", folder);
  if (directory) closedir(directory);
  free(folder);
  return result;
}
