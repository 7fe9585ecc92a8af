#include "slab/slab.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* How far from perpendicular, or from unit length, a frame may be: scripts
 * print it with a few digits. */
static const double frame_tolerance = 1e-6;

/* Most pixels along a side of the raster: containers add a tile to it. */
enum { LARGEST_SIDE = INT_MAX / 16 };

static double dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* hypot neither overflows nor underflows, whatever the unit of length. */
static double length(const double x[3]) {
  return hypot(hypot(x[0], x[1]), x[2]);
}

static bool finite3(const double x[3]) {
  return isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]);
}

struct slab slab_default(void) {
  struct slab slab = {.samples = {1, 1, 1, 1},
                      .u = {1, 0, 0},
                      .v = {0, 0, 1},
                      .normal = {0, -1, 0},
                      .st_window = {-1, 1, -1, 1},
                      .st_distance = INFINITY,
                      .metres_per_unit = 1,
                      .radiance_unit = "relative"};
  return slab;
}

void slab_free(struct slab *slab) {
  if (!slab) return;
  free(slab->json);
  free(slab->rgb);
  memset(slab, 0, sizeof *slab);
}

static enum result check_samples(const struct slab *slab, struct error *error) {
  static const char *const axes[SLAB_AXES] = {"u", "v", "s", "t"};
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    if (slab->samples[axis] < 1)
      return result_fail(error, RESULT_BAD, "samples along %s are %d, must be at least 1",
                         axes[axis], slab->samples[axis]);
  if (slab->samples[SLAB_U] > LARGEST_SIDE / slab->samples[SLAB_S] ||
      slab->samples[SLAB_V] > LARGEST_SIDE / slab->samples[SLAB_T])
    return result_fail(error, RESULT_BAD, "samples %d x %d x %d x %d are too many for one raster",
                       slab->samples[0], slab->samples[1], slab->samples[2], slab->samples[3]);
  return RESULT_OK;
}

static enum result check_frame(const struct slab *slab, struct error *error) {
  const double *vectors[3] = {slab->u, slab->v, slab->normal};
  static const char *const names[3] = {"u", "v", "normal"};
  if (!finite3(slab->center)) return result_fail(error, RESULT_BAD, "center is not finite");
  double unit[3][3];
  for (int k = 0; k < 3; ++k) {
    double size = length(vectors[k]);
    if (!finite3(vectors[k]) || !isfinite(size))
      return result_fail(error, RESULT_BAD, "%s is not finite", names[k]);
    if (size <= 0) return result_fail(error, RESULT_BAD, "%s has zero length", names[k]);
    for (int c = 0; c < 3; ++c) unit[k][c] = vectors[k][c] / size;
  }
  if (fabs(length(slab->normal) - 1) > frame_tolerance)
    return result_fail(error, RESULT_BAD, "normal has length %g, must be 1", length(slab->normal));
  for (int k = 0; k < 3; ++k) {
    int other = (k + 1) % 3;
    if (fabs(dot(unit[k], unit[other])) > frame_tolerance)
      return result_fail(error, RESULT_BAD, "%s and %s are not perpendicular", names[k],
                         names[other]);
  }
  double area = length(slab->u) * length(slab->v);
  if (!(area > 0) || !isfinite(area))
    return result_fail(error, RESULT_BAD, "u and v span the area %g, must be positive and finite",
                       area);
  return RESULT_OK;
}

/* Window, distance and unit of length; all that is computed of them is finite. */
static enum result check_window(const struct slab *slab, struct error *error) {
  const double *w = slab->st_window, unit = slab->metres_per_unit;
  for (int k = 0; k < 4; ++k)
    if (!isfinite(w[k])) return result_fail(error, RESULT_BAD, "st_window is not finite");
  if (!(w[1] > w[0]) || !(w[3] > w[2]) || !isfinite(w[1] - w[0]) || !isfinite(w[3] - w[2]))
    return result_fail(error, RESULT_BAD, "st_window [%g, %g, %g, %g] is empty", w[0], w[1], w[2],
                       w[3]);
  if (!(slab->st_distance > 0))
    return result_fail(error, RESULT_BAD, "st_distance is %g, must be positive or null",
                       slab->st_distance);
  if (!isfinite(slab_kappa(slab) * length(slab->u)) ||
      !isfinite(slab_kappa(slab) * length(slab->v)) || !isfinite(slab_kappa(slab)))
    return result_fail(error, RESULT_BAD, "st_distance %g is too small to divide by",
                       slab->st_distance);
  if (!(unit > 0) || !isfinite(unit))
    return result_fail(error, RESULT_BAD, "metres_per_unit is %g, must be positive", unit);
  if (!(unit * unit > 0) || !isfinite(unit * unit * length(slab->u) * length(slab->v)))
    return result_fail(error, RESULT_BAD, "metres_per_unit %g is too small or too large to square",
                       unit);
  return RESULT_OK;
}

