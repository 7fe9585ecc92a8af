/* built.c - see built.h. */
#include "built.h"

#include <stdlib.h>

#include "testing.h"

struct built *built_start(double scale, double offset) {
  struct built *built = calloc(1, sizeof *built);
  assert_non_null(built);
  built->scene.position = built->position;
  built->scene.corners = built->corners;
  built->scale = scale;
  built->offset = offset;
  return built;
}

void built_place(const struct built *built, const double x[3], double out[3]) {
  for (int c = 0; c < 3; ++c) out[c] = (x[c] + built->offset) * built->scale;
}

void built_triangle(struct built *built, const double a[3], const double b[3], const double c[3]) {
  const double *x[3] = {a, b, c};
  assert_true(built->scene.vertices + 3 <= BUILT_MOST);
  for (int k = 0; k < 3; ++k) {
    built->corners[built->scene.triangles][k] = (int)built->scene.vertices;
    built_place(built, x[k], built->position[built->scene.vertices++]);
  }
  ++built->scene.triangles;
}

void built_quad(struct built *built, const double (*x)[3]) {
  built_triangle(built, x[0], x[1], x[2]);
  built_triangle(built, x[0], x[2], x[3]);
}

void built_floor(struct built *built, double y, const double slope[2], double half) {
  double x[4][3];
  for (int k = 0; k < 4; ++k) {
    x[k][0] = k == 1 || k == 2 ? half : -half;
    x[k][2] = k > 1 ? half : -half;
    x[k][1] = y + slope[0] * x[k][0] + slope[1] * x[k][2];
  }
  built_quad(built, (const double(*)[3])x);
}

struct occlusion *built_occlusion(const struct built *built) {
  struct occlusion *occlusion;
  struct error error = {""};
  if (occlusion_create(&built->scene, &occlusion, &error)) fail_msg("%s", error.text);
  return occlusion;
}
