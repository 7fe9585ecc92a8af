/* export_frame.h - lamp space in other programs, and the scene of the examples. Lamp space is
 * left-handed with y up. */
#ifndef EXPORT_FRAME_H
#define EXPORT_FRAME_H

#include <stdio.h>

#include "slab/slab.h"

/* A lamp point or vector in the space of another program. 0 stays 0, not -0. */
typedef void export_turn(const double lamp[3], double there[3]);

export_turn export_z_up; /* (x, z, y): right-handed, of Radiance and Blender */
export_turn export_y_up; /* (x, y, -z): right-handed, of Mitsuba, OBJ and glTF */

/* A square floor two aperture widths before a page, its side eight of them, seen from beside the
 * page at an angle of view of 75 degrees. */
struct export_scene {
  double floor[12]; /* corners, in order */
  double eye[3], target[3], up[3];
};

struct export_scene export_scene_of(const struct slab *slab, export_turn *turn);

/* For Mitsuba's XML: the 4x4 matrix of these columns, row by row; that which makes the square
 * [-1, 1]^2 at z = 0 the floor of a scene, a struct export_scene. */
void export_put_matrix(const double x[3], const double y[3], const double z[3],
                       const double origin[3], FILE *out);
void export_put_floor(const void *scene, FILE *out);

#endif
