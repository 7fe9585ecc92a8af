/* scene_load.h - what the files that load a scene share; scene.h is for everybody else.
 *
 * Each format is read by files of our own: OBJ and MTL by scene_obj.c and scene_mtl.c, PLY by
 * scene_ply.c, glTF by gltf.c. */
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
  int room[5]; /* of the scene's arrays, for scene_reserve */
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

/* Read files into the scene: triangles, materials, textures, cameras, and what is ignored. */
enum result gltf_load(struct scene_loading *loading, struct error *error);
enum result scene_obj_read(struct scene_loading *loading, struct error *error);
enum result scene_ply_read(struct scene_loading *loading, struct error *error);

/* May an array be so large? Only up to an eighth of the machine's memory, so that no file, and no
 * small one whose mesh is at many places, fills it: who does that is ended without a word. */
bool scene_fits(size_t count, size_t size);

/* array_reserve within that. */
bool scene_grow(void *array, int *room, size_t count, size_t size);

/* Makes room for so many more vertices and triangles. Refuses more than INT_MAX. */
enum result scene_reserve(struct scene_loading *loading, size_t vertices, size_t triangles,
                          struct error *error);

/* Drops triangles that repeat another one: their corners are the same three points, in whatever
 * order. The first of them stays, and so does the order of the others. All must have an area. */
enum result scene_repair(struct scene_loading *loading, struct error *error);

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
