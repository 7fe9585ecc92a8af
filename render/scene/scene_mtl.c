#include "scene/scene_mtl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/array.h"
#include "base/vector.h"
#include "scene/scene_lines.h"

enum { MOST_MATERIALS = 1 << 16 };

static bool is(const char *word, const char *keyword) {
  return strcasecmp(word, keyword) == 0;
}

static bool is_one_of(const char *word, const char *const *keywords) {
  while (*keywords && !is(word, *keywords)) ++keywords;
  return *keywords != NULL;
}

const struct scene_mtl *scene_mtl_find(const struct scene_mtls *mtls, const char *name) {
  for (int k = 0; k < mtls->count; ++k)
    if (strcmp(mtls->mtl[k].material.name, name) == 0) return &mtls->mtl[k];
  return NULL;
}

static enum result new_material(struct scene_mtls *mtls, const struct scene_line *line,
                                struct error *error) {
  struct scene_mtl made = {.material = {.texture = -1}, .library = mtls->libraries - 1};
  if (strlen(line->rest) >= sizeof made.material.name)
    return result_fail(error, RESULT_BAD, "%s:%zu: newmtl needs a name of less than %zu letters",
                       line->path, line->number, sizeof made.material.name);
  const struct scene_mtl *there = scene_mtl_find(mtls, line->rest);
  mtls->skips = there != NULL;
  if (there && there->library == made.library) {
    ++mtls->loading->twofold;
    if (!mtls->loading->repair)
      return result_fail(error, RESULT_BAD,
                         "%s:%zu: there are two materials '%s'; --repair takes the first",
                         line->path, line->number, line->rest);
  }
  if (there) return RESULT_OK;
  if (mtls->count == MOST_MATERIALS)
    return result_fail(error, RESULT_BAD, "%s:%zu: is the material after number %d, the last",
                       line->path, line->number, MOST_MATERIALS);
  strcpy(made.material.name, line->rest);
  if (!array_reserve(&mtls->mtl, &mtls->room, mtls->count + 1, sizeof made))
    return result_at(result_no_memory(error), error, "%s", line->path);
  mtls->mtl[mtls->count++] = made;
  return RESULT_OK;
}

/* One number for all three, or three; none negative. */
static enum result read_colour(const struct scene_line *line, double rgb[3], struct error *error) {
  int count = scene_numbers(line->rest, 3, rgb);
  if (count == 1) rgb[1] = rgb[2] = rgb[0];
  if ((count == 1 || count == 3) && rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s:%zu: '%s %s' is not a colour of three finite numbers",
                     line->path, line->number, line->keyword, line->rest);
}

/* A word, which is ended by a zero; *text is what comes after it. */
static char *next_word(char **text) {
  char *word = *text, *end = word + strcspn(word, scene_blanks);
  *text = end + strspn(end, scene_blanks);
  *end = 0;
  return word;
}

static bool next_is_number(const char *text) {
  char *end;
  scene_number(text, &end);
  return end > text && (*end == 0 || strchr(scene_blanks, *end));
}

/* An option of a map and what follows it. */
struct option {
  const char *name;
  int least, most;    /* arguments; beyond the least ones they are numbers */
  bool changes;       /* the picture, unless they are: */
  const char *itself; /* each one that it has by itself, in order */
};

static const struct option options[] = {
    {"-blendu", 1, 1, false, NULL},     {"-blendv", 1, 1, false, NULL},
    {"-boost", 1, 1, false, NULL},      {"-texres", 1, 1, false, NULL},
    {"-type", 1, 1, false, NULL},       {"-cc", 1, 1, false, NULL},
    {"-bm", 1, 1, false, NULL},         {"-imfchan", 1, 1, false, NULL},
    {"-colorspace", 1, 1, false, NULL}, {"-clamp", 1, 1, true, "off"},
    {"-o", 1, 3, true, "0 0 0"},        {"-t", 1, 3, true, "0 0 0"},
    {"-s", 1, 3, true, "1 1 1"},        {"-mm", 2, 2, true, "0 1"}};

static bool by_itself(const char *argument, int number, const char *itself) {
  char word[8];
  for (; number > 0; --number) itself = strchr(itself, ' ') + 1;
  snprintf(word, sizeof word, "%.*s", (int)strcspn(itself, " "), itself);
  char *end;
  double value = scene_number(argument, &end);
  return end > argument && !*end ? value == atof(word) : is(argument, word);
}

/* Reads over one option; *changes: it is not what it is by itself. False where nobody knows it;
 * then one argument is taken to follow. */
static bool read_option(char **text, bool *changes) {
  const struct option *option = NULL;
  const char *name = next_word(text);
  *changes = true;
  for (size_t k = 0; k < sizeof options / sizeof *options; ++k)
    if (is(name, options[k].name)) option = &options[k];
  if (option) *changes = false;
  for (int k = 0; k < (option ? option->most : 1) && **text; ++k) {
    if (option && k >= option->least && !next_is_number(*text)) break;
    const char *argument = next_word(text);
    if (option && option->changes) *changes |= !by_itself(argument, k, option->itself);
  }
  return option != NULL;
}

