/* slab_accuracy.c - see slab_accuracy.h.
 *
 * The receivers are a square grid that faces the aperture, so that the ray from a point
 * (a, b) of it to the receiver (x, y) at distance z has the slopes (x - a)/z and (y - b)/z:
 * of the sixteen corners of an interpolation, u and s depend on x alone, v and t on y
 * alone. Rows of the raster are combined once for all receivers with the same y. */
#include "slab/slab_accuracy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/slab_resample.h"
#include "slab/slab_sharpen.h"

const double slab_accuracy_apertures[SLAB_ACCURACY_DISTANCES] = {1, 4, 16};

enum {
  SIDE = 37, /* receivers along a side: a prime, and moved about, so that they are not all at
                the same places between samples */
  MAX_POINTS = 2048, /* of the sum over the aperture, along an axis */
  LIGHTS = 5
};

/* Light below this part of an axis's brightest sample is not worth a receiver. */
static const double dark = 1e-3;

/* How errors fall with resolution, for each halving, lies between these: two halvings tell
 * it badly, above all where the second leaves little to see. The slowest were chosen by eye
 * on 63 cases of lobes, peaks, edges and bars, and on the paper's lamp (told 0.7 to 1.9 of
 * the truth). There 61 came out within a factor of 2; of 54 others, with widths, shears and
 * resolutions that had no part in the choice, 45 did (0.42 to 7.8). Sharpened: 51 of 63, and
 * 38 of 54 (0.39 to 12). Round edges seen from afar are told 0.48 to 0.7 of the truth; thin
 * peaks that move from view to view, seen from near, far too much. */
static const double slowest_st = 2.4, slowest_uv = 3.5, fastest = 4, fastest_sharpened = 16;

double slab_aperture(const struct slab *slab) {
  return fmax(slab_spacing(slab, SLAB_U) * slab->samples[SLAB_U],
              slab_spacing(slab, SLAB_V) * slab->samples[SLAB_V]);
}

/* ---- A slab's luminance ---- */

struct light {
  int samples[SLAB_AXES]; /* 0: there is no such light */
  float *luminance;       /* a raster as a slab's */
};

static enum result make_light(const struct slab *slab, struct light *light, struct error *error) {
  size_t count = slab_sample_count(slab);
  light->luminance = malloc(count * sizeof *light->luminance);
  if (!light->luminance) return result_fail(error, RESULT_MEMORY, "out of memory");
  memcpy(light->samples, slab->samples, sizeof light->samples);
  for (size_t n = 0; n < count; ++n) {
    const float *rgb = slab->rgb + 3 * n;
    light->luminance[n] = 0.2126390f * rgb[0] + 0.7151687f * rgb[1] + 0.0721923f * rgb[2];
  }
  return RESULT_OK;
}

/* The slab with its samples along the axes first and first + 1 divided by 2^times. */
static enum result halve(const struct slab *means, int first, int times, bool sharpened,
                         struct light *light, struct error *error) {
  int samples[SLAB_AXES], most = 0;
  memcpy(samples, means->samples, sizeof samples);
  for (int axis = first; axis < first + 2; ++axis)
    for (int n = 0; n < times; ++n) {
      if (samples[axis] > most) most = samples[axis];
      samples[axis] = (samples[axis] + 1) / 2;
    }
  if (most < 4) return RESULT_OK;
  struct slab fewer = {0};
  enum result result = slab_resample(means, samples, &fewer, error);
  if (result == RESULT_OK && sharpened) result = slab_sharpen(&fewer, SLAB_SHARPEN_EXACT, error);
  if (result == RESULT_OK) result = make_light(&fewer, light, error);
  slab_free(&fewer);
  return result;
}

/* Which light is which: the slab, st halved once and twice, uv likewise. */
enum { FULL, ST_2, ST_4, UV_2, UV_4 };

static enum result make_lights(const struct slab *slab, bool sharpened, struct light lights[LIGHTS],
                               struct error *error) {
  struct slab means = *slab;
  means.rgb = NULL;
  enum result result = make_light(slab, &lights[FULL], error);
  if (sharpened && result == RESULT_OK) {
    result = slab_alloc(&means, error);
    if (result == RESULT_OK) {
      memcpy(means.rgb, slab->rgb, 3 * sizeof(float) * slab_sample_count(slab));
      result = slab_unsharpen(&means, error);
    }
  }
  const struct slab *from = sharpened ? &means : slab;
  for (int k = ST_2; k < LIGHTS && result == RESULT_OK; ++k)
    result = halve(from, k < UV_2 ? SLAB_S : SLAB_U, k % 2 ? 1 : 2, sharpened, &lights[k], error);
  free(means.rgb);
  return result;
}

