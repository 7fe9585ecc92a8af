/* scene_build.h - adds meshes of triangles to a scene, in double precision.
 *
 * A mesh is in coordinates of its own, right-handed as its file's; `place` (rows of a 3 x 4 matrix)
 * puts it into POV-Ray's, so it mirrors. Normals go with the cofactors of `place`, which are right
 * for any scale, and triangles keep the side that they show.
 *
 * Refuses, without the path of the file before the message: corners that are no vertex, numbers
 * that are not finite, triangles without area and, where surfaces are wanted, meshes without
 * normals (or, with `repair`, does as scene.h says). */
#ifndef SCENE_BUILD_H
#define SCENE_BUILD_H

#include "scene/scene_load.h"

struct scene_mesh {
  const char *name;
  size_t vertices, triangles;
  double (*position)[3];
  double (*normal)[3]; /* any length; NULL: none */
  double (*uv)[2];     /* v up; NULL: none */
  int (*corners)[3];
  int material;
};

enum result scene_build(struct scene_loading *loading, const struct scene_mesh *mesh,
                        double place[3][4], struct error *error);

#endif
