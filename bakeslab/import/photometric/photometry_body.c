#include "import/photometric/photometry_body.h"

#include <math.h>
#include <string.h>

enum { ROWS = 32 }; /* of a face, for areas that have no closed form */

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The face towards `sign` of an axis; its v is up or, of horizontal ones, along z. */
static void set_face(struct photometry_face *face, const double size[3], int axis, int sign) {
  int along = axis == 0 ? 2 : 0, across = axis == 1 ? 2 : 1;
  *face = (struct photometry_face){0};
  face->normal[axis] = sign;
  face->center[axis] = sign * size[axis] / 2;
  face->u[along] = face->size[0] = size[along];
  face->v[across] = face->size[1] = size[across];
  if (!(face->size[0] > 0 && face->size[1] > 0)) face->size[0] = face->size[1] = 0;
}

/* Sides of a box may end below its top. */
static void lower_sides(const struct photometry *lamp, struct photometry_body *body) {
  for (int k = 0; k < 4; ++k) {
    struct photometry_face *face = &body->face[2 + k];
    face->v[1] = face->size[1] = lamp->side[k];
    face->center[1] = (lamp->side[k] - body->size[1]) / 2;
    if (!(face->size[1] > 0)) face->size[0] = face->size[1] = 0;
  }
}

static double middle_of(const double size[3]) {
  double least = fmin(size[0], fmin(size[1], size[2]));
  double most = fmax(size[0], fmax(size[1], size[2]));
  return size[0] + size[1] + size[2] - least - most;
}

static void set_sizes(const struct photometry *lamp, bool thick, struct photometry_body *body) {
  double *size = body->size, longest = fmax(lamp->size[0], fmax(lamp->size[1], lamp->size[2]));
  int zeros = 0, flat = lamp->type == PHOTOMETRY_A ? 0 : 1; /* along which it has no size */
  memcpy(size, lamp->size, sizeof body->size);
  for (int k = 0; k < 3; ++k) zeros += !(size[k] > 0);
  for (int k = 0; k < 3 && zeros == 3; ++k)
    if (thick || k != flat) size[k] = PHOTOMETRY_POINT_SIZE;
  for (int k = 0; k < 3 && zeros == 2; ++k)
    if (!(size[k] > 0) && (thick || k != flat)) size[k] = longest * BODY_THIN;
  if (zeros < 2 && thick)
    for (int k = 0; k < 3; ++k) size[k] = fmax(size[k], middle_of(lamp->size) * BODY_THIN);
}

void photometry_body(const struct photometry *lamp, bool thick, struct photometry_body *body) {
  static const int axis[BODY_FACES] = {1, 1, 0, 2, 0, 2}, sign[BODY_FACES] = {-1, 1, 1, 1, -1, -1};
  *body = (struct photometry_body){.shape = lamp->shape, .axis = lamp->axis};
  if (body->shape == PHOTOMETRY_POINT) body->shape = PHOTOMETRY_BOX;
  set_sizes(lamp, thick, body);
  for (int f = 0; f < BODY_FACES; ++f) set_face(&body->face[f], body->size, axis[f], sign[f]);
  if (lamp->shape == PHOTOMETRY_BOX && body->size[1] == lamp->size[1] && lamp->size[1] > 0)
    lower_sides(lamp, body);
}

/* A disc, or an upright one. */
static bool is_flat(const struct photometry_body *body) {
  return body->shape == PHOTOMETRY_CYLINDER && !(body->size[body->axis] > 0);
}

bool photometry_is_even(const struct photometry_body *body) {
  return body->shape == PHOTOMETRY_BOX || is_flat(body);
}

bool photometry_runs_along(const struct photometry_body *body, int face, int axis) {
  const double *edge = axis == 0 ? body->face[face].u : body->face[face].v;
  return body->shape == PHOTOMETRY_CYLINDER && body->size[body->axis] > 0 && edge[body->axis] != 0;
}

bool photometry_is_thin(const struct photometry_body *body) {
  const double *size = body->size;
  return fmin(size[0], fmin(size[1], size[2])) < middle_of(size) * BODY_THIN;
}

double photometry_area(const struct photometry_body *body, const double direction[3]) {
  const double *size = body->size, *d = direction;
  double sum = 0;
  if (body->shape == PHOTOMETRY_BOX) {
    for (int f = 0; f < BODY_FACES; ++f) sum += photometry_face_area(body, f, d);
  } else if (body->shape == PHOTOMETRY_ELLIPSOID) {
    sum = M_PI / 4 *
          sqrt(pow(size[1] * size[2] * d[0], 2) + pow(size[0] * size[2] * d[1], 2) +
               pow(size[0] * size[1] * d[2], 2));
  } else {
    int n = body->axis, k = (n + 1) % 3, l = (n + 2) % 3;
    sum =
        M_PI / 4 * size[k] * size[l] * fabs(d[n]) + size[n] * hypot(size[k] * d[l], size[l] * d[k]);
  }
  return sum;
}