/* ---- Where there is light ---- */

/* The part of each axis with light, by the mean of |L| cos^4 over the other axes. */
struct extent {
  double low[SLAB_AXES], high[SLAB_AXES]; /* a, b, s, t */
  double share;                           /* of the slab's samples */
};

static void find_range(const struct slab *slab, int axis, const double *profile,
                       struct extent *extent) {
  int first = 0, last = slab->samples[axis] - 1, count = last + 1;
  double peak = 0, half = slab_spacing(slab, axis) / 2;
  for (int k = 0; k < count; ++k) peak = fmax(peak, profile[k]);
  while (first < last && profile[first] <= dark * peak) ++first;
  while (last > first && profile[last] <= dark * peak) --last;
  extent->low[axis] = slab_position(slab, axis, first) - half;
  extent->high[axis] = slab_position(slab, axis, last) + half;
  extent->share *= (double)(last - first + 1) / count;
}

static enum result find_extent(const struct slab *slab, const struct light *light,
                               struct extent *extent, struct error *error) {
  const int *n = slab->samples;
  size_t room = 0, starts[SLAB_AXES];
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    starts[axis] = room;
    room += (size_t)n[axis];
  }
  double *profile = calloc(room, sizeof *profile);
  if (!profile) return result_fail(error, RESULT_MEMORY, "out of memory");
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
  extent->share = 1;
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    find_range(slab, axis, profile + starts[axis], extent);
  free(profile);
  return RESULT_OK;
}

/* ---- Receivers ---- */

/* A point of the aperture as a receiver sees it along one axis pair, u and s or v and t. */
struct tap {
  int corner[4]; /* of a row (column) of the raster: low u, s; low u, high s; high u, ... */
  float high_uv, high_st;
  float slope2; /* square of the slope; negative where the ray misses the window */
};

struct patch {
  const struct slab *slab;
  const struct slab_sampling *sampling;
  double distance;
  double at[2][SIDE]; /* receivers along u and v */
  int points[2];      /* of the aperture, along u and v */
  struct tap *taps[2], *room;
  float *row;
};

/* What a receiver at distance z gets of a ray is at a + z (s - kappa a). */
static void place_receivers(const struct extent *extent, struct patch *patch) {
  double z = patch->distance, shrink = 1 - slab_kappa(patch->slab) * z;
  for (int axis = 0; axis < 2; ++axis) {
    double ends[2] = {shrink * extent->low[axis], shrink * extent->high[axis]};
    double low = fmin(ends[0], ends[1]) + z * extent->low[SLAB_S + axis];
    double high = fmax(ends[0], ends[1]) + z * extent->high[SLAB_S + axis];
    for (int k = 0; k < SIDE; ++k) {
      double moved = k * (axis ? 0.7548776662466927 : 0.6180339887498949);
      patch->at[axis][k] = low + (k + moved - floor(moved)) / SIDE * (high - low);
    }
  }
}

/* Enough points that each piece of the interpolation, a cell of uv or of st, gets some. */
static int points_along(const struct slab *slab, int axis, double distance) {
  double crossed = slab_spacing(slab, axis) * slab->samples[axis] *
                   fabs(1 / distance - slab_kappa(slab)) / slab_spacing(slab, SLAB_S + axis);
  double points = 2 * (slab->samples[axis] + fmin(crossed, slab->samples[SLAB_S + axis])) + 2;
  return (int)fmin(points, MAX_POINTS);
}

static enum result make_patch(const struct slab *slab, const struct slab_sampling *sampling,
                              double distance, const struct extent *extent, struct patch *patch,
                              struct error *error) {
  *patch = (struct patch){.slab = slab, .sampling = sampling, .distance = distance};
  place_receivers(extent, patch);
  for (int axis = 0; axis < 2; ++axis) patch->points[axis] = points_along(slab, axis, distance);
  size_t first = (size_t)patch->points[0] * SIDE, second = (size_t)patch->points[1] * SIDE;
  patch->room = malloc((first + second) * sizeof *patch->room);
  patch->row = malloc((size_t)slab_width(slab) * sizeof *patch->row);
  if (!patch->room || !patch->row) return result_fail(error, RESULT_MEMORY, "out of memory");
  patch->taps[0] = patch->room;
  patch->taps[1] = patch->room + first;
  return RESULT_OK;
}

static void free_patch(struct patch *patch) {
  free(patch->room);
  free(patch->row);
}

