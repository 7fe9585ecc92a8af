/* scene.c - see scene.h: loading from end to end, and looking things up. */
#include "scene/scene.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/vector.h"
#include "scene/scene_load.h"

void scene_free(struct scene *scene) {
  free(scene->position);
  free(scene->normal);
  free(scene->uv);
  free(scene->corners);
  free(scene->material);
  free(scene->materials);
  for (int k = 0; k < scene->texture_count; ++k) {
    free(scene->textures[k].path);
    picture_free(&scene->textures[k].picture);
  }
  free(scene->textures);
  *scene = (struct scene){0};
}

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
  enum result result = scene_text_read(loading, error);
  if (result) return result;
  bool *used = NULL;
  const struct aiScene *from = aiImportFile(loading->path, aiProcess_Triangulate);
  if (!from) {
    result = result_fail(error, RESULT_BAD, "%s: cannot be read as a mesh: %s", loading->path,
                         aiGetErrorString());
    goto out;
  }
  used = calloc((size_t)from->mNumMaterials + 1, sizeof *used);
  if (!used) {
    result = result_fail(error, RESULT_MEMORY, "%s: out of memory", loading->path);
    goto out;
  }
  result = scene_import_meshes(loading, from, used, error);
  if (!result && loading->needs == SCENE_SURFACES)
    result = scene_import_materials(loading, from, used, error);
out:
  free(used);
  if (from) aiReleaseImport(from);
  return result;
}

static void write_note(const struct scene_loading *loading, char note[256]) {
  const struct {
    size_t count;
    const char *what;
  } repairs[] = {{loading->dropped, "triangles without area dropped"},
                 {loading->flat, "meshes given flat normals"},
                 {loading->white, "materials made white"},
                 {loading->unread, "unsupported properties of materials ignored"}};
  size_t at = 0;
  note[0] = 0;
  for (size_t k = 0; k < sizeof repairs / sizeof *repairs; ++k)
    if (repairs[k].count > 0 && at < 200)
      at += (size_t)snprintf(note + at, 256 - at, "%s%s: %zu", at > 0 ? "; " : "", repairs[k].what,
                             repairs[k].count);
}

enum result scene_load(const char *path, enum scene_needs needs, bool repair, struct scene *scene,
                       char note[256], struct error *error) {
  struct scene_loading loading = {.path = path, .needs = needs, .repair = repair, .scene = scene};
  *scene = (struct scene){0};
  enum result result = find_format(&loading, error);
  if (!result) result = import(&loading, error);
  note[0] = 0;
  if (!result) write_note(&loading, note);
  free(loading.mtl);
  if (result) scene_free(scene);
  return result;
}

void scene_box(const struct scene *scene, double low[3], double high[3]) {
  for (int c = 0; c < 3; ++c) {
    low[c] = INFINITY;
    high[c] = -INFINITY;
    for (size_t k = 0; k < scene->vertices; ++k) {
      low[c] = fmin(low[c], scene->position[k][c]);
      high[c] = fmax(high[c], scene->position[k][c]);
    }
  }
}

static void share_weights(const double share[2], double weights[3]) {
  weights[0] = 1 - share[0] - share[1];
  weights[1] = share[0];
  weights[2] = share[1];
}

/* Bilinear between the middles of pixels; the picture is repeated. */
static void texture_look_up(const struct picture *picture, double u, double v, double rgb[3]) {
  int size[2] = {picture->width, picture->height}, near[2], far[2];
  double place[2] = {u, 1 - v}, part[2];
  for (int k = 0; k < 2; ++k) {
    double x = (place[k] - floor(place[k])) * size[k] - 0.5;
    double low = floor(x);
    part[k] = x - low;
    near[k] = low < 0 ? size[k] - 1 : (int)low % size[k];
    far[k] = (near[k] + 1) % size[k];
  }
  const float *corner[4];
  for (int k = 0; k < 4; ++k) {
    size_t column = (size_t)(k & 1 ? far[0] : near[0]), row = (size_t)(k & 2 ? far[1] : near[1]);
    corner[k] = picture->rgb + 3 * (row * (size_t)picture->width + column);
  }
  for (int c = 0; c < 3; ++c) {
    double top = (double)corner[0][c] * (1 - part[0]) + (double)corner[1][c] * part[0];
    double bottom = (double)corner[2][c] * (1 - part[0]) + (double)corner[3][c] * part[0];
    rgb[c] = top * (1 - part[1]) + bottom * part[1];
  }
}

void scene_diffuse(const struct scene *scene, size_t triangle, const double share[2],
                   double rgb[3]) {
  const struct scene_material *material = &scene->materials[scene->material[triangle]];
  memcpy(rgb, material->diffuse, 3 * sizeof *rgb);
  if (material->texture < 0) return;
  double weights[3], uv[2] = {0, 0}, texel[3];
  share_weights(share, weights);
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 2; ++c) uv[c] += weights[k] * scene->uv[scene->corners[triangle][k]][c];
  texture_look_up(&scene->textures[material->texture].picture, uv[0], uv[1], texel);
  for (int c = 0; c < 3; ++c) rgb[c] *= texel[c];
}

void scene_point(const struct scene *scene, size_t triangle, const double share[2],
                 double position[3], double normal[3], double geometric[3]) {
  const int *corners = scene->corners[triangle];
  double weights[3], edge[2][3];
  share_weights(share, weights);
  for (int c = 0; c < 3; ++c) {
    position[c] = normal[c] = 0;
    for (int k = 0; k < 3; ++k) {
      position[c] += weights[k] * scene->position[corners[k]][c];
      normal[c] += weights[k] * scene->normal[corners[k]][c];
    }
  }
  for (int k = 0; k < 2; ++k)
    vector_subtract(scene->position[corners[k + 1]], scene->position[corners[0]], edge[k]);
  vector_cross(edge[0], edge[1], geometric);
  vector_normalise(geometric);
  /* opposite normals may cancel out */
  if (!vector_normalise(normal)) memcpy(normal, geometric, 3 * sizeof *normal);
  if (vector_dot(normal, geometric) < 0)
    for (int c = 0; c < 3; ++c) geometric[c] = -geometric[c];
}
