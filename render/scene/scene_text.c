/* scene_text.c - reads from OBJ, MTL and glTF files what assimp does not report. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_load.h"

struct line {
  const char *path;
  size_t number;
  char *keyword; /* "" on empty lines */
  char *rest;    /* trimmed */
};

typedef enum result line_reader(struct scene_loading *loading, const struct line *line,
                                struct error *error);

static const char BLANKS[] = " \t\r\n\v\f";

static void split(char *text, struct line *line) {
  line->keyword = text + strspn(text, BLANKS);
  char *end = line->keyword + strcspn(line->keyword, BLANKS);
  line->rest = end + strspn(end, BLANKS);
  for (char *last = line->rest + strlen(line->rest); last > line->rest && strchr(BLANKS, last[-1]);)
    *--last = 0;
  *end = 0;
}

static enum result read_lines(struct scene_loading *loading, const char *path, line_reader *reader,
                              struct error *error) {
  enum result result = RESULT_OK;
  char *text = NULL;
  size_t room = 0;
  struct line line = {.path = path};
  FILE *file = fopen(path, "re");
  if (!file) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  while (result == RESULT_OK && getline(&text, &room, file) >= 0) {
    ++line.number;
    split(text, &line);
    result = reader(loading, &line, error);
  }
  if (result == RESULT_OK && !feof(file))
    result = result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  free(text);
  fclose(file);
  return result;
}

/* Reads up to `most` numbers; returns how many there are, or -1 where one isn't finite or
 * something is no number. */
static int read_numbers(const char *text, int most, double *numbers) {
  for (int k = 0; k < most; ++k) {
    char *end;
    text += strspn(text, BLANKS);
    if (!*text || *text == '#') return k;
    double number = strtod(text, &end);
    if (end == text || !isfinite((float)number) || !strchr(BLANKS, *end)) return -1;
    numbers[k] = number;
    text = end;
  }
  return most;
}

/* One number for all three, or three; none negative. */
static enum result read_colour(const struct line *line, double rgb[3], struct error *error) {
  int count = read_numbers(line->rest, 3, rgb);
  if (count == 1) rgb[1] = rgb[2] = rgb[0];
  if ((count == 1 || count == 3) && rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s:%zu: '%s %s' is not a colour of three finite numbers",
                     line->path, line->number, line->keyword, line->rest);
}

const struct scene_mtl *scene_text_material(const struct scene_loading *loading, const char *name) {
  for (int k = 0; k < loading->mtl_count; ++k)
    if (strcmp(loading->mtl[k].material.name, name) == 0) return &loading->mtl[k];
  return NULL;
}

static enum result new_material(struct scene_loading *loading, const struct line *line,
                                struct error *error) {
  struct scene_mtl made = {.material = {.texture = -1}};
  if (!line->rest[0] || strlen(line->rest) >= sizeof made.material.name)
    return result_fail(error, RESULT_BAD, "%s:%zu: newmtl needs a name of less than %zu letters",
                       line->path, line->number, sizeof made.material.name);
  if (scene_text_material(loading, line->rest))
    return result_fail(error, RESULT_BAD, "%s:%zu: there are two materials '%s'", line->path,
                       line->number, line->rest);
  strcpy(made.material.name, line->rest);
  if (!array_reserve(&loading->mtl, &loading->mtl_room, loading->mtl_count + 1, sizeof made))
    return result_fail(error, RESULT_MEMORY, "%s: out of memory", line->path);
  loading->mtl[loading->mtl_count++] = made;
  return RESULT_OK;
}

static enum result read_texture(struct scene_loading *loading, const struct line *line,
                                struct scene_mtl *mtl, struct error *error) {
  const char *name = line->rest;
  if (name[0] == '-') { /* options; the name is taken to be the last word */
    enum result result = scene_unread(loading, error, "%s:%zu: '%s %s' has an option", line->path,
                                      line->number, line->keyword, line->rest);
    if (result != RESULT_OK) return result;
    const char *blank = name + strlen(name);
    while (blank > name && !strchr(BLANKS, blank[-1])) --blank;
    name = blank;
  }
  if (!name[0] || strlen(name) >= sizeof mtl->texture)
    return result_fail(error, RESULT_BAD, "%s:%zu: %s needs the name of a file", line->path,
                       line->number, line->keyword);
  strcpy(mtl->texture, name);
  mtl->has_texture = true;
  return RESULT_OK;
}

/* What changes nothing in the picture. d is opacity, Tr what is lacking of it; some programs write
 * both, and Tr then at times the wrong way round. */
static void note_ignored(struct scene_mtl *mtl, const struct line *line) {
  static const char *const bumps[] = {"bump", "map_Bump", "map_bump", "norm", "map_Kn", "disp"};
  double opacity = 1;
  bool d = strcmp(line->keyword, "d") == 0;
  if ((d || strcmp(line->keyword, "Tr") == 0) && read_numbers(line->rest, 1, &opacity) == 1) {
    if (!d) opacity = 1 - opacity;
    if (d || !mtl->has_opacity) mtl->transparent = opacity < 1;
    mtl->has_opacity |= d;
  }
  if (strcmp(line->keyword, "map_d") == 0) mtl->see_through = true;
  for (size_t k = 0; k < sizeof bumps / sizeof *bumps; ++k)
    mtl->bumps |= strcmp(line->keyword, bumps[k]) == 0;
}

