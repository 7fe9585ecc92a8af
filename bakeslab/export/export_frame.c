#include "export/export_frame.h"

#include "slab/plane.h"

void export_z_up(const double lamp[3], double there[3]) {
  there[0] = lamp[0];
  there[1] = lamp[2];
  there[2] = lamp[1];
}

void export_y_up(const double lamp[3], double there[3]) {
  there[0] = lamp[0];
  there[1] = lamp[1];
  there[2] = 0 - lamp[2];
}

struct export_scene export_scene_of(const struct slab *slab, export_turn *turn) {
  struct export_scene scene;
  double width = plane_width(slab), corner[3], eye[3], target[3], up[3];
  for (int k = 0; k < 4; ++k) {
    double x = k == 1 || k == 2 ? 4 : -4, y = k > 1 ? 4 : -4;
    for (int c = 0; c < 3; ++c)
      corner[c] = slab->center[c] +
                  width * (2 * slab->normal[c] + x * slab->u[c] / plane_edge(slab, SLAB_U) +
                           y * slab->v[c] / plane_edge(slab, SLAB_V));
    turn(corner, scene.floor + 3 * k);
  }
  for (int c = 0; c < 3; ++c) {
    eye[c] = slab->center[c] -
             width * (1.5 * slab->normal[c] + 4 * slab->v[c] / plane_edge(slab, SLAB_V));
    target[c] = slab->center[c] + 2 * width * slab->normal[c];
    up[c] = 0 - slab->normal[c];
  }
  turn(eye, scene.eye);
  turn(target, scene.target);
  turn(up, scene.up);
  return scene;
}

void export_put_matrix(const double x[3], const double y[3], const double z[3],
                       const double origin[3], FILE *out) {
  for (int c = 0; c < 3; ++c) fprintf(out, "%.15g %.15g %.15g %.15g ", x[c], y[c], z[c], origin[c]);
  fputs("0 0 0 1", out);
}

void export_put_floor(const void *of, FILE *out) {
  const struct export_scene *scene = of;
  const double *corners = scene->floor;
  double x[3], y[3], middle[3];
  for (int c = 0; c < 3; ++c) {
    x[c] = (corners[3 + c] - corners[c]) / 2;
    y[c] = (corners[9 + c] - corners[c]) / 2;
    middle[c] = (corners[6 + c] + corners[c]) / 2;
  }
  export_put_matrix(x, y, scene->up, middle, out);
}
