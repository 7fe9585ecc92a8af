#include "batch/bake_rays.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

int bake_box_rays(const struct bake_box *box) {
  return box->size[SLAB_U] * box->size[SLAB_V] * box->size[SLAB_S] * box->size[SLAB_T];
}

enum { BITS = 32 };

/* Direction numbers of Sobol's sequence along one axis, after Joe and Kuo (2008): a
 * primitive polynomial of this degree and inner coefficients, and the first numbers. */
static void direction_numbers(int axis, uint32_t v[BITS]) {
  static const struct {
    int degree;
    uint32_t inner, first[3];
  } polynomials[SLAB_AXES] = {{0, 0, {0}}, {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}};
  int degree = polynomials[axis].degree;
  for (int n = 0; n < BITS; ++n) {
    if (degree == 0 || n < degree) {
      v[n] = (degree ? polynomials[axis].first[n] : 1) << (BITS - 1 - n);
      continue;
    }
    v[n] = v[n - degree] ^ v[n - degree] >> degree;
    for (int k = 1; k < degree; ++k)
      if (polynomials[axis].inner >> (degree - 1 - k) & 1) v[n] ^= v[n - k];
  }
}

/* Whether a box is of directions at a position, rather than of positions in a direction. */
static bool is_view(const struct bake_box *box) {
  return box->size[SLAB_U] == 1 && box->size[SLAB_V] == 1;
}

/* A camera's own digital shift along an axis: a hash (splitmix64) of its place. */
static uint32_t own_shift(const struct bake_box *box, int axis) {
  bool view = is_view(box);
  uint64_t x = (uint64_t)(view ? box->first[SLAB_U] : box->first[SLAB_S]);
  uint64_t y = (uint64_t)(view ? box->first[SLAB_V] : box->first[SLAB_T]);
  uint64_t z = ((uint64_t)box->page * 4 + (uint64_t)axis) << 48 ^ y << 24 ^ x;
  z += 0x9e3779b97f4a7c15;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return (uint32_t)((z ^ z >> 31) >> 32);
}

/* Sobol's sequence: of 2^m points each of 2^m equal slices of the cell holds one, along
 * every axis, which matters since a lamp's bars and edges lie along the axes. The common
 * digital shift 0.010101... puts the points a third of a slice away from its ends for every
 * m, so that the mirrored ones fill the gaps. The first two points lie on a diagonal of
 * the cell, along which edges behind the aperture run too (there u and s go together); so the
 * second pair is mirrored along s and t, which changes nothing along any one axis.
 *
 * S. Joe and F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional projections",
 * SIAM Journal on Scientific Computing 30, 2008. */
void bake_offset(enum bake_offsets kind, const struct bake_box *box, int pass,
                 double offset[SLAB_AXES]) {
  bool search = pass == BAKE_SEARCH;
  int pair = search ? 0 : pass / 2;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    bool covered = is_view(box) == (axis >= SLAB_S);
    uint32_t v[BITS] = {0}, bits = kind == BAKE_OWN ? own_shift(box, axis) : 0x55555555;
    direction_numbers(axis, v);
    for (int n = 0; n < BITS; ++n)
      if ((uint32_t)pair >> n & 1) bits ^= v[n];
    double from_middle = ((double)bits + 0.5) * 0x1p-32 - 0.5;
    bool mirrored = (pass > 0 && pass % 2 == 1) != (pair == 1 && axis >= SLAB_S);
    bool middle = kind == BAKE_CENTRE || (search && !covered);
    offset[axis] = middle ? 0 : mirrored ? -from_middle : from_middle;
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