enum result slab_check(const struct slab *slab, struct error *error) {
  enum result result = check_samples(slab, error);
  if (result == RESULT_OK) result = check_frame(slab, error);
  if (result == RESULT_OK) result = check_window(slab, error);
  if (result != RESULT_OK) return result;
  static const char *const units[] = {"W/(sr m2)", "cd/m2", "relative"};
  for (size_t k = 0; k < sizeof units / sizeof *units; ++k)
    if (!strcmp(slab->radiance_unit, units[k])) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "radiance_unit is \"%s\", must be \"W/(sr m2)\", \"cd/m2\" or \"relative\"",
                     slab->radiance_unit);
}

enum result slab_alloc(struct slab *slab, struct error *error) {
  enum result result = check_samples(slab, error);
  if (result != RESULT_OK) return result;
  size_t count = slab_sample_count(slab), pixel = 3 * sizeof(float);
  float *rgb = count < SIZE_MAX / pixel - SLAB_PADDING
                   ? calloc(1, count * pixel + SLAB_PADDING * sizeof(float))
                   : NULL;
  if (!rgb)
    return result_fail(error, RESULT_MEMORY, "out of memory for %d x %d x %d x %d samples",
                       slab->samples[0], slab->samples[1], slab->samples[2], slab->samples[3]);
  free(slab->rgb);
  slab->rgb = rgb;
  return RESULT_OK;
}

enum result slab_copy_geometry(const struct slab *from, struct slab *to, struct error *error) {
  struct slab copy = *from;
  copy.rgb = NULL;
  if (from->json) {
    copy.json = strdup(from->json);
    if (!copy.json) return result_no_memory(error);
  }
  *to = copy;
  return RESULT_OK;
}

bool slab_same_channel(const struct slab *a, const struct slab *b) {
  return !strcmp(a->channel, b->channel);
}

bool slab_alike(const struct slab *a, const struct slab *b) {
  bool alike = a->st_distance == b->st_distance && !strcmp(a->radiance_unit, b->radiance_unit);
  for (int k = 0; k < SLAB_AXES; ++k)
    alike = alike && a->samples[k] == b->samples[k] && a->st_window[k] == b->st_window[k];
  for (int c = 0; c < 3; ++c)
    alike = alike && a->center[c] == b->center[c] && a->u[c] == b->u[c] && a->v[c] == b->v[c] &&
            a->normal[c] == b->normal[c];
  return alike;
}

double slab_kappa(const struct slab *slab) {
  return 1 / slab->st_distance;
}

size_t slab_sample_count(const struct slab *slab) {
  return (size_t)slab_width(slab) * (size_t)slab_height(slab);
}

int slab_width(const struct slab *slab) {
  return slab->samples[SLAB_U] * slab->samples[SLAB_S];
}

size_t slab_negative(const struct slab *slab) {
  size_t values = 3 * slab_sample_count(slab), n = 0;
  while (n < values && !(slab->rgb[n] < 0)) ++n;
  return n;
}

bool slab_is_lit(const struct slab *slab) {
  for (size_t n = 3 * slab_sample_count(slab); n > 0; --n)
    if (slab->rgb[n - 1] != 0) return true;
  return false;
}

int slab_height(const struct slab *slab) {
  return slab->samples[SLAB_V] * slab->samples[SLAB_T];
}

size_t slab_pixel(const struct slab *slab, const int at[SLAB_AXES]) {
  size_t row = (size_t)(at[SLAB_V] * slab->samples[SLAB_T] + at[SLAB_T]);
  size_t column = (size_t)(at[SLAB_U] * slab->samples[SLAB_S] + at[SLAB_S]);
  return row * (size_t)slab_width(slab) + column;
}

float *slab_at(const struct slab *slab, int i, int j, int k, int l) {
  return slab->rgb + 3 * slab_pixel(slab, (const int[SLAB_AXES]){i, j, k, l});
}

