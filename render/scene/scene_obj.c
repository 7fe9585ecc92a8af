/* scene_obj.c - reads OBJ files into a scene, see scene_load.h.
 *
 * The file is read twice: what corners name and the material libraries, then faces; so faces may
 * come before their vertices. Keywords are read in any case. A mesh begins with each o, g and
 * usemtl that faces follow. Lines, points and smoothing groups mean nothing here; colours of
 * vertices, weights, free forms and whatever nobody knows are noted as ignored. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/array.h"
#include "scene/scene_faces.h"
#include "scene/scene_lines.h"
#include "scene/scene_mtl.h"

/* Materials of the scene are those that faces use, by the names that usemtl gives them. */
struct obj {
  struct scene_loading *loading;
  struct scene_faces faces;
  struct scene_mtls mtls;
  char mesh[128], material[128]; /* "": none */
  bool begins;                   /* a mesh, with the next face */
  bool told_bare;                /* that the mesh has no texture coordinates */
  int material_room, corner_room;
  struct scene_corner *corner; /* of a face; owned */
  int before[3];               /* positions, texture coordinates and normals before the line */
};

/* A file's name without its folders. */
static const char *base_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

static enum result checked(const struct obj *obj, bool good, struct error *error) {
  return good ? RESULT_OK : result_at(result_no_memory(error), error, "%s", obj->loading->path);
}

static enum result not_finite(const struct scene_line *line, struct error *error) {
  return result_fail(error, RESULT_BAD, "%s:%zu: '%s %s' is not a line of finite numbers",
                     line->path, line->number, line->keyword, line->rest);
}

/* v x y z, v x y z w, v x y z r g b and v x y z w r g b. */
static enum result read_position(struct obj *obj, const struct scene_line *line,
                                 struct error *error) {
  double numbers[8];
  int count = scene_numbers(line->rest, 7, numbers);
  if (count < 3) return not_finite(line, error);
  enum result result = scene_faces_position(&obj->faces, numbers, error);
  if (result != RESULT_OK || count == 3 || obj->loading->needs != SCENE_SURFACES) return result;
  if (count == 4 && numbers[3] != 1)
    return checked(obj, scene_ignore_statement(obj->loading, "w"), error);
  if (count < 6) return RESULT_OK;
  const char *name = *obj->mesh ? obj->mesh : base_name(line->path);
  return checked(obj, scene_ignore(obj->loading, SCENE_COLOURS, name), error);
}

static void set_name(char name[128], const char *text) {
  snprintf(name, 128, "%.127s", text);
}

static enum result read_library(struct obj *obj, const struct scene_line *line,
                                struct error *error) {
  struct error inner = {""};
  enum result result = scene_mtl_read(&obj->mtls, line->rest, &inner);
  if (result == RESULT_IO)
    return result_fail(error, result, "%s:%zu: mtllib: %s; --repair makes its materials white",
                       line->path, line->number, inner.text);
  return result == RESULT_OK ? result : result_fail(error, result, "%s", inner.text);
}

static enum result ignore(struct obj *obj, const struct scene_line *line, struct error *error) {
  static const char *const known[] = {"",  "f", "fo", "o",   "g",     "s",
                                      "l", "p", "vp", "lod", "usemtl"};
  if (line->keyword[0] == '#') return RESULT_OK;
  for (size_t k = 0; k < sizeof known / sizeof *known; ++k)
    if (strcasecmp(line->keyword, known[k]) == 0) return RESULT_OK;
  return checked(obj, scene_ignore_statement(obj->loading, line->keyword), error);
}

/* What corners name, libraries, and what is ignored. */
static enum result first_pass(void *context, const struct scene_line *line, struct error *error) {
  struct obj *obj = context;
  double numbers[3] = {0, 0, 0};
  if (strcasecmp(line->keyword, "v") == 0) return read_position(obj, line, error);
  if (strcasecmp(line->keyword, "vn") == 0) {
    if (scene_numbers(line->rest, 3, numbers) < 3) return not_finite(line, error);
    return scene_faces_normal(&obj->faces, numbers, error);
  }
  if (strcasecmp(line->keyword, "vt") == 0) {
    if (scene_numbers(line->rest, 3, numbers) < 1) return not_finite(line, error);
    return scene_faces_uv(&obj->faces, numbers, error);
  }
  if (obj->loading->needs != SCENE_SURFACES) return RESULT_OK;
  if (strcasecmp(line->keyword, "mtllib") == 0) return read_library(obj, line, error);
  if (strcasecmp(line->keyword, "o") == 0 || strcasecmp(line->keyword, "g") == 0)
    set_name(obj->mesh, line->rest);
  return ignore(obj, line, error);
}

static enum result no_material(struct obj *obj, struct scene_material *material,
                               struct error *error) {
  char what[256];
  ++obj->loading->white;
  for (int c = 0; c < 3; ++c) material->diffuse[c] = 1;
  if (obj->loading->repair) return RESULT_OK;
  if (*obj->material)
    snprintf(what, sizeof what, "has no material: '%s' is in none of its MTL files", obj->material);
  else
    snprintf(what, sizeof what, "has no material");
  strcat(what, "; --repair makes it white");
  return scene_faces_fail(&obj->faces, what, error);
}

