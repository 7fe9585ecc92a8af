/* scene_load.h - what the files that load a scene share; scene.h is for everybody else.
 *
 * assimp gives the geometry, and glTF's materials. Its reading of OBJ's materials hides what
 * is missing (it invents a grey one), so scene_text.c reads MTL files itself. */
#ifndef SCENE_LOAD_H
#define SCENE_LOAD_H

#include "base/array.h"
#include "scene/scene.h"

enum scene_format { SCENE_OBJ, SCENE_GLTF, SCENE_PLY };

struct scene_mtl {
  struct scene_material material;
  bool has_diffuse, has_texture;
  bool transparent, see_through, bumps; /* d or Tr, map_d, bump maps: ignored */
  bool has_opacity;                     /* d, which decides whatever Tr says */
  char texture[1024];                   /* as the file names it */
};

struct scene_loading {
  const char *path;
  enum scene_format format;
  enum scene_needs needs;
  bool repair;
  struct scene *scene;
  struct scene_mtl *mtl; /* what MTL files declare; owned */
  int mtl_count, mtl_room;
  /* what was repaired */
  size_t dropped;  /* triangles without area */
  size_t repeated; /* triangles, dropped too */
  size_t flat;     /* meshes */
  size_t white;    /* materials */
  size_t unread;   /* properties of materials */
};

/* Notes that something is ignored, by the name of its material, mesh or light; a name once. False
 * without memory. */
bool scene_ignore(struct scene_loading *loading, enum scene_ignored kind, const char *name);

/* Reads the cameras of a glTF file. */
enum result scene_gltf_cameras(struct scene_loading *loading, struct error *error);

struct aiScene;

/* Reads what assimp hides: in OBJ and its MTL files, what is no number, materials, and what
 * we don't support; in glTF, extensions that we don't support. */
enum result scene_text_read(struct scene_loading *loading, struct error *error);

/* Refuses a PLY file that ends too early: assimp would look for the end of the header for
 * ever, read binary data beyond the end of the file, and make room for whatever is claimed. */
enum result scene_ply_check(const char *path, struct error *error);

/* The MTL material of that name, or NULL. */
const struct scene_mtl *scene_text_material(const struct scene_loading *loading, const char *name);

/* Fills in vertices and triangles; *used[material] tells which materials they have. */
enum result scene_import_meshes(struct scene_loading *loading, const struct aiScene *from,
                                bool *used, struct error *error);

/* Drops triangles that repeat another one: their corners are the same three points, in whatever
 * order. The first of them stays, and so does the order of the others. All must have an area. */
enum result scene_repair(struct scene_loading *loading, struct error *error);

/* Fills in those of the materials that are used, and their textures. */
enum result scene_import_materials(struct scene_loading *loading, const struct aiScene *from,
                                   const bool *used, struct error *error);

/* `name`, relative to the folder of `path`; the caller frees it. NULL without memory. */
char *scene_beside(const char *path, const char *name);

/* Refuses something that we don't support, or counts it where repairs are allowed. */
enum result scene_unread(struct scene_loading *loading, struct error *error, const char *format,
                         ...) __attribute__((format(printf, 3, 4)));

#endif
