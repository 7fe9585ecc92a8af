/* scene_faces.h - faces of any number of corners, as OBJ and PLY files have them, become the
 * triangles of a scene.
 *
 * Coordinates are doubles, in the file's frame; the scene's are in POV-Ray's (z mirrored). A face
 * of which one of the first corners sees all others is a fan around that one; others are
 * triangulated by scene_triangulate.cc, so that they cover what their outline encloses. Corners
 * share a vertex where position, normal and texture coordinates are the same. */
#ifndef SCENE_FACES_H
#define SCENE_FACES_H

#include "scene/scene_load.h"

/* Numbers from 0 of a position, a normal and texture coordinates; -1: none. */
struct scene_corner {
  int position, normal, uv;
};

struct scene_faces {
  struct scene_loading *loading;
  /* What corners name. Filled in by the reader; owned. */
  int positions, normals, uvs, position_room, normal_room, uv_room;
  double (*position)[3];
  double (*normal)[3];
  double (*uv)[2];
  /* What faces that come have. Filled in by the reader. */
  const char *mesh; /* name; "" without one */
  int material;     /* of the scene */
  size_t number;    /* line of an OBJ file, face of a PLY file */
  bool told_flat;   /* false when a mesh begins */
  /* The builder's own; owned. */
  int *vertex;        /* [positions]: the newest vertex there; -1: none */
  int (*made_of)[2];  /* [vertices]: normal and texture coordinates */
  int (*triangle)[3]; /* of a face, by its corners */
  int vertex_count, vertex_room, made_of_room, triangle_room;
};

/* Appends one of what corners name. RESULT_BAD beyond INT_MAX of them. */
enum result scene_faces_position(struct scene_faces *faces, const double xyz[3],
                                 struct error *error);
enum result scene_faces_normal(struct scene_faces *faces, const double xyz[3], struct error *error);
enum result scene_faces_uv(struct scene_faces *faces, const double uv[2], struct error *error);

/* Adds a face, whose corners may be changed. Refuses corners that are not there and coordinates
 * that are not finite; faces without area and those that cross themselves, which `repair` drops;
 * for SCENE_SURFACES, corners without a normal, instead of which `repair` gives the face flat ones,
 * and normals and texture coordinates that are not there, which it takes for none. */
enum result scene_faces_add(struct scene_faces *faces, struct scene_corner *corners, int count,
                            struct error *error);

/* "PATH:LINE: face of mesh 'NAME'" or "PATH: face NUMBER". */
enum result scene_faces_fail(const struct scene_faces *faces, const char *what,
                             struct error *error);

void scene_faces_free(struct scene_faces *faces);

/* The triangles within the outline of a face, by the numbers of its corners and wound like it:
 * the constrained Delaunay triangulation of the plane that is most parallel to it. Corners may
 * repeat, lie on other edges, and join holes by edges that run there and back. `normal` is of the
 * whole face, of any length but not zero; there is room for 2 `count` triangles. *crosses, and no
 * triangles, where the outline runs through itself or around anything but once. */
enum result scene_triangulate(const double (*corners)[3], int count, const double normal[3],
                              int (*triangles)[3], int *made, bool *crosses, struct error *error);

#endif