/* What a material has and is not supported; it is refused if a face has the material. */
static void note_unread(struct scene_mtl *mtl, const struct scene_line *line, const char *has,
                        const char *option) {
  if (mtl->unread++ > 0) return;
  mtl->unread_line = line->number;
  snprintf(mtl->unread_what, sizeof mtl->unread_what, "%s%s%s", line->keyword, has, option);
}

static enum result read_texture(const struct scene_line *line, struct scene_mtl *mtl,
                                struct error *error) {
  char *name = line->rest;
  while (name[0] == '-') {
    const char *option = name;
    bool changes;
    read_option(&name, &changes);
    if (changes) note_unread(mtl, line, " has the option ", option);
  }
  if (!name[0] || strlen(name) >= sizeof mtl->texture)
    return result_fail(error, RESULT_BAD, "%s:%zu: %s needs the name of a file", line->path,
                       line->number, line->keyword);
  strcpy(mtl->texture, name);
  mtl->has_texture = true;
  return RESULT_OK;
}

/* d is opacity, Tr what is lacking of it; some programs write both, and Tr then at times the wrong
 * way round. */
static void read_opacity(struct scene_mtl *mtl, const struct scene_line *line) {
  double opacity = 1;
  bool d = is(line->keyword, "d");
  char *text = line->rest;
  if (strncasecmp(text, "-halo", 5) == 0) next_word(&text);
  if (scene_numbers(text, 1, &opacity) != 1) return;
  if (!d) opacity = 1 - opacity;
  if (d || !mtl->has_opacity) mtl->transparent = opacity < 1;
  mtl->has_opacity |= d;
}

/* What changes nothing in the picture, though somebody may miss it. */
static enum result ignore_statement(struct scene_mtls *mtls, const struct scene_line *line,
                                    struct error *error) {
  static const char *const silent[] = {"",        "Ka", "Ni",  "illum", "sharpness", "Tf", "map_Ka",
                                       "map_aat", "Pr", "Pcr", "aniso", "anisor",    NULL};
  double number;
  if (line->keyword[0] == '#' || is_one_of(line->keyword, silent)) return RESULT_OK;
  if (scene_numbers(line->rest, 1, &number) == 1 && number == 0) return RESULT_OK;
  if (scene_ignore_statement(mtls->loading, line->keyword)) return RESULT_OK;
  return result_at(result_no_memory(error), error, "%s", line->path);
}

static enum result read_shininess(const struct scene_line *line, double *shininess,
                                  struct error *error) {
  if (scene_numbers(line->rest, 1, shininess) == 1 && *shininess >= 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s:%zu: 'Ns %s' is not a number from 0", line->path,
                     line->number, line->rest);
}

static enum result read_line(void *context, const struct scene_line *line, struct error *error) {
  static const char *const unread[] = {"map_Ks", "map_Ke", "map_Ns", NULL};
  static const char *const opacity[] = {"d", "Tr", NULL};
  static const char *const bumps[] = {"bump", "map_bump", "norm", "map_Kn",
                                      "disp", "map_disp", NULL};
  struct scene_mtls *mtls = context;
  const char *keyword = line->keyword;
  if (is(keyword, "newmtl")) return new_material(mtls, line, error);
  struct scene_mtl *mtl = mtls->count && !mtls->skips ? &mtls->mtl[mtls->count - 1] : NULL;
  if (!mtl || mtl->library != mtls->libraries - 1) return RESULT_OK;
  if (is(keyword, "Kd")) {
    mtl->has_diffuse = true;
    return read_colour(line, mtl->material.diffuse, error);
  }
  if (is(keyword, "Ks")) return read_colour(line, mtl->material.specular, error);
  if (is(keyword, "Ke")) return read_colour(line, mtl->material.emission, error);
  if (is(keyword, "Ns")) return read_shininess(line, &mtl->material.shininess, error);
  if (is(keyword, "map_Kd")) return read_texture(line, mtl, error);
  if (is_one_of(keyword, unread)) {
    note_unread(mtl, line, "", "");
  } else if (is_one_of(keyword, opacity)) {
    read_opacity(mtl, line);
  } else if (is(keyword, "map_d")) {
    mtl->see_through = true;
  } else if (is_one_of(keyword, bumps)) {
    mtl->bumps = true;
  } else {
    return ignore_statement(mtls, line, error);
  }
  return RESULT_OK;
}

