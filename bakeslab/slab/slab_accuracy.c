/* slab_accuracy.c - the error of a slab by Richardson extrapolation from coarser copies of it.
 *
 * 1. Make copies of the slab that err as it may (slab_variant.h): with s and t (or u and v) halved
 *    once and twice, with its noise once more, and rounded to LogLuv once more.
 * 2. At each distance, place receivers over all of the patch that the light reaches, and
 *    integrate their irradiance by each copy (patch.h): by the halved ones E1, E2, E4.
 * 3. r = |E4 - E2| / |E2 - E1| (RMS over the receivers) is how much an error grows by a halving,
 *    as observed; it is kept within the bounds below (Roache 1994, section on the observed order).
 * 4. The error left in E1 is (E2 - E1) / (r - 1) at each receiver (Richardson and Gaunt 1927).
 *    Errors by st and by uv add up there, since both blur the irradiance.
 * 5. What the noise changes, and what all samples share of it, is the error by noise; and so with
 *    the rounding.
 * 6. An error is its RMS over the receivers, relative to the RMS of E1; those by resolution, noise
 *    and rounding are added in quadrature.
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
#include "slab/slab_variant.h"

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

/* ---- 1. Copies ---- */

/* The light of the slab itself comes after that of its copies. */
enum { FULL = SLAB_VARIANTS, LIGHTS };

static enum result make_lights(const struct slab *slab, const struct slab_sampling *sampling,
                               struct patch_light lights[LIGHTS], struct error *error) {
  enum result result = patch_light_make(slab, &lights[FULL], error);
  for (int k = 0; k < SLAB_VARIANTS && result == RESULT_OK; ++k) {
    struct slab copy = {0};
    result = slab_variant_make(slab, sampling, (enum slab_variant)k, &copy, error);
    if (result == RESULT_OK && copy.rgb) result = patch_light_make(&copy, &lights[k], error);
    slab_free(&copy);
  }
  return result;
}

/* ---- 3. and 4. Extrapolation ---- */

static double rms(const double *e) {
  double sum = 0;
  for (int n = 0; n < PATCH_RECEIVERS; ++n) sum += e[n] * e[n];
  return sqrt(sum) / PATCH_SIDE;
}

double slab_accuracy_ratio(bool st, bool sharpened, double once, double twice) {
  struct bounds bounds = !st ? uv_bounds : sharpened ? sharpened_st_bounds : st_bounds;
  return fmin(fmax(once > 0 ? twice / once : bounds.high, bounds.low), bounds.high);
}

/* Replaces `once`, irradiance by the light halved once, by the error that is left in `full`.
 * Returns its RMS. */
static double extrapolate(const double *full, double *once, const double *twice, bool st,
                          bool sharpened) {
  double steps[2] = {0, 0};
  for (int n = 0; n < PATCH_RECEIVERS; ++n) {
    steps[0] += (once[n] - full[n]) * (once[n] - full[n]);
    steps[1] += (twice[n] - once[n]) * (twice[n] - once[n]);
  }
  double ratio = slab_accuracy_ratio(st, sharpened, sqrt(steps[0]), sqrt(steps[1]));
  for (int n = 0; n < PATCH_RECEIVERS; ++n) once[n] = (once[n] - full[n]) / (ratio - 1);
  return rms(once);
}

/* ---- 5. and 6. ---- */

/* RMS of what two irradiances differ by. */
static double differ(const double *a, const double *b) {
  double sum = 0;
  for (int n = 0; n < PATCH_RECEIVERS; ++n) sum += (a[n] - b[n]) * (a[n] - b[n]);
  return sqrt(sum) / PATCH_SIDE;
}

/* What is known of three parts, in quadrature. */
static double add_up(const struct slab_accuracy *accuracy) {
  double resolution = accuracy->resolution, noise = accuracy->noise;
  if (isnan(resolution) && isnan(noise)) return NAN;
  return hypot(hypot(isnan(resolution) ? 0 : resolution, isnan(noise) ? 0 : noise),
               accuracy->logluv);
}

/* Steps 2 to 6 at the patch's distance; `e` has room for the irradiance by each light. */
static void find_accuracy(const struct patch *patch, const struct patch_light *lights,
                          const struct slab_sampling *sampling, double (*e)[PATCH_RECEIVERS],
                          struct slab_accuracy *accuracy) {
  *accuracy = (struct slab_accuracy){
      .distance = patch->distance, .st = NAN, .uv = NAN, .resolution = NAN, .noise = NAN};
  memset(e, 0, LIGHTS * sizeof *e);
  for (int k = 0; k < LIGHTS; ++k)
    if (lights[k].luminance) patch_irradiance(patch, &lights[k], e[k]);
  double level = rms(e[FULL]), scale = level > 0 ? 1 / level : 0;
  double shared = level > 0 && sampling->flux_noise > 0 ? sampling->flux_noise : 0;
  if (lights[SLAB_NOISY].luminance)
    accuracy->noise = hypot(scale * differ(e[SLAB_NOISY], e[FULL]), shared);
  if (lights[SLAB_ROUNDED].luminance) accuracy->logluv = scale * differ(e[SLAB_ROUNDED], e[FULL]);
  if (lights[SLAB_ST_4].luminance)
    accuracy->st =
        scale * extrapolate(e[FULL], e[SLAB_ST_2], e[SLAB_ST_4], true, sampling->sharpened);
  else
    memset(e[SLAB_ST_2], 0, sizeof *e);
  if (lights[SLAB_UV_4].luminance)
    accuracy->uv =
        scale * extrapolate(e[FULL], e[SLAB_UV_2], e[SLAB_UV_4], false, sampling->sharpened);
  else
    memset(e[SLAB_UV_2], 0, sizeof *e);
  for (int n = 0; n < PATCH_RECEIVERS; ++n) e[FULL][n] = e[SLAB_ST_2][n] + e[SLAB_UV_2][n];
  if (!isnan(accuracy->st) || !isnan(accuracy->uv)) accuracy->resolution = scale * rms(e[FULL]);
  accuracy->all = add_up(accuracy);
}

enum result slab_accuracy_estimate(const struct slab *slab, const struct slab_sampling *sampling,
                                   int count, const double *distances,
                                   struct slab_accuracy *accuracy, struct error *error) {
  struct patch_light lights[LIGHTS] = {0};
  struct patch_extent extent = {0};
  double(*e)[PATCH_RECEIVERS] = malloc(LIGHTS * sizeof *e);
  enum result result = e ? make_lights(slab, sampling, lights, error) : result_no_memory(error);
  if (result == RESULT_OK) result = patch_extent_find(slab, &lights[FULL], &extent, error);
  for (int n = 0; n < count && result == RESULT_OK; ++n) {
    struct patch patch;
    result = patch_make(slab, distances[n], &extent, &patch, error);
    if (result == RESULT_OK) find_accuracy(&patch, lights, sampling, e, &accuracy[n]);
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
