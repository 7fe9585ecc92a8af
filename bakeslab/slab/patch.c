#include "slab/patch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/plane.h"

enum { MAX_POINTS = 2048 }; /* along an axis of the aperture */

static const double negligible = 1e-3;

enum result patch_light_make(const struct slab *slab, struct patch_light *light,
                             struct error *error) {
  size_t count = slab_sample_count(slab);
  light->luminance = malloc(count * sizeof *light->luminance);
  if (!light->luminance) return result_no_memory(error);
  memcpy(light->samples, slab->samples, sizeof light->samples);
  for (size_t n = 0; n < count; ++n) {
    const float *rgb = slab->rgb + 3 * n;
    light->luminance[n] = 0.2126390f * rgb[0] + 0.7151687f * rgb[1] + 0.0721923f * rgb[2];
  }
  return RESULT_OK;
}

/* ---- Where there is light ---- */

static void find_range(const struct slab *slab, int axis, const double *profile,
                       struct patch_extent *extent) {
  int first = 0, last = slab->samples[axis] - 1, count = last + 1;
  double peak = 0, half = slab_spacing(slab, axis) / 2;
  for (int k = 0; k < count; ++k) peak = fmax(peak, profile[k]);
  while (first < last && profile[first] <= negligible * peak) ++first;
  while (last > first && profile[last] <= negligible * peak) --last;
  extent->low[axis] = slab_position(slab, axis, first) - half;
  extent->high[axis] = slab_position(slab, axis, last) + half;
}

enum result patch_extent_find(const struct slab *slab, const struct patch_light *light,
                              struct patch_extent *extent, struct error *error) {
  const int *n = slab->samples;
  size_t room = 0, starts[SLAB_AXES];
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    starts[axis] = room;
    room += (size_t)n[axis];
  }
  double *profile = calloc(room, sizeof *profile);
  if (!profile) return result_no_memory(error);
  const float *sample = light->luminance;
  for (int y = 0; y < slab_height(slab); ++y) {
    double t = slab_position(slab, SLAB_T, y % n[SLAB_T]);
    for (int x = 0; x < slab_width(slab); ++x, ++sample) {
      if (*sample == 0) continue;
      double s = slab_position(slab, SLAB_S, x % n[SLAB_S]), r = 1 + s * s + t * t;
      double size = fabs((double)*sample) / (r * r);
      const int at[SLAB_AXES] = {x / n[SLAB_S], y / n[SLAB_T], x % n[SLAB_S], y % n[SLAB_T]};
      for (int axis = 0; axis < SLAB_AXES; ++axis) profile[starts[axis] + (size_t)at[axis]] += size;
    }
  }
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    find_range(slab, axis, profile + starts[axis], extent);
  free(profile);
  return RESULT_OK;
}

/* ---- Receivers ---- */

/* A point of the aperture as a receiver sees it along one axis pair, u and s or v and t. */
struct patch_tap {
  int corner[4]; /* of a row (column) of the raster: low u, s; low u, high s; high u, ... */
  float high_uv, high_st; /* weights of the upper samples */
  float slope2;           /* square of the slope; negative where the ray misses the window */
};

/* What a receiver at distance z gets of a ray is at a + z (s - kappa a). */
static void place_receivers(const struct patch_extent *extent, struct patch *patch) {
  double z = patch->distance, shrink = 1 - slab_kappa(patch->slab) * z;
  for (int axis = 0; axis < 2; ++axis) {
    double ends[2] = {shrink * extent->low[axis], shrink * extent->high[axis]};
    double low = fmin(ends[0], ends[1]) + z * extent->low[SLAB_S + axis];
    double high = fmax(ends[0], ends[1]) + z * extent->high[SLAB_S + axis];
    for (int k = 0; k < PATCH_SIDE; ++k) {
      double moved = k * (axis ? 0.7548776662466927 : 0.6180339887498949);
      patch->at[axis][k] = low + (k + moved - floor(moved)) / PATCH_SIDE * (high - low);
    }
  }
}

/* Enough points that each piece of the interpolation, a cell of uv or of st, gets some. */
static int points_along(const struct slab *slab, int axis, double distance) {
  double crossed = plane_edge(slab, axis) * fabs(1 / distance - slab_kappa(slab)) /
                   slab_spacing(slab, SLAB_S + axis);
  double points = 2 * (slab->samples[axis] + fmin(crossed, slab->samples[SLAB_S + axis])) + 2;
  return (int)fmin(points, MAX_POINTS);
}

