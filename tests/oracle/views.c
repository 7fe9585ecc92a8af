/* views.c - see oracle.h: the light of a single view as projective textures have it. */
#include <math.h>

#include "oracle/lookup.h"
#include "oracle/oracle.h"

static const long double single = 0x1p-22L; /* a few roundings to floats */

/* A ray from a view to the receiver. */
struct ray {
  struct oracle_place place;
  long double at[2]; /* of the view */
  long double st[2]; /* moves where the direction is looked up */
};

static long double slope_of(const struct ray *ray, int axis) {
  return (ray->at[axis] - ray->place.p[axis]) / ray->place.p[2];
}

static void look_up(const struct slab *slab, const struct ray *ray, int i, int j,
                    long double rgb[3]) {
  const struct oracle_place *to = &ray->place;
  const long double x = slope_of(ray, 0), y = slope_of(ray, 1), square = 1 + x * x + y * y;
  const long double in = to->n[0] * x + to->n[1] * y - to->n[2];
  const long double area = 2 * to->half[0] / slab->samples[SLAB_U] / to->p[2] *
                           (2 * to->half[1] / slab->samples[SLAB_V] / to->p[2]);
  for (int c = 0; c < 3; ++c) rgb[c] = 0;
  if (!(to->p[2] > 0) || !(in > 0)) return;
  oracle_lookup_view(slab, i, j, to->kappa * ray->at[0] - x + ray->st[0],
                     to->kappa * ray->at[1] - y + ray->st[1], rgb);
  for (int c = 0; c < 3; ++c) rgb[c] *= area * in / (square * square);
}

/* The change to both sides, the larger one. */
static void add_change(const struct slab *slab, const struct ray *ray, long double *number,
                       long double by, int i, int j, long double error[3]) {
  long double middle[3], moved[3], most[3] = {0};
  const long double from = *number;
  look_up(slab, ray, i, j, middle);
  for (int sign = -1; sign <= 1; sign += 2) {
    *number = from + sign * by;
    look_up(slab, ray, i, j, moved);
    for (int c = 0; c < 3; ++c) most[c] = oracle_larger(most[c], fabsl(moved[c] - middle[c]));
  }
  *number = from;
  for (int c = 0; c < 3; ++c) error[c] += most[c];
}

/* Both directions at once: in the window's corners neither alone brings light. */
static void add_corners(const struct slab *slab, struct ray *ray, const long double by[2], int i,
                        int j, long double error[3]) {
  long double middle[3], moved[3], most[3] = {0};
  look_up(slab, ray, i, j, middle);
  for (int corner = 0; corner < 4; ++corner) {
    for (int axis = 0; axis < 2; ++axis) ray->st[axis] = corner >> axis & 1 ? by[axis] : -by[axis];
    look_up(slab, ray, i, j, moved);
    for (int c = 0; c < 3; ++c) most[c] = oracle_larger(most[c], fabsl(moved[c] - middle[c]));
  }
  for (int axis = 0; axis < 2; ++axis) ray->st[axis] = 0;
  for (int c = 0; c < 3; ++c) error[c] += most[c];
}

static void add_changes(const struct slab *slab, struct ray *ray, int i, int j,
                        long double error[3]) {
  const long double *p = ray->place.p, far = hypotl(hypotl(p[0], p[1]), p[2]);
  long double by[2];
  for (int axis = 0; axis < 3; ++axis) {
    const long double at = axis < 2 ? fabsl(ray->at[axis]) : 0;
    add_change(slab, ray, &ray->place.p[axis], single * (far + at), i, j, error);
    add_change(slab, ray, &ray->place.n[axis], single, i, j, error);
    if (axis == 2) break;
    const double *window = slab->st_window + 2 * axis;
    const long double size = fabsl(ray->place.kappa * at) + fabsl(slope_of(ray, axis)) +
                             (long double)fabs(window[0]) + (long double)fabs(window[1]);
    by[axis] = single * size;
  }
  add_corners(slab, ray, by, i, j, error);
}

void oracle_view(const struct slab *slab, const struct oracle_place *place, int i, int j,
                 long double rgb[3], long double error[3]) {
  const int index[2] = {i, j};
  struct ray ray = {.place = *place};
  for (int axis = 0; axis < 2; ++axis) {
    const long double share = (index[axis] + 0.5L) / slab->samples[axis] - 0.5L;
    ray.at[axis] = 2 * share * place->half[axis];
  }
  look_up(slab, &ray, i, j, rgb);
  if (!error) return;
  for (int c = 0; c < 3; ++c) error[c] = 0;
  add_changes(slab, &ray, i, j, error);
}
