/* scene_load.c - loads a scene from end to end (scene.h), and what that shares (scene_load.h). */
#include "scene/scene_load.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

bool scene_fits(size_t count, size_t size) {
  size_t pages = (size_t)sysconf(_SC_PHYS_PAGES), page = (size_t)sysconf(_SC_PAGE_SIZE);
  return count <= pages / 8 * page / size;
}

bool scene_grow(void *array, int *room, size_t count, size_t size) {
  return count <= (size_t)*room || (count <= INT_MAX && scene_fits(count, size) &&
                                    array_reserve(array, room, (int)count, size));
}

enum result scene_reserve(struct scene_loading *loading, size_t vertices, size_t triangles,
                          struct error *error) {
  struct scene *scene = loading->scene;
  int *room = loading->room;
  if (vertices > INT_MAX - scene->vertices || triangles > INT_MAX - scene->triangles)
    return result_fail(error, RESULT_BAD, "has more than %d vertices or triangles", INT_MAX);
  size_t v = scene->vertices + vertices, t = scene->triangles + triangles;
  bool good = scene_grow(&scene->position, &room[0], v, sizeof *scene->position) &&
              scene_grow(&scene->corners, &room[1], t, sizeof *scene->corners);
  if (good && loading->needs == SCENE_SURFACES)
    good = scene_grow(&scene->normal, &room[2], v, sizeof *scene->normal) &&
           scene_grow(&scene->uv, &room[3], v, sizeof *scene->uv) &&
           scene_grow(&scene->material, &room[4], t, sizeof *scene->material);
  return good ? RESULT_OK : result_no_memory(error);
}

static enum result find_format(struct scene_loading *loading, struct error *error) {
  static const struct {
    const char *suffix;
    enum scene_format format;
  } formats[] = {
      {".obj", SCENE_OBJ}, {".gltf", SCENE_GLTF}, {".glb", SCENE_GLTF}, {".ply", SCENE_PLY}};
  struct stat status;
  if (stat(loading->path, &status) != 0 || access(loading->path, R_OK) != 0)
    return result_fail(error, RESULT_IO, "%s: %s", loading->path, strerror(errno));
  if (!S_ISREG(status.st_mode))
    return result_fail(error, RESULT_BAD, "%s: is not a file", loading->path);
  const char *dot = strrchr(loading->path, '.');
  for (size_t k = 0; dot && k < sizeof formats / sizeof *formats; ++k)
    if (strcasecmp(dot, formats[k].suffix) == 0) {
      loading->format = formats[k].format;
      return RESULT_OK;
    }
  return result_fail(error, RESULT_BAD,
                     "%s: is no mesh that can be read; its name must end in .obj, .gltf, .glb or "
                     ".ply",
                     loading->path);
}

static enum result import(struct scene_loading *loading, struct error *error) {
  static enum result (*const readers[])(struct scene_loading *, struct error *) = {
      [SCENE_OBJ] = scene_obj_read, [SCENE_GLTF] = gltf_load, [SCENE_PLY] = scene_ply_read};
  enum result result = readers[loading->format](loading, error);
  if (result == RESULT_OK && loading->scene->triangles == 0)
    result = result_fail(error, RESULT_BAD, "%s: has no triangles%s", loading->path,
                         loading->dropped + loading->crossing ? " with an area" : "");
  return result == RESULT_OK && loading->repair ? scene_repair(loading, error) : result;
}

static void write_repairs(const struct scene_loading *loading, char note[256]) {
  const struct {
    size_t count;
    const char *what;
  } repairs[] = {{loading->dropped, "triangles without area dropped"},
                 {loading->crossing, "faces that cross themselves dropped"},
                 {loading->repeated, "repeated triangles dropped"},
                 {loading->flat, "meshes given flat normals"},
                 {loading->unnamed, "faces taken to have no such normals or texture coordinates"},
                 {loading->white, "materials made white"},
                 {loading->twofold, "materials declared twice taken as first declared"},
                 {loading->textureless, "textures that cannot be read left out"},
                 {loading->unread, "unsupported properties of materials ignored"}};
  size_t at = 0;
  for (size_t k = 0; k < sizeof repairs / sizeof *repairs; ++k)
    if (repairs[k].count > 0 && at < 200)
      at += (size_t)snprintf(note + at, 256 - at, "%s%s: %zu", at > 0 ? "; " : "", repairs[k].what,
                             repairs[k].count);
}

/* Where single precision would have moved corners by a ten-thousandth of the scene's size. glTF has
 * no more in its files. */
static void write_precision(const struct scene_loading *loading, char note[256]) {
  double low[3], high[3], size = 0, farthest = 0;
  if (loading->format == SCENE_GLTF) return;
  scene_box(loading->scene, low, high);
  for (int c = 0; c < 3; ++c) {
    size = fmax(size, high[c] - low[c]);
    farthest = fmax(farthest, fmax(fabs(low[c]), fabs(high[c])));
  }
  int exponent;
  frexp(farthest, &exponent);
  double rounding = ldexp(1, exponent - FLT_MANT_DIG - 1);
  size_t at = strlen(note);
  if (rounding > 1e-4 * size)
    snprintf(note + at, 256 - at,
             "%sit is %.2g wide and %.2g from the origin, where single precision would have moved "
             "corners by %.2g: they are kept in double precision",
             at > 0 ? "; " : "", size, farthest, rounding);
}

enum result scene_load(const char *path, enum scene_needs needs, bool repair, struct scene *scene,
                       char note[256], struct error *error) {
  struct scene_loading loading = {.path = path, .needs = needs, .repair = repair, .scene = scene};
  *scene = (struct scene){0};
  enum result result = find_format(&loading, error);
  if (result == RESULT_OK) result = import(&loading, error);
  note[0] = 0;
  if (result == RESULT_OK) {
    write_repairs(&loading, note);
    write_precision(&loading, note);
  }
  scene->metres = loading.format == SCENE_GLTF;
  if (result != RESULT_OK) scene_free(scene);
  return result;
}
