/* scene_load.h - what the files that load a scene share; scene.h is for everybody else.
 *
 * glTF is read by assimp; OBJ, MTL and PLY, which it reads in single precision and with losses,
 * by files of our own. */
#ifndef SCENE_LOAD_H
#define SCENE_LOAD_H

#include "base/array.h"
#include "scene/scene.h"

enum scene_format { SCENE_OBJ, SCENE_GLTF, SCENE_PLY };

struct scene_loading {
  const char *path;
  enum scene_format format;
  enum scene_needs needs;
  bool repair;
  struct scene *scene;
  /* what was repaired */
  size_t dropped;     /* triangles without area */
  size_t crossing;    /* faces that cross themselves, dropped */
  size_t repeated;    /* triangles, dropped too */
  size_t flat;        /* meshes */
  size_t unnamed;     /* faces, whose normals or texture coordinates are not there */
  size_t white;       /* materials */
  size_t twofold;     /* materials that are declared twice */
  size_t textureless; /* materials, whose texture cannot be read */
  size_t unread;      /* properties of materials */
};

/* Notes that something is ignored, by the name of its material, mesh or light; a name once. False
 * without memory. */
bool scene_ignore(struct scene_loading *loading, enum scene_ignored kind, const char *name);

/* The same for a statement; what is no word is not noted. */
bool scene_ignore_statement(struct scene_loading *loading, const char *keyword);

/* Reads the cameras of a glTF file. */
enum result scene_gltf_cameras(struct scene_loading *loading, struct error *error);

struct aiScene;

/* Refuses extensions of glTF that we don't support. */
enum result scene_gltf_check(struct scene_loading *loading, struct error *error);

/* Read OBJ and PLY files into the scene. */
enum result scene_obj_read(struct scene_loading *loading, struct error *error);
enum result scene_ply_read(struct scene_loading *loading, struct error *error);

/* Fills in vertices and triangles; *used[material] tells which materials they have. */
enum result scene_import_meshes(struct scene_loading *loading, const struct aiScene *from,
                                bool *used, struct error *error);

/* Drops triangles that repeat another one: their corners are the same three points, in whatever
 * order. The first of them stays, and so does the order of the others. All must have an area. */
enum result scene_repair(struct scene_loading *loading, struct error *error);

/* Fills in those of the materials that are used, and their textures. */
enum result scene_import_materials(struct scene_loading *loading, const struct aiScene *from,
                                   const bool *used, struct error *error);

/* Has a triangle an area, and with it a unit normal by its corners? A height below the resolution
 * of single precision is none. */
bool scene_has_area(const double *const corner[3], double normal[3]);

/* `name`, relative to the folder of `path`; the caller frees it. NULL without memory. */
char *scene_beside(const char *path, const char *name);

/* The same; with / for the \ that programs on Windows write, where only that is a file. */
char *scene_find_beside(const char *path, const char *name);

/* Adds a texture unless it is there already; *number is its number. `path`, which is taken over, is
 * its file or, where `bytes` are given, what messages call it; `suffix` as of slab_image_read. */
enum result scene_add_texture(struct scene_loading *loading, char *path, const void *bytes,
                              size_t size, const char *suffix, int *number, struct error *error);

/* Refuses something that we don't support, or counts it where repairs are allowed. */
enum result scene_unread(struct scene_loading *loading, struct error *error, const char *format,
                         ...) __attribute__((format(printf, 3, 4)));

#endif
