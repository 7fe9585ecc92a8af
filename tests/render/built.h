/* built.h - scenes put together by hand, triangle by triangle, for shadow rays. */
#ifndef BUILT_H
#define BUILT_H

#include "scene/scene.h"
#include "shadow/occlusion.h"

enum { BUILT_MOST = 20000 }; /* vertices */

/* Points are moved by `offset` and then scaled. */
struct built {
  struct scene scene;
  double position[BUILT_MOST][3];
  int corners[BUILT_MOST][3];
  double scale, offset;
};

/* An empty one; free it. */
struct built *built_start(double scale, double offset);

/* The image of a point. */
void built_place(const struct built *built, const double x[3], double out[3]);

void built_triangle(struct built *built, const double a[3], const double b[3], const double c[3]);
void built_quad(struct built *built, const double (*x)[3]);

/* A square in the plane y + slope[0] x + slope[1] z, from -half to half in x and z. */
void built_floor(struct built *built, double y, const double slope[2], double half);

struct occlusion *built_occlusion(const struct built *built);

#endif
