/* oracle_views.c - the light of a single view as projective textures have it, in long double. */
#include <math.h>

#include "oracle.h"

static const long double single = 0x1p-22L; /* a few roundings to floats */

void oracle_place(const struct slab *slab, const double p[3], const double n[3],
                  struct oracle_place *place) {
  long double frame[3][3], square = 0;
  oracle_frame(slab, frame);
  for (int k = 0; k < 3; ++k) square += (long double)n[k] * (long double)n[k];
  for (int r = 0; r < 3; ++r) {
    place->p[r] = place->n[r] = 0;
    for (int k = 0; k < 3; ++k) {
      place->p[r] += frame[r][k] * ((long double)p[k] - (long double)slab->center[k]);
      place->n[r] += frame[r][k] * (long double)n[k] / sqrtl(square);
    }
  }
}

/* A ray from a view to the receiver. */
struct ray {
  struct oracle_place place;
  long double at[2]; /* of the view */
  long double st[2]; /* moves where the direction is looked up */
};

static long double length_of(const double edge[3]) {
  long double square = 0;
  for (int k = 0; k < 3; ++k) square += (long double)edge[k] * (long double)edge[k];
  return sqrtl(square);
}

static long double slope_of(const struct ray *ray, int axis) {
  return (ray->at[axis] - ray->place.p[axis]) / ray->place.p[2];
}

/* The direction in st, and in samples. */
static long double find_st(const struct slab *slab, const struct ray *ray, int axis,
                           long double *sample) {
  const double *window = slab->st_window + 2 * axis;
  const long double low = (long double)window[0], width = (long double)window[1] - low;
  const long double kappa = isinf(slab->st_distance) ? 0 : 1 / (long double)slab->st_distance;
  const long double s = kappa * ray->at[axis] - slope_of(ray, axis) + ray->st[axis];
  *sample = (s - low) / width * slab->samples[2 + axis] - 0.5L;
  return s;
}

/* Between the two nearest samples, or beside the outermost. Returns false outside the window. */
static bool find_samples(const struct slab *slab, const struct ray *ray, int axis, int sample[2],
                         long double weight[2]) {
  const int last = slab->samples[2 + axis] - 1;
  long double at;
  find_st(slab, ray, axis, &at);
  if (!(at >= -0.5L && at <= last + 0.5L)) return false;
  at = fminl(fmaxl(at, 0), last);
  sample[0] = (int)at < last ? (int)at : last;
  sample[1] = sample[0] < last ? sample[0] + 1 : last;
  weight[1] = at - sample[0];
  weight[0] = 1 - weight[1];
  return true;
}

static void look_up(const struct slab *slab, const struct ray *ray, int i, int j,
                    long double rgb[3]) {
  const long double *n = ray->place.n, x = slope_of(ray, 0), y = slope_of(ray, 1);
  const long double square = 1 + x * x + y * y, in = n[0] * x + n[1] * y - n[2];
  const long double area = length_of(slab->u) / slab->samples[SLAB_U] / ray->place.p[2] *
                           (length_of(slab->v) / slab->samples[SLAB_V] / ray->place.p[2]);
  int s[2], t[2];
  long double by_s[2], by_t[2];
  for (int c = 0; c < 3; ++c) rgb[c] = 0;
  if (!(ray->place.p[2] > 0) || !(in > 0)) return;
  if (!find_samples(slab, ray, 0, s, by_s) || !find_samples(slab, ray, 1, t, by_t)) return;
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 3; ++c)
      rgb[c] += by_s[k & 1] * by_t[k >> 1] * area * in / (square * square) *
                (long double)slab_at(slab, i, j, s[k & 1], t[k >> 1])[c];
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
    for (int c = 0; c < 3; ++c) most[c] = fmaxl(most[c], fabsl(moved[c] - middle[c]));
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
    for (int c = 0; c < 3; ++c) most[c] = fmaxl(most[c], fabsl(moved[c] - middle[c]));
  }
  for (int axis = 0; axis < 2; ++axis) ray->st[axis] = 0;
  for (int c = 0; c < 3; ++c) error[c] += most[c];
}

static void add_changes(const struct slab *slab, struct ray *ray, int i, int j,
                        long double error[3]) {
  const long double *p = ray->place.p, far = hypotl(hypotl(p[0], p[1]), p[2]);
  const long double kappa = isinf(slab->st_distance) ? 0 : 1 / (long double)slab->st_distance;
  long double by[2];
  for (int axis = 0; axis < 3; ++axis) {
    const long double at = axis < 2 ? fabsl(ray->at[axis]) : 0;
    add_change(slab, ray, &ray->place.p[axis], single * (far + at), i, j, error);
    add_change(slab, ray, &ray->place.n[axis], single, i, j, error);
    if (axis == 2) break;
    const double *window = slab->st_window + 2 * axis;
    const long double size = fabsl(kappa * at) + fabsl(slope_of(ray, axis)) +
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
    ray.at[axis] = share * length_of(axis ? slab->v : slab->u);
  }
  look_up(slab, &ray, i, j, rgb);
  if (!error) return;
  for (int c = 0; c < 3; ++c) error[c] = 0;
  add_changes(slab, &ray, i, j, error);
}