/* Between the samples of one axis; `x` is a position from 0 to 1. */
static void between(int count, double x, int index[2], float *high) {
  double position = fmin(fmax(x * count - 0.5, 0), count - 1);
  index[0] = (int)position;
  index[1] = index[0] + 1 < count ? index[0] + 1 : index[0];
  *high = (float)(position - index[0]);
}

/* The taps of all receivers and points of an axis pair, for a light's numbers of samples. */
static void set_taps(const struct patch *patch, const struct light *light, int axis) {
  const struct slab *slab = patch->slab;
  const double *window = slab->st_window + 2 * axis;
  double edge = slab_spacing(slab, axis) * slab->samples[axis];
  int slopes = light->samples[SLAB_S + axis];
  struct tap *tap = patch->taps[axis];
  for (int r = 0; r < SIDE; ++r)
    for (int p = 0; p < patch->points[axis]; ++p, ++tap) {
      double share = (p + 0.5) / patch->points[axis], a = (share - 0.5) * edge;
      double slope = (patch->at[axis][r] - a) / patch->distance;
      double s = (slope + slab_kappa(slab) * a - window[0]) / (window[1] - window[0]);
      int uv[2], st[2];
      tap->slope2 = s >= 0 && s <= 1 ? (float)(slope * slope) : -1;
      between(light->samples[axis], share, uv, &tap->high_uv);
      between(slopes, fmin(fmax(s, 0), 1), st, &tap->high_st);
      for (int n = 0; n < 4; ++n) tap->corner[n] = uv[n / 2] * slopes + st[n % 2];
    }
}

static float mix(float low, float high, float part) {
  return low + part * (high - low);
}