/* Takes `path` over. */
static enum result read_library(struct scene_mtls *mtls, char *path, struct error *error) {
  enum result result = RESULT_OK;
  for (int k = 0; path && k < mtls->libraries; ++k)
    if (strcmp(mtls->library[k], path) == 0) {
      free(path);
      return RESULT_OK;
    }
  if (!path || !array_reserve(&mtls->library, &mtls->library_room, mtls->libraries + 1,
                              sizeof *mtls->library)) {
    free(path);
    return result_no_memory(error);
  }
  mtls->library[mtls->libraries++] = path;
  mtls->skips = false;
  result = scene_lines_read(path, read_line, mtls, error);
  if (result != RESULT_IO) return result;
  free(mtls->library[--mtls->libraries]); /* it was not read */
  return result;
}

enum result scene_mtl_read(struct scene_mtls *mtls, const char *names, struct error *error) {
  const char *scene = mtls->loading->path;
  enum result result = read_library(mtls, scene_find_beside(scene, names), error);
  char *copy = strdup(names), *rest = copy;
  if (!copy) result = result_no_memory(error);
  if (result == RESULT_IO && strpbrk(names, scene_blanks))
    for (result = RESULT_OK; result == RESULT_OK && *rest;) {
      result = read_library(mtls, scene_find_beside(scene, next_word(&rest)), error);
      if (result == RESULT_IO && mtls->loading->repair) result = RESULT_OK;
    }
  free(copy);
  /* What is missing will be white. */
  return result == RESULT_IO && mtls->loading->repair ? RESULT_OK : result;
}

static enum result ignore(struct scene_mtls *mtls, enum scene_ignored kind, bool there,
                          const char *name, struct error *error) {
  if (!there || scene_ignore(mtls->loading, kind, name)) return RESULT_OK;
  return result_at(result_no_memory(error), error, "%s", mtls->loading->path);
}

static enum result use_texture(struct scene_mtls *mtls, const struct scene_mtl *mtl, int *number,
                               struct error *error) {
  struct scene_loading *loading = mtls->loading;
  struct error inner = {""};
  char *path = scene_find_beside(mtls->library[mtl->library], mtl->texture);
  if (path && access(path, F_OK) != 0) { /* some programs mean the mesh's folder */
    char *other = scene_find_beside(loading->path, mtl->texture);
    if (other && access(other, F_OK) == 0) {
      free(path);
      path = other;
    } else {
      free(other);
    }
  }
  enum result result = scene_add_texture(loading, path, NULL, 0, NULL, number, &inner);
  if (result == RESULT_OK) return RESULT_OK;
  if (result == RESULT_BAD || result == RESULT_IO) {
    ++loading->textureless;
    if (loading->repair) return RESULT_OK;
    return result_fail(error, result, "%s; --repair does without it", inner.text);
  }
  return result_fail(error, result, "%s", inner.text);
}

static enum result refuse_unread(struct scene_mtls *mtls, const struct scene_mtl *mtl,
                                 struct error *error) {
  if (mtl->unread == 0) return RESULT_OK;
  mtls->loading->unread += mtl->unread - 1; /* scene_unread counts one */
  return scene_unread(mtls->loading, error, "%s:%zu: %s", mtls->library[mtl->library],
                      mtl->unread_line, mtl->unread_what);
}

enum result scene_mtl_use(struct scene_mtls *mtls, const struct scene_mtl *mtl,
                          struct scene_material *material, struct error *error) {
  struct scene_loading *loading = mtls->loading;
  const char *name = mtl->material.name;
  *material = mtl->material;
  enum result result = refuse_unread(mtls, mtl, error);
  if (result != RESULT_OK) return result;
  bool glows = !vector_is_zero(material->emission);
  if (!mtl->has_diffuse && (mtl->has_texture || !glows))
    for (int c = 0; c < 3; ++c) material->diffuse[c] = 1; /* the texture is all its colour */
  if (!mtl->has_diffuse && !mtl->has_texture && !glows) {
    ++loading->white;
    if (!loading->repair)
      return result_fail(error, RESULT_BAD,
                         "%s: material '%s' has no Kd, map_Kd or Ke; --repair makes it white",
                         mtls->library[mtl->library], name);
  }
  if (mtl->has_texture) result = use_texture(mtls, mtl, &material->texture, error);
  bool transparent =
      mtl->transparent || mtl->see_through ||
      (material->texture >= 0 && loading->scene->textures[material->texture].transparent);
  if (result == RESULT_OK) result = ignore(mtls, SCENE_TRANSPARENCY, transparent, name, error);
  if (result == RESULT_OK) result = ignore(mtls, SCENE_BUMPS, mtl->bumps, name, error);
  if (result == RESULT_OK) result = ignore(mtls, SCENE_EMISSION, glows, name, error);
  return result;
}

void scene_mtl_free(struct scene_mtls *mtls) {
  for (int k = 0; k < mtls->libraries; ++k) free(mtls->library[k]);
  free(mtls->library);
  free(mtls->mtl);
}
