/* meshes.h - what the tests of meshes and of their textures share. */
#ifndef MESHES_H
#define MESHES_H

#include "scene/scene.h"

/* A file with this text among the scratch files. */
const char *meshes_write(const char *name, const char *text);

/* Loads a mesh, or fails the test; `note` as of scene_load, or NULL. */
struct scene meshes_load(const char *path, enum scene_needs needs, bool repair, char note[256]);

/* The mesh must be refused: one line that holds the piece, and nothing is loaded. */
void meshes_refused(const char *path, enum scene_needs needs, bool repair, const char *piece);

/* The corners of a rectangle in OBJ, with a normal of it. */
#define MESHES_CORNERS "v 0 0 0\nv 2 0 0\nv 2 1 3\nv 0 1 3\nvn 0 3 -1\n"

/* A glTF file of one triangle (0,0,0) (1,0,0) (0,1,0) with normals z and uv (0,0) (1,0) (0,1) from
 * the top: with more of its node, of its primitive, and of the file. */
const char *meshes_gltf(const char *name, const char *node, const char *primitive,
                        const char *rest);

#endif
