/* slab_accuracy.c - the error of a slab by Richardson extrapolation from coarser copies of it.
 *
 * 1. Make the slab's luminance at five resolutions: as it is, and with s and t (or u and v)
 *    halved once and twice. A halved sample is the mean of the cells that it covers
 *    (slab_resample.h); a sharpened slab is made means again before, and sharpened after.
 * 2. At each distance, place receivers over all of the patch that the light reaches, and
 *    integrate their irradiance by each of the five: E1, E2, E4 (patch.h).
 * 3. r = |E4 - E2| / |E2 - E1| (RMS over the receivers) is how much an error grows by a halving,
 *    as observed; it is kept within the bounds below (Roache 1994, section on the observed order).
 * 4. The error left in E1 is (E2 - E1) / (r - 1) at each receiver (Richardson and Gaunt 1927).
 *    Errors by st and by uv add up there, since both blur the irradiance.
 * 5. The noise of a receiver follows from the weights of all samples in its irradiance.
 * 6. An error is its RMS over the receivers, relative to the RMS of E1; the noise is added in
 *    quadrature.
 *
 * L. F. Richardson and J. A. Gaunt, "The deferred approach to the limit", Phil. Trans. Royal
 * Society A 226, 1927. P. J. Roache, "Perspective: a method for uniform reporting of grid
 * refinement studies", Journal of Fluids Engineering 116, 1994. */
#include "slab/slab_accuracy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/patch.h"
#include "slab/plane.h"
#include "slab/slab_resample.h"
#include "slab/slab_sharpen.h"

const double slab_accuracy_apertures[SLAB_ACCURACY_DISTANCES] = {1, 4, 16};

/* The bounds of r. Two halvings give it with little certainty, above all where the second leaves
 * little light. It is 4 where the light is smooth within cells (16 where they were sharpened), and
 * 2 at edges. The lower bounds were fitted on 63 lobes, peaks, edges and bars and on the paper's
 * lamp (estimates 0.7 to 1.9 times the truth): 61 of them came out within a factor of 2. So did 45
 * of 54 others, with widths, shears and resolutions that had no part in the fit (0.42 to 7.8
 * times). Sharpened: 51 of 63, and 38 of 54 (0.39 to 12). Round edges seen from afar come out at
 * 0.48 to 0.7 times the truth; thin peaks that move from view to view, seen from near, at many
 * times. */
struct bounds {
  double low, high;
};
static const struct bounds st_bounds = {2.4, 4}, sharpened_st_bounds = {2.4, 16},
                           uv_bounds = {3.5, 4};

/* ---- 1. Five resolutions ---- */

/* The slab, st halved once and twice, uv likewise. */
enum { FULL, ST_2, ST_4, UV_2, UV_4, LIGHTS };

/* The slab with its samples along the axes first and first + 1 divided by 2^times. */
static enum result halve(const struct slab *means, int first, int times, bool sharpened,
                         struct patch_light *light, struct error *error) {
  int samples[SLAB_AXES], halved = 0; /* the most samples along an axis that was halved */
  memcpy(samples, means->samples, sizeof samples);
  for (int axis = first; axis < first + 2; ++axis)
    for (int n = 0; n < times; ++n) {
      if (samples[axis] > halved) halved = samples[axis];
      samples[axis] = (samples[axis] + 1) / 2;
    }
  if (halved < 4) return RESULT_OK;
  struct slab fewer = {0};
  enum result result = slab_resample(means, samples, &fewer, error);
  if (result == RESULT_OK && sharpened) result = slab_sharpen(&fewer, SLAB_SHARPEN_EXACT, error);
  if (result == RESULT_OK) result = patch_light_make(&fewer, light, error);
  slab_free(&fewer);
  return result;
}