/* Finds the material of the faces that come, or adds it to the scene. */
static enum result find_material(struct obj *obj, struct error *error) {
  struct scene *scene = obj->loading->scene;
  int count = scene->material_count;
  for (int k = 0; k < count; ++k)
    if (strcmp(scene->materials[k].name, obj->material) == 0) {
      obj->faces.material = k;
      return RESULT_OK;
    }
  if (!array_reserve(&scene->materials, &obj->material_room, count + 1, sizeof *scene->materials))
    return checked(obj, false, error);
  struct scene_material *material = &scene->materials[count];
  *material = (struct scene_material){.texture = -1};
  obj->faces.material = scene->material_count++;
  const struct scene_mtl *mtl = scene_mtl_find(&obj->mtls, obj->material);
  enum result result =
      mtl ? scene_mtl_use(&obj->mtls, mtl, material, error) : no_material(obj, material, error);
  memcpy(material->name, obj->material, sizeof material->name);
  return result;
}

/* Reads a number from 1, or one that counts back from those before the line; *index is from 0: -1
 * where nothing is written, INT_MAX for what cannot be. */
static bool read_index(const char **text, int before, int *index) {
  const char *at = *text + (**text == '-' || **text == '+');
  long long number = 0;
  *index = -1;
  if (*at < '0' || *at > '9') return at == *text;
  for (; *at >= '0' && *at <= '9'; ++at)
    if (number <= INT_MAX) number = 10 * number + (*at - '0');
  number = **text == '-' ? before - number : number - 1;
  *text = at;
  *index = number < 0 || number > INT_MAX ? INT_MAX : (int)number;
  return true;
}

/* A corner: v, v/vt, v//vn or v/vt/vn. */
static bool read_corner(const char **text, const int before[3], struct scene_corner *corner) {
  int index[3] = {-1, -1, -1};
  bool good = true;
  for (int k = 0; k < 3 && good; ++k) {
    good = read_index(text, before[k], &index[k]);
    if (**text != '/') break;
    ++*text;
  }
  *corner = (struct scene_corner){.position = index[0], .uv = index[1], .normal = index[2]};
  return good && index[0] >= 0 && (!**text || strchr(scene_blanks, **text) || **text == '#');
}

static enum result read_corners(struct obj *obj, const struct scene_line *line, int *count,
                                struct error *error) {
  *count = 0;
  for (const char *at = line->rest; *at && *at != '#'; at += strspn(at, scene_blanks), ++*count) {
    if (!array_reserve(&obj->corner, &obj->corner_room, *count + 1, sizeof *obj->corner))
      return checked(obj, false, error);
    if (!read_corner(&at, obj->before, &obj->corner[*count]))
      return scene_faces_fail(&obj->faces, "has a corner that is no number", error);
  }
  return RESULT_OK;
}

/* A mesh is told once. */
static enum result check_texture(struct obj *obj, int count, struct error *error) {
  if (obj->loading->scene->materials[obj->faces.material].texture < 0 || obj->told_bare)
    return RESULT_OK;
  for (int k = 0; k < count; ++k) obj->told_bare |= obj->corner[k].uv < 0;
  if (!obj->told_bare) return RESULT_OK;
  return scene_unread(obj->loading, error,
                      "%s:%zu: mesh '%s' has a texture without texture coordinates",
                      obj->loading->path, obj->faces.number, obj->mesh);
}

static enum result read_face(struct obj *obj, const struct scene_line *line, struct error *error) {
  int count;
  bool surfaces = obj->loading->needs == SCENE_SURFACES;
  obj->faces.number = line->number;
  obj->faces.mesh = obj->mesh;
  enum result result = read_corners(obj, line, &count, error);
  if (result == RESULT_OK && obj->begins) {
    obj->begins = obj->faces.told_flat = obj->told_bare = false;
    if (surfaces) result = find_material(obj, error);
  }
  if (result == RESULT_OK && surfaces) result = check_texture(obj, count, error);
  return result == RESULT_OK ? scene_faces_add(&obj->faces, obj->corner, count, error) : result;
}

static enum result second_pass(void *context, const struct scene_line *line, struct error *error) {
  struct obj *obj = context;
  const char *keyword = line->keyword;
  if (strcasecmp(keyword, "f") == 0 || strcasecmp(keyword, "fo") == 0)
    return read_face(obj, line, error);
  obj->before[0] += strcasecmp(keyword, "v") == 0;
  obj->before[1] += strcasecmp(keyword, "vt") == 0;
  obj->before[2] += strcasecmp(keyword, "vn") == 0;
  bool names = strcasecmp(keyword, "o") == 0 || strcasecmp(keyword, "g") == 0;
  bool uses = strcasecmp(keyword, "usemtl") == 0;
  if (names) set_name(obj->mesh, line->rest);
  if (uses) set_name(obj->material, line->rest);
  obj->begins |= names || uses;
  return RESULT_OK;
}

enum result scene_obj_read(struct scene_loading *loading, struct error *error) {
  struct obj obj = {.loading = loading, .begins = true};
  obj.faces.loading = obj.mtls.loading = loading;
  enum result result = scene_lines_read(loading->path, first_pass, &obj, error);
  obj.mesh[0] = 0;
  if (result == RESULT_OK) result = scene_lines_read(loading->path, second_pass, &obj, error);
  scene_faces_free(&obj.faces);
  scene_mtl_free(&obj.mtls);
  free(obj.corner);
  return result;
}
