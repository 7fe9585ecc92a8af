/* housing.c - see housing.h. Reads just enough of POV-Ray's language: comments, strings,
 * braces, and #declare. */
#include "housing.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files.h"

/* The end of the comment or string that starts at `at`, or `at` where none does. */
static const char *skip_quiet(const char *at) {
  if (at[0] == '/' && at[1] == '/') return at + strcspn(at, "\n");
  if (at[0] == '/' && at[1] == '*') {
    const char *end = strstr(at + 2, "*/");
    return end ? end + 2 : at + strlen(at);
  }
  if (at[0] != '"') return at;
  for (++at; *at && *at != '"'; ++at)
    if (*at == '\\' && at[1]) ++at;
  return *at ? at + 1 : at;
}

static const char *skip_blanks(const char *at) {
  for (;;) {
    const char *after = at + strspn(at, " \t\r\n");
    if (*after == '/') after = skip_quiet(after);
    if (after == at) return at;
    at = after;
  }
}

static size_t name_length(const char *at) {
  size_t n = 0;
  while (isalnum((unsigned char)at[n]) || at[n] == '_') ++n;
  return n;
}

/* The end of a value: after the ; of an expression, or after the brace that closes the
 * first one opened. *has_braces tells which it was. */
static const char *skip_value(const char *at, bool *has_braces) {
  int depth = 0;
  *has_braces = false;
  while (*at) {
    const char *after = skip_quiet(at);
    if (after != at) {
      at = after;
      continue;
    }
    if (*at == '{') {
      ++depth;
      *has_braces = true;
    }
    if (*at == '}' && --depth <= 0) return at + 1;
    if (depth == 0 && (*at == ';' || *at == '#')) return *at == ';' ? at + 1 : at;
    ++at;
  }
  return at;
}

char *housing_find(const char *script) {
  static const char wanted[] = "Canned_Housing", declare[] = "#declare";
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  bool found = false;
  for (const char *at = script; *at && !found;) {
    const char *after = skip_quiet(at);
    if (after != at || strncmp(at, declare, strlen(declare)) != 0) {
      at = after != at ? after : at + 1;
      continue;
    }
    const char *name = skip_blanks(at + strlen(declare));
    size_t length = name_length(name);
    at = skip_blanks(name + length);
    if (*at != '=') continue;
    const char *value = skip_blanks(at + 1);
    bool has_braces;
    at = skip_value(value, &has_braces);
    found = length == strlen(wanted) && !strncmp(name, wanted, length);
    if (found)
      fprintf(out, "%.*s", (int)(at - value), value);
    else if (!has_braces && at > value && at[-1] == ';')
      fprintf(out, "#local %.*s = %.*s\n", (int)length, name, (int)(at - value), value);
  }
  if (fclose(out) != 0 || !found) {
    free(text);
    return NULL;
  }
  return text;
}

bool housing_parses(const struct povray *povray, const char *housing, const char *directory) {
  struct povray_job job = {.directory = directory, .width = 4, .height = 4, .frames = 1};
  char *scene = NULL;
  if (asprintf(&scene,
               "#version 3.7;\n#macro Housing()\n%s\n#end\nobject { Housing() }\n"
               "camera { location -z direction z }\n",
               housing) < 0)
    return false;
  files_remove_tree(directory);
  bool parses = !files_make_directory(directory, NULL) &&
                !files_write(directory, "scene.pov", scene, NULL) &&
                !povray_run(povray, &job, NULL);
  files_remove_tree(directory);
  free(scene);
  return parses;
}