static enum result make_lights(const struct slab *slab, bool sharpened,
                               struct patch_light lights[LIGHTS], struct error *error) {
  struct slab means = *slab;
  means.rgb = NULL;
  enum result result = patch_light_make(slab, &lights[FULL], error);
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

/* ---- 3. and 4. Extrapolation ---- */

static double rms(const double *e) {
  double sum = 0;
  for (int n = 0; n < PATCH_RECEIVERS; ++n) sum += e[n] * e[n];
  return sqrt(sum) / PATCH_SIDE;
}

/* Replaces `once`, irradiance by the light halved once, by the error that is left in `full`.
 * Returns its RMS. */
static double extrapolate(const double *full, double *once, const double *twice,
                          struct bounds bounds) {
  double steps[2] = {0, 0};
  for (int n = 0; n < PATCH_RECEIVERS; ++n) {
    steps[0] += (once[n] - full[n]) * (once[n] - full[n]);
    steps[1] += (twice[n] - once[n]) * (twice[n] - once[n]);
  }
  double ratio = steps[0] > 0 ? sqrt(steps[1] / steps[0]) : bounds.high;
  ratio = fmin(fmax(ratio, bounds.low), bounds.high);
  for (int n = 0; n < PATCH_RECEIVERS; ++n) once[n] = (once[n] - full[n]) / (ratio - 1);
  return rms(once);
}

/* ---- 5. Noise ---- */

/* RMS of the noise over the receivers, relative to the RMS of irradiance, `level`; the patch has
 * just been lit by `light`, the full one. Samples have noise of their own, which counts as
 * independent, and all of it as lying where the light is. They also share some, since the rays of
 * a pass are at the same places in all cells: the noise of the flux. */
static enum result find_noise(const struct patch *patch, const struct patch_light *light,
                              const struct slab_sampling *sampling,
                              const struct patch_extent *extent, double level, double *noise,
                              struct error *error) {
  double squares[2][PATCH_SIDE], sum = 0;
  *noise = NAN;
  for (int axis = 0; axis < 2; ++axis) {
    enum result result = patch_weights(patch, light, axis, squares[axis], error);
    if (result != RESULT_OK) return result;
  }
  for (int y = 0; y < PATCH_SIDE; ++y)
    for (int x = 0; x < PATCH_SIDE; ++x) {
      double r = 1 + (patch->at[0][x] * patch->at[0][x] + patch->at[1][y] * patch->at[1][y]) /
                         (patch->distance * patch->distance);
      sum += squares[0][x] * squares[1][y] / (r * r * r * r);
    }
  if (level > 0)
    *noise = hypot(sampling->sample_noise * sqrt(sum / extent->share) / (PATCH_SIDE * level),
                   sampling->flux_noise);
  return RESULT_OK;
}

/* ---- All of it ---- */

/* Steps 2 to 6 at the patch's distance; `e` has room for the irradiance by each light. */
static enum result find_accuracy(const struct patch *patch, const struct patch_light *lights,
                                 const struct slab_sampling *sampling,
                                 const struct patch_extent *extent, double (*e)[PATCH_RECEIVERS],
                                 struct slab_accuracy *accuracy, struct error *error) {
  *accuracy = (struct slab_accuracy){.distance = patch->distance, .st = NAN, .uv = NAN};
  memset(e, 0, LIGHTS * sizeof *e);
  for (int k = LIGHTS - 1; k >= FULL; --k) /* FULL last, for the noise */
    if (lights[k].luminance) patch_irradiance(patch, &lights[k], e[k]);
  double level = rms(e[FULL]), scale = level > 0 ? 1 / level : 0;
  enum result result =
      find_noise(patch, &lights[FULL], sampling, extent, level, &accuracy->noise, error);
  if (lights[ST_4].luminance)
    accuracy->st = scale * extrapolate(e[FULL], e[ST_2], e[ST_4],
                                       sampling->sharpened ? sharpened_st_bounds : st_bounds);
  if (lights[UV_4].luminance)
    accuracy->uv = scale * extrapolate(e[FULL], e[UV_2], e[UV_4], uv_bounds);
  for (int n = 0; n < PATCH_RECEIVERS; ++n) e[FULL][n] = e[ST_2][n] + e[UV_2][n];
  bool nothing = isnan(accuracy->st) && isnan(accuracy->uv) && isnan(accuracy->noise);
  accuracy->all =
      nothing ? NAN : hypot(scale * rms(e[FULL]), isnan(accuracy->noise) ? 0 : accuracy->noise);
  return result;
}

enum result slab_accuracy_estimate(const struct slab *slab, const struct slab_sampling *sampling,
                                   int count, const double *distances,
                                   struct slab_accuracy *accuracy, struct error *error) {
  struct patch_light lights[LIGHTS] = {0};
  struct patch_extent extent = {0};
  double(*e)[PATCH_RECEIVERS] = malloc(LIGHTS * sizeof *e);
  enum result result =
      e ? make_lights(slab, sampling->sharpened, lights, error) : result_no_memory(error);
  if (result == RESULT_OK) result = patch_extent_find(slab, &lights[FULL], &extent, error);
  for (int n = 0; n < count && result == RESULT_OK; ++n) {
    struct patch patch;
    result = patch_make(slab, distances[n], &extent, &patch, error);
    if (result == RESULT_OK)
      result = find_accuracy(&patch, lights, sampling, &extent, e, &accuracy[n], error);
    patch_free(&patch);
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
    distances[n] = slab_accuracy_apertures[n] * plane_width(slab);
  return slab_accuracy_estimate(slab, sampling, SLAB_ACCURACY_DISTANCES, distances, accuracy,
                                error);
}