void slab_locate(const struct slab *slab, size_t pixel, int at[SLAB_AXES]) {
  int x = (int)(pixel % (size_t)slab_width(slab)), y = (int)(pixel / (size_t)slab_width(slab));
  at[SLAB_U] = x / slab->samples[SLAB_S];
  at[SLAB_S] = x % slab->samples[SLAB_S];
  at[SLAB_V] = y / slab->samples[SLAB_T];
  at[SLAB_T] = y % slab->samples[SLAB_T];
}

/* Lower end and size of an axis. */
static void axis_range(const struct slab *slab, int axis, double *low, double *size) {
  if (axis == SLAB_U || axis == SLAB_V) {
    *size = length(axis == SLAB_U ? slab->u : slab->v);
    *low = -*size / 2;
  } else {
    const double *window = slab->st_window + (axis == SLAB_S ? 0 : 2);
    *low = window[0];
    *size = window[1] - window[0];
  }
}

double slab_position(const struct slab *slab, int axis, int index) {
  double low, size;
  axis_range(slab, axis, &low, &size);
  double share = (index + 0.5) / slab->samples[axis];
  /* About the centre, so that opposite samples of the aperture are exact negatives. */
  return axis == SLAB_U || axis == SLAB_V ? (share - 0.5) * size : low + share * size;
}

double slab_spacing(const struct slab *slab, int axis) {
  double low, size;
  axis_range(slab, axis, &low, &size);
  return size / slab->samples[axis];
}

/* The two samples around `x` and the weight of the upper one; false outside,
 * and for NaN. */
static bool axis_taps(const struct slab *slab, int axis, double x, int index[2], double *weight) {
  double low, size;
  axis_range(slab, axis, &low, &size);
  double high = axis == SLAB_S ? slab->st_window[1] : axis == SLAB_T ? slab->st_window[3] : -low;
  if (!(x >= low && x <= high)) return false;
  int n = slab->samples[axis];
  double position = (x - low) / size * n - 0.5;
  position = position < 0 ? 0 : position > n - 1 ? n - 1 : position;
  index[0] = (int)position;
  index[1] = index[0] + 1 < n ? index[0] + 1 : index[0];
  *weight = position - index[0];
  return true;
}

void slab_lookup(const struct slab *slab, double a, double b, double s, double t, double rgb[3]) {
  rgb[0] = rgb[1] = rgb[2] = 0;
  const double abst[SLAB_AXES] = {a, b, s, t};
  int index[SLAB_AXES][2];
  double upper[SLAB_AXES];
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    if (!axis_taps(slab, axis, abst[axis], index[axis], &upper[axis])) return;
  for (int corner = 0; corner < 16; ++corner) {
    double weight = 1;
    int at[SLAB_AXES];
    for (int axis = 0; axis < SLAB_AXES; ++axis) {
      int up = corner >> axis & 1;
      weight *= up ? upper[axis] : 1 - upper[axis];
      at[axis] = index[axis][up];
    }
    if (weight == 0) continue;
    const float *sample = slab_at(slab, at[0], at[1], at[2], at[3]);
    for (int c = 0; c < 3; ++c) rgb[c] += weight * (double)sample[c];
  }
}

bool slab_ray(const struct slab *slab, const double origin[3], const double direction[3],
              double abst[4]) {
  double forward = dot(direction, slab->normal);
  if (!(forward > 0)) return false;
  double u_length = length(slab->u), v_length = length(slab->v);
  double from_center[3], along_u = 0, along_v = 0, slope_u = 0, slope_v = 0;
  for (int c = 0; c < 3; ++c) from_center[c] = origin[c] - slab->center[c];
  double steps = -dot(from_center, slab->normal) / forward;
  for (int c = 0; c < 3; ++c) {
    double point = from_center[c] + steps * direction[c];
    along_u += point * (slab->u[c] / u_length);
    along_v += point * (slab->v[c] / v_length);
    slope_u += direction[c] / forward * (slab->u[c] / u_length);
    slope_v += direction[c] / forward * (slab->v[c] / v_length);
  }
  double kappa = slab_kappa(slab);
  abst[0] = along_u;
  abst[1] = along_v;
  abst[2] = slope_u + kappa * along_u;
  abst[3] = slope_v + kappa * along_v;
  return true;
}