/* The row of the raster that a tap of v and t interpolates; false where it is black. */
static bool mix_rows(const struct light *light, const struct tap *tap, float *row) {
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
static double sum_row(const float *row, const struct tap *tap, int points, float y2) {
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

/* Irradiance of all receivers, but for the factor area / z^2: the mean of L cos^4. */
static void light_patch(const struct patch *patch, const struct light *light, double *e) {
  memset(e, 0, SIDE * SIDE * sizeof *e);
  for (int axis = 0; axis < 2; ++axis) set_taps(patch, light, axis);
  double all = (double)patch->points[0] * patch->points[1];
  const struct tap *line = patch->taps[1];
  for (int y = 0; y < SIDE; ++y)
    for (int q = 0; q < patch->points[1]; ++q, ++line) {
      if (line->slope2 < 0 || !mix_rows(light, line, patch->row)) continue;
      for (int x = 0; x < SIDE; ++x)
        e[y * SIDE + x] += sum_row(patch->row, patch->taps[0] + x * patch->points[0],
                                   patch->points[0], line->slope2) /
                           all;
    }
}

/* ---- Errors ---- */

static double rms(const double *e) {
  double sum = 0;
  for (int n = 0; n < SIDE * SIDE; ++n) sum += e[n] * e[n];
  return sqrt(sum) / SIDE;
}

/* Makes of `once`, by the light halved once, the error that is left in `full`; returns
 * its RMS. */
static double extrapolate(const double *full, double *once, const double *twice, double least,
                          double most) {
  double steps[2] = {0, 0};
  for (int n = 0; n < SIDE * SIDE; ++n) {
    steps[0] += (once[n] - full[n]) * (once[n] - full[n]);
    steps[1] += (twice[n] - once[n]) * (twice[n] - once[n]);
  }
  double falls = steps[0] > 0 ? sqrt(steps[1] / steps[0]) : most;
  falls = fmin(fmax(falls, least), most);
  for (int n = 0; n < SIDE * SIDE; ++n) once[n] = (once[n] - full[n]) / (falls - 1);
  return rms(once);
}

/* The sums over a row's (column's) samples of their squared weights in the mean over the
 * aperture, for each receiver. */
static bool square_weights(const struct patch *patch, int axis, double *squares) {
  const int *n = patch->slab->samples;
  size_t count = (size_t)n[axis] * (size_t)n[SLAB_S + axis];
  double *weights = malloc(count * sizeof *weights);
  const struct tap *tap = patch->taps[axis];
  for (int r = 0; weights && r < SIDE; ++r) {
    memset(weights, 0, count * sizeof *weights);
    for (int p = 0; p < patch->points[axis]; ++p, ++tap)
      for (int k = 0; k < 4 && tap->slope2 >= 0; ++k) {
        double uv = (double)tap->high_uv, st = (double)tap->high_st;
        weights[tap->corner[k]] +=
            (k / 2 ? uv : 1 - uv) * (k % 2 ? st : 1 - st) / patch->points[axis];
      }
    squares[r] = 0;
    for (size_t k = 0; k < count; ++k) squares[r] += weights[k] * weights[k];
  }
  free(weights);
  return weights != NULL;
}

/* Noise of irradiance relative to its RMS, `level`, over the receivers; the taps are those of
 * the full slab. It has two parts. What samples have by themselves counts as independent, and
 * all of it as lying where the light is. What they share, since the rays of a pass have the
 * same places in all cells, is the noise of the flux. */
static enum result noise_of(const struct patch *patch, const struct extent *extent, double level,
                            double *noise, struct error *error) {
  double squares[2][SIDE], sum = 0;
  *noise = NAN;
  for (int axis = 0; axis < 2; ++axis)
    if (!square_weights(patch, axis, squares[axis]))
      return result_fail(error, RESULT_MEMORY, "out of memory");
  for (int y = 0; y < SIDE; ++y)
    for (int x = 0; x < SIDE; ++x) {
      double r = 1 + (patch->at[0][x] * patch->at[0][x] + patch->at[1][y] * patch->at[1][y]) /
                         (patch->distance * patch->distance);
      sum += squares[0][x] * squares[1][y] / (r * r * r * r);
    }
  const struct slab_sampling *known = patch->sampling;
  if (level > 0)
    *noise =
        hypot(known->sample_noise * sqrt(sum / extent->share) / (SIDE * level), known->flux_noise);
  return RESULT_OK;
}

/* Fills one accuracy; `e` has room for the irradiance by each light. */
static enum result find_accuracy(const struct patch *patch, const struct light *lights,
                                 const struct extent *extent, double (*e)[SIDE * SIDE],
                                 struct slab_accuracy *accuracy, struct error *error) {
  *accuracy = (struct slab_accuracy){.distance = patch->distance, .st = NAN, .uv = NAN};
  memset(e, 0, LIGHTS * sizeof *e);
  for (int k = LIGHTS - 1; k >= FULL; --k) /* FULL last: it leaves its taps */
    if (lights[k].luminance) light_patch(patch, &lights[k], e[k]);
  double level = rms(e[FULL]), scale = level > 0 ? 1 / level : 0;
  enum result result = noise_of(patch, extent, level, &accuracy->noise, error);
  if (lights[ST_4].luminance)
    accuracy->st = scale * extrapolate(e[FULL], e[ST_2], e[ST_4], slowest_st,
                                       patch->sampling->sharpened ? fastest_sharpened : fastest);
  if (lights[UV_4].luminance)
    accuracy->uv = scale * extrapolate(e[FULL], e[UV_2], e[UV_4], slowest_uv, fastest);
  /* Both blur the irradiance, and may do so the same way: they add up by receiver. */
  for (int n = 0; n < SIDE * SIDE; ++n) e[FULL][n] = e[ST_2][n] + e[UV_2][n];
  bool nothing = isnan(accuracy->st) && isnan(accuracy->uv) && isnan(accuracy->noise);
  accuracy->all =
      nothing ? NAN : hypot(scale * rms(e[FULL]), isnan(accuracy->noise) ? 0 : accuracy->noise);
  return result;
}

enum result slab_accuracy_estimate(const struct slab *slab, const struct slab_sampling *sampling,
                                   int count, const double *distances,
                                   struct slab_accuracy *accuracy, struct error *error) {
  struct light lights[LIGHTS] = {0};
  struct extent extent = {0};
  double(*e)[SIDE * SIDE] = malloc(LIGHTS * sizeof *e);
  enum result result = e ? make_lights(slab, sampling->sharpened, lights, error)
                         : result_fail(error, RESULT_MEMORY, "out of memory");
  if (result == RESULT_OK) result = find_extent(slab, &lights[FULL], &extent, error);
  for (int n = 0; n < count && result == RESULT_OK; ++n) {
    struct patch patch;
    result = make_patch(slab, sampling, distances[n], &extent, &patch, error);
    if (result == RESULT_OK)
      result = find_accuracy(&patch, lights, &extent, e, &accuracy[n], error);
    free_patch(&patch);
  }
  for (int k = 0; k < LIGHTS; ++k) free(lights[k].luminance);
  free(e);
  return result;
}

enum result slab_accuracy_table(const struct slab *slab, const struct slab_sampling *sampling,
                                struct slab_accuracy accuracy[SLAB_ACCURACY_DISTANCES],
                                struct error *error) {
  double distances[SLAB_ACCURACY_DISTANCES];
  for (int n = 0; n < SLAB_ACCURACY_DISTANCES; ++n)
    distances[n] = slab_accuracy_apertures[n] * slab_aperture(slab);
  return slab_accuracy_estimate(slab, sampling, SLAB_ACCURACY_DISTANCES, distances, accuracy,
                                error);
}
