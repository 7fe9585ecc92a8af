/* bake_rays.c - see bake_rays.h. */
#include "bake_rays.h"

#include <math.h>
#include <string.h>

int bake_box_rays(const struct bake_box *box) {
  return box->size[SLAB_U] * box->size[SLAB_V] * box->size[SLAB_S] * box->size[SLAB_T];
}

/* Kronecker sequence of the generalised golden ratio in four dimensions, the root
 * of x^5 = x + 1: every prefix of it fills the cell evenly, so that blocks may stop
 * after different numbers of passes. */
void bake_offset(int pass, bool centre, double offset[SLAB_AXES]) {
  static const double step[SLAB_AXES] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378086,
                                         0.5385972572236100};
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    double x = 0.5 + (pass / 2 + 1) * step[axis];
    double from_middle = x - floor(x) - 0.5;
    offset[axis] = centre ? 0 : pass % 2 ? -from_middle : from_middle;
  }
}

/* Unit vectors along u and v. */
static void unit_axes(const struct slab *slab, double u[3], double v[3]) {
  double lu = sqrt(slab->u[0] * slab->u[0] + slab->u[1] * slab->u[1] + slab->u[2] * slab->u[2]);
  double lv = sqrt(slab->v[0] * slab->v[0] + slab->v[1] * slab->v[1] + slab->v[2] * slab->v[2]);
  for (int n = 0; n < 3; ++n) {
    u[n] = slab->u[n] / lu;
    v[n] = slab->v[n] / lv;
  }
}

/* Grid coordinate of the middle of the box along an axis, moved by the offset. */
static double middle(const struct slab *slab, const struct bake_box *box, int axis, double offset) {
  double spacing = slab_spacing(slab, axis);
  double first = slab_position(slab, axis, box->first[axis]);
  double last = slab_position(slab, axis, box->first[axis] + box->size[axis] - 1);
  return 0.5 * (first + last) + offset * spacing;
}

void bake_camera(const struct slab *slab, const struct bake_box *box,
                 const double offset[SLAB_AXES], struct bake_camera *camera) {
  double u[3], v[3], at[SLAB_AXES];
  unit_axes(slab, u, v);
  for (int axis = 0; axis < SLAB_AXES; ++axis) at[axis] = middle(slab, box, axis, offset[axis]);
  double kappa = slab_kappa(slab);
  double s = at[SLAB_S] - kappa * at[SLAB_U], t = at[SLAB_T] - kappa * at[SLAB_V];
  *camera = (struct bake_camera){.orthographic = box->size[SLAB_U] * box->size[SLAB_V] > 1};
  int x = camera->orthographic ? SLAB_U : SLAB_S, y = camera->orthographic ? SLAB_V : SLAB_T;
  camera->width = box->size[x];
  camera->height = box->size[y];
  double span_x = camera->width * slab_spacing(slab, x),
         span_y = camera->height * slab_spacing(slab, y);
  for (int n = 0; n < 3; ++n) {
    camera->origin[n] = slab->center[n] + at[SLAB_U] * u[n] + at[SLAB_V] * v[n];
    camera->toward[n] = slab->normal[n] + s * u[n] + t * v[n];
    camera->across[n] = span_x * u[n];
    camera->down[n] = span_y * v[n];
  }
}

double bake_mesh_epsilon(int width, int height) {
  int exponent;
  frexp(fmax(width, height), &exponent); /* below 2^exponent */
  return ldexp(1, -14 - exponent);
}

/* The mesh's normals are (K e, L e, 1), and POV-Ray turns a normal by the inverse of
 * the matrix: its columns must be -(h_s/e) u', -(h_t/e) v' and -toward, with h half a
 * cell. The rows below are the dual basis of these. */
void bake_camera_matrix(const struct slab *slab, const struct bake_camera *camera,
                        double rows[4][3]) {
  double u[3], v[3];
  unit_axes(slab, u, v);
  double e = bake_mesh_epsilon(camera->width, camera->height);
  double hs = 0.5 * slab_spacing(slab, SLAB_S), ht = 0.5 * slab_spacing(slab, SLAB_T);
  double s = 0, t = 0;
  for (int n = 0; n < 3; ++n) {
    s += u[n] * camera->toward[n];
    t += v[n] * camera->toward[n];
  }
  for (int n = 0; n < 3; ++n) {
    rows[0][n] = -e / hs * (u[n] - s * slab->normal[n]);
    rows[1][n] = -e / ht * (v[n] - t * slab->normal[n]);
    rows[2][n] = -slab->normal[n];
    rows[3][n] = camera->origin[n];
  }
}
