#include "pov/pov_include.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* "DIR/LAMP.inc" for "DIR/LAMP.tif", allocated; NULL without memory. */
static char *with_suffix(const char *path, const char *suffix) {
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
  const char *dot = strrchr(base, '.');
  size_t length = dot && dot > base ? (size_t)(dot - path) : strlen(path);
  char *changed;
  return asprintf(&changed, "%.*s%s", (int)length, path, suffix) < 0 ? NULL : changed;
}

/* The name in "#macro NAME_Canned(Scale, Gain)", which may differ from the slab's (bakeslab
 * include --name), and whether its face is declared, in any order. False where there is no name. */
static bool find_macros(FILE *file, struct pov_include *include) {
  static const char start[] = "#macro ", end[] = "_Canned(Scale, Gain)",
                    face[] = "_Canned_Face(Scale, Gain, Eye)";
  char *line = NULL;
  size_t room = 0;
  bool found = false;
  while (getline(&line, &room, file) >= 0) {
    if (strncmp(line, start, sizeof start - 1)) continue;
    const char *from = line + sizeof start - 1, *to = strstr(from, end);
    size_t length = to ? (size_t)(to - from) : 0;
    include->face |= strstr(from, face) != NULL;
    if (found || length == 0 || length >= sizeof include->name) continue;
    memcpy(include->name, from, length);
    include->name[length] = 0;
    found = true;
  }
  free(line);
  return found;
}

static enum result read_include(const struct light *light, struct pov_include *include,
                                struct error *error) {
  const char *path = include->path;
  if (!strcmp(light->path, include->image))
    return result_fail(error, RESULT_BAD,
                       "%s: the image of its include would have this name; make a TIFF of it by: "
                       "bakeslab convert %s -o NAME.tif --precision float",
                       light->path, light->path);
  FILE *file = fopen(path, "r");
  if (!file && errno == ENOENT)
    return result_fail(error, RESULT_BAD, "%s: is not there; make it by: bakeslab include %s -o %s",
                       path, light->path, path);
  if (!file) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  bool found = find_macros(file, include), whole = feof(file);
  int why = errno;
  fclose(file);
  if (found && whole) return RESULT_OK;
  if (!whole) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(why));
  return result_fail(error, RESULT_BAD,
                     "%s: declares no lamp; make it again by: bakeslab include %s -o %s", path,
                     light->path, path);
}

/* The include of a light, or -1. */
static int known(const struct pov_includes *includes, const struct light *lights,
                 const char *path) {
  for (int k = 0; k < includes->count; ++k)
    if (!strcmp(lights[includes->list[k].light].path, path)) return k;
  return -1;
}

static enum result add(const struct light *lights, int number, struct pov_includes *includes,
                       struct error *error) {
  struct pov_include *include = &includes->list[includes->count++];
  include->light = number;
  include->path = with_suffix(lights[number].path, ".inc");
  include->image = with_suffix(lights[number].path, ".exr");
  if (!include->path || !include->image) return result_no_memory(error);
  enum result result = read_include(&lights[number], include, error);
  for (int k = 0; k < includes->count - 1 && result == RESULT_OK; ++k)
    if (!strcmp(includes->list[k].name, include->name))
      result =
          result_fail(error, RESULT_BAD,
                      "%s: declares %s_Canned, as %s does; make one again with bakeslab include "
                      "--name",
                      include->path, include->name, includes->list[k].path);
  return result;
}

enum result pov_includes_find(const struct light *lights, int count, struct pov_includes *includes,
                              struct error *error) {
  enum result result = RESULT_OK;
  *includes = (struct pov_includes){0};
  includes->list = calloc((size_t)count + 1, sizeof *includes->list);
  includes->of_light = calloc((size_t)count + 1, sizeof *includes->of_light);
  if (!includes->list || !includes->of_light) return result_no_memory(error);
  for (int k = 0; k < count && result == RESULT_OK; ++k) {
    int index = known(includes, lights, lights[k].path);
    includes->of_light[k] = index >= 0 ? index : includes->count;
    if (index < 0) result = add(lights, k, includes, error);
  }
  return result;
}

void pov_includes_free(struct pov_includes *includes) {
  for (int k = 0; k < includes->count; ++k) {
    free(includes->list[k].path);
    free(includes->list[k].image);
  }
  free(includes->list);
  free(includes->of_light);
  *includes = (struct pov_includes){0};
}