static enum result read_mtl_line(struct scene_loading *loading, const struct line *line,
                                 struct error *error) {
  static const char *const unread[] = {"map_Ks", "map_Ke", "map_Ns"};
  if (strcmp(line->keyword, "newmtl") == 0) return new_material(loading, line, error);
  struct scene_mtl *mtl = loading->mtl_count ? &loading->mtl[loading->mtl_count - 1] : NULL;
  if (!mtl) return RESULT_OK;
  note_ignored(mtl, line);
  if (strcmp(line->keyword, "Kd") == 0) {
    mtl->has_diffuse = true;
    return read_colour(line, mtl->material.diffuse, error);
  }
  if (strcmp(line->keyword, "Ks") == 0) return read_colour(line, mtl->material.specular, error);
  if (strcmp(line->keyword, "Ke") == 0) return read_colour(line, mtl->material.emission, error);
  if (strcmp(line->keyword, "map_Kd") == 0) return read_texture(loading, line, mtl, error);
  if (strcmp(line->keyword, "Ns") == 0 &&
      (read_numbers(line->rest, 1, &mtl->material.shininess) != 1 || mtl->material.shininess < 0))
    return result_fail(error, RESULT_BAD, "%s:%zu: 'Ns %s' is not a number from 0", line->path,
                       line->number, line->rest);
  for (size_t k = 0; k < sizeof unread / sizeof *unread; ++k)
    if (strcmp(line->keyword, unread[k]) == 0)
      return scene_unread(loading, error, "%s:%zu: %s", line->path, line->number, unread[k]);
  return RESULT_OK;
}

static enum result read_library(struct scene_loading *loading, const struct line *line,
                                struct error *error) {
  char *path = scene_beside(loading->path, line->rest);
  if (!path) return result_fail(error, RESULT_MEMORY, "%s: out of memory", loading->path);
  struct error inner = {""};
  enum result result = read_lines(loading, path, read_mtl_line, &inner);
  if (result == RESULT_IO && loading->repair)
    result = RESULT_OK; /* its materials will be white */
  else if (result == RESULT_IO)
    result_fail(error, result, "%s:%zu: mtllib: %s", line->path, line->number, inner.text);
  else if (result != RESULT_OK)
    result_fail(error, result, "%s", inner.text);
  free(path);
  return result;
}

static enum result read_obj_line(struct scene_loading *loading, const struct line *line,
                                 struct error *error) {
  static const struct {
    const char *keyword;
    int numbers;
  } vectors[] = {{"v", 3}, {"vn", 3}, {"vt", 1}};
  double numbers[3];
  for (size_t k = 0; k < sizeof vectors / sizeof *vectors; ++k)
    if (strcmp(line->keyword, vectors[k].keyword) == 0 &&
        read_numbers(line->rest, 3, numbers) < vectors[k].numbers)
      return result_fail(error, RESULT_BAD, "%s:%zu: '%s %s' is not a line of finite numbers",
                         line->path, line->number, line->keyword, line->rest);
  if (strcmp(line->keyword, "mtllib") == 0 && loading->needs == SCENE_SURFACES)
    return read_library(loading, line, error);
  return RESULT_OK;
}

/* Extensions that change what a surface looks like. A name in the text means that it is used:
 * exporters list what they use. */
static enum result read_gltf(struct scene_loading *loading, struct error *error) {
  static const char *const unread[] = {"KHR_materials_emissive_strength", "KHR_texture_transform",
                                       "KHR_materials_pbrSpecularGlossiness"};
  enum { OVERLAP = 64, CHUNK = 1 << 16 };
  bool found[sizeof unread / sizeof *unread] = {false};
  enum result result = RESULT_OK;
  char *text = malloc(OVERLAP + CHUNK);
  FILE *file = fopen(loading->path, "re");
  bool good = text && file;
  for (size_t kept = 0, got; good && (got = fread(text + kept, 1, CHUNK, file)) > 0;) {
    size_t size = kept + got;
    for (size_t k = 0; k < sizeof unread / sizeof *unread; ++k)
      found[k] |= memmem(text, size, unread[k], strlen(unread[k])) != NULL;
    kept = size < OVERLAP ? size : OVERLAP;
    memmove(text, text + size - kept, kept);
  }
  if (!good || ferror(file))
    result = result_fail(error, RESULT_IO, "%s: %s", loading->path, strerror(errno));
  for (size_t k = 0; k < sizeof unread / sizeof *unread && result == RESULT_OK; ++k)
    if (found[k]) result = scene_unread(loading, error, "%s: has %s", loading->path, unread[k]);
  free(text);
  if (file) fclose(file);
  return result;
}

enum result scene_text_read(struct scene_loading *loading, struct error *error) {
  if (loading->format == SCENE_OBJ) return read_lines(loading, loading->path, read_obj_line, error);
  if (loading->format == SCENE_PLY) return scene_ply_check(loading->path, error);
  if (loading->format == SCENE_GLTF && loading->needs == SCENE_SURFACES)
    return read_gltf(loading, error);
  return RESULT_OK;
}