double photometry_face_area(const struct photometry_body *body, int face,
                            const double direction[3]) {
  const struct photometry_face *at = &body->face[face];
  double cosine = dot(direction, at->normal), sum = 0, ends[2];
  if (!(cosine > 0) || !(at->size[0] > 0)) return 0;
  if (body->shape == PHOTOMETRY_BOX) return at->size[0] * at->size[1] * cosine;
  if (is_flat(body)) return M_PI / 4 * at->size[0] * at->size[1] * cosine;
  for (int row = 0; row < ROWS; ++row)
    if (photometry_row(body, face, direction, ((row + 0.5) / ROWS - 0.5) * at->size[1], ends))
      sum += ends[1] - ends[0];
  return sum * at->size[1] / ROWS * cosine;
}

/* A quadratic q[0] + 2 q[1] x + q[2] x2 <= 0 with q[2] > 0, or any x with q[2] = 0. */
static bool solve(const double q[3], double from_to[2]) {
  if (!(q[2] > 0)) return q[0] <= 0;
  double root = q[1] * q[1] - q[0] * q[2];
  if (root < 0) return false;
  from_to[0] = (-q[1] - sqrt(root)) / q[2];
  from_to[1] = (-q[1] + sqrt(root)) / q[2];
  return true;
}

/* Widens a range by another. */
static void join(double range[2], bool *any, const double other[2]) {
  range[0] = *any ? fmin(range[0], other[0]) : other[0];
  range[1] = *any ? fmax(range[1], other[1]) : other[1];
  *any = true;
}

/* Narrows a range to where low <= p + x m <= high. */
static bool clip(double range[2], double p, double m, double low, double high) {
  if (m == 0) return p >= low && p <= high;
  double x = (low - p) / m, y = (high - p) / m;
  range[0] = fmax(range[0], fmin(x, y));
  range[1] = fmin(range[1], fmax(x, y));
  return range[0] <= range[1];
}

/* Rays p + x m + any part of d that meet the unit sphere. */
static bool meet_sphere(const double p[3], const double m[3], const double d[3], double range[2]) {
  double dd = dot(d, d), pd = dot(p, d), md = dot(m, d), found[2] = {-INFINITY, INFINITY};
  double q[3] = {dot(p, p) - 1 - pd * pd / dd, dot(p, m) - pd * md / dd, dot(m, m) - md * md / dd};
  if (!solve(q, found)) return false;
  range[0] = fmax(range[0], found[0]);
  range[1] = fmin(range[1], found[1]);
  return range[0] <= range[1];
}

/* Those that meet the cylinder of unit radius along axis n, from -1 to 1 there. The shadow of the
 * cylinder along d is that of its two ends and of what is between them: the range where a ray meets
 * either end's disc, or passes the axis nearer than 1 between the two. */
static bool meet_cylinder(const double p[3], const double m[3], const double d[3], int n,
                          double range[2]) {
  int k = (n + 1) % 3, l = (n + 2) % 3;
  double found[2] = {0, 0}, across = hypot(d[k], d[l]);
  bool any = false;
  /* The ends are seen, not edge on: far along a ray their discs would drown in roundings. */
  for (int end = -1; end <= 1 && fabs(d[n]) > 1e-6 * across; end += 2) {
    /* where the ray meets the end's plane: q + x w */
    double step = (end - p[n]) / d[n], back = -m[n] / d[n], disc[2] = {-INFINITY, INFINITY};
    double q[2] = {p[k] + step * d[k], p[l] + step * d[l]};
    double w[2] = {m[k] + back * d[k], m[l] + back * d[l]};
    double form[3] = {q[0] * q[0] + q[1] * q[1] - 1, q[0] * w[0] + q[1] * w[1],
                      w[0] * w[0] + w[1] * w[1]};
    if (solve(form, disc)) join(found, &any, disc);
  }
  if (across > 0) {
    double side[2] = {-INFINITY, INFINITY}, e[2] = {d[k] / across, d[l] / across};
    /* the height of the ray where it is nearest to the axis, and its distance there */
    double near_p = -(p[k] * e[0] + p[l] * e[1]) / across;
    double near_m = -(m[k] * e[0] + m[l] * e[1]) / across;
    if (clip(side, p[k] * e[1] - p[l] * e[0], m[k] * e[1] - m[l] * e[0], -1, 1) &&
        clip(side, p[n] + near_p * d[n], m[n] + near_m * d[n], -1, 1))
      join(found, &any, side);
  }
  if (!any) return false;
  range[0] = fmax(range[0], found[0]);
  range[1] = fmin(range[1], found[1]);
  return range[0] <= range[1];
}

/* In coordinates in which the body's half sizes are 1. */
bool photometry_row(const struct photometry_body *body, int face, const double direction[3],
                    double b, double from_to[2]) {
  const struct photometry_face *at = &body->face[face];
  double p[3], m[3], d[3];
  from_to[0] = -at->size[0] / 2;
  from_to[1] = at->size[0] / 2;
  if (body->shape == PHOTOMETRY_BOX) return true;
  for (int k = 0; k < 3; ++k) {
    double half = body->size[k] > 0 ? body->size[k] / 2 : 1;
    p[k] = (at->center[k] + b * at->v[k] / at->size[1]) / half;
    m[k] = at->u[k] / at->size[0] / half;
    d[k] = direction[k] / half;
  }
  if (body->shape == PHOTOMETRY_ELLIPSOID) return meet_sphere(p, m, d, from_to);
  if (is_flat(body)) d[0] = d[1] = d[2] = 0, d[body->axis] = 1;
  return meet_cylinder(p, m, d, body->axis, from_to);
}