enum result patch_make(const struct slab *slab, double distance, const struct patch_extent *extent,
                       struct patch *patch, struct error *error) {
  *patch = (struct patch){.slab = slab, .distance = distance};
  place_receivers(extent, patch);
  for (int axis = 0; axis < 2; ++axis) {
    patch->points[axis] = points_along(slab, axis, distance);
    patch->taps[axis] = malloc((size_t)patch->points[axis] * PATCH_SIDE * sizeof *patch->taps[0]);
  }
  patch->row = malloc((size_t)slab_width(slab) * sizeof *patch->row);
  return patch->taps[0] && patch->taps[1] && patch->row ? RESULT_OK : result_no_memory(error);
}

void patch_free(struct patch *patch) {
  for (int axis = 0; axis < 2; ++axis) free(patch->taps[axis]);
  free(patch->row);
}

/* ---- Sums ---- */

/* The samples on both sides of a position from 0 to 1 along an axis, and the upper one's weight. */
static void interpolate(int count, double x, int index[2], float *high) {
  double position = fmin(fmax(x * count - 0.5, 0), count - 1);
  index[0] = (int)position;
  index[1] = index[0] + 1 < count ? index[0] + 1 : index[0];
  *high = (float)(position - index[0]);
}

/* The taps of all receivers and points of an axis pair, for a light's numbers of samples. */
static void set_taps(const struct patch *patch, const struct patch_light *light, int axis) {
  const struct slab *slab = patch->slab;
  const double *window = slab->st_window + 2 * axis;
  double edge = plane_edge(slab, axis);
  int slopes = light->samples[SLAB_S + axis];
  struct patch_tap *tap = patch->taps[axis];
  for (int r = 0; r < PATCH_SIDE; ++r)
    for (int p = 0; p < patch->points[axis]; ++p, ++tap) {
      double share = (p + 0.5) / patch->points[axis], a = (share - 0.5) * edge;
      double slope = (patch->at[axis][r] - a) / patch->distance;
      double s = (slope + slab_kappa(slab) * a - window[0]) / (window[1] - window[0]);
      int uv[2], st[2];
      tap->slope2 = s >= 0 && s <= 1 ? (float)(slope * slope) : -1;
      interpolate(light->samples[axis], share, uv, &tap->high_uv);
      interpolate(slopes, fmin(fmax(s, 0), 1), st, &tap->high_st);
      for (int n = 0; n < 4; ++n) tap->corner[n] = uv[n / 2] * slopes + st[n % 2];
    }
}

static float mix(float low, float high, float part) {
  return low + part * (high - low);
}

/* The row of the raster that a tap of v and t interpolates; false where it is black. */
static bool mix_rows(const struct patch_light *light, const struct patch_tap *tap, float *row) {
  size_t width = (size_t)light->samples[SLAB_U] * (size_t)light->samples[SLAB_S];
  const float *rows[4];
  float any = 0;
  for (int n = 0; n < 4; ++n) rows[n] = light->luminance + (size_t)tap->corner[n] * width;
  for (size_t k = 0; k < width; ++k) {
    row[k] = mix(mix(rows[0][k], rows[1][k], tap->high_st),
                 mix(rows[2][k], rows[3][k], tap->high_st), tap->high_uv);
    any += fabsf(row[k]);
  }
  return any > 0;
}

/* The sum over a row's points: L cos^4 = L / (1 + x^2 + y^2)^2. */
static double sum_row(const float *row, const struct patch_tap *tap, int points, float y2) {
  double sum = 0;
  for (int p = 0; p < points; ++p, ++tap) {
    if (tap->slope2 < 0) continue;
    const int *at = tap->corner;
    float radiance = mix(mix(row[at[0]], row[at[1]], tap->high_st),
                         mix(row[at[2]], row[at[3]], tap->high_st), tap->high_uv);
    float r = 1 + tap->slope2 + y2;
    sum += (double)(radiance / (r * r));
  }
  return sum;
}

void patch_irradiance(const struct patch *patch, const struct patch_light *light,
                      double e[PATCH_RECEIVERS]) {
  memset(e, 0, PATCH_RECEIVERS * sizeof *e);
  for (int axis = 0; axis < 2; ++axis) set_taps(patch, light, axis);
  double all = (double)patch->points[0] * patch->points[1];
  const struct patch_tap *line = patch->taps[1];
  for (int y = 0; y < PATCH_SIDE; ++y)
    for (int q = 0; q < patch->points[1]; ++q, ++line) {
      if (line->slope2 < 0 || !mix_rows(light, line, patch->row)) continue;
      for (int x = 0; x < PATCH_SIDE; ++x)
        e[y * PATCH_SIDE + x] += sum_row(patch->row, patch->taps[0] + x * patch->points[0],
                                         patch->points[0], line->slope2) /
                                 all;
    }
}
