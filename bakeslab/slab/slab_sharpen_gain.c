/* slab_sharpen_gain.c - tries sharpening on a coarser copy of a slab, for which the slab itself is
 * the truth.
 *
 * 1. Halve all axes: a slab of the same kind of light, with twice its blur. Sharpen a copy of it,
 *    and of the slab.
 * 2. At each distance, integrate the irradiance on a patch by all four (patch.h): e, sharpened s;
 *    coarse E, sharpened S.
 * 3. The truth is not known, but both e and s are nearer to it than E. The blur of the sharpened
 *    slab is |S - e|/|E - e| or |S - s|/|E - s| times as large, whichever is more (RMS).
 * 4. Sharpening amplifies noise. With what the bake recorded of it and what resolution does, the
 *    errors before and after are sums of squares.
 *
 * Why it can do harm: where light moves from view to view by cells of s and t, its blur along s
 * and along u is one and the same, and on some receivers they cancel in part. What is sharpened
 * along s and t alone loses that. Of 400 made light fields of one u and one s (edges and bars,
 * sheared or not, without noise, at 1, 4 and 16 apertures) it would have made 18 % of the errors
 * larger; 100 are picked at 0.9, of which three err 1.02 to 1.09 times as much at some distance;
 * the median is 0.6 times. */
#include "slab/slab_sharpen_gain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/patch.h"
#include "slab/plane.h"
#include "slab/slab_resample.h"

const double slab_sharpen_pays = 0.9;

/* By how much the noise of interpolated samples grows when an axis is sharpened: the root of the
 * mean of (2 + cos x)/3 / (3/4 + cos(x)/4)^2 over that of (2 + cos x)/3. */
static const double noisier = 1.33;

enum { FINE, FINE_SHARP, COARSE, COARSE_SHARP, LIGHTS };

/* *coarse = (number of samples) / 2 along each axis that has 4 or more. */
static enum result halve(const struct slab *means, struct slab *coarse, struct error *error) {
  int samples[SLAB_AXES];
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    int n = means->samples[axis];
    samples[axis] = n >= 4 ? (n + 1) / 2 : n;
  }
  return slab_resample(means, samples, coarse, error);
}

/* The slab's light, and that of a sharpened copy; the slab is sharpened. */
static enum result make_lights(struct slab *slab, enum slab_sharpening how,
                               struct patch_light lights[2], struct error *error) {
  enum result result = patch_light_make(slab, &lights[0], error);
  if (result == RESULT_OK) result = slab_sharpen(slab, how, error);
  if (result == RESULT_OK) result = patch_light_make(slab, &lights[1], error);
  return result;
}

static enum result make_all(const struct slab *means, enum slab_sharpening how,
                            struct patch_light lights[LIGHTS], struct error *error) {
  struct slab fine = {0}, coarse = {0};
  enum result result = slab_resample(means, means->samples, &fine, error);
  if (result == RESULT_OK) result = halve(means, &coarse, error);
  if (result == RESULT_OK) result = make_lights(&fine, how, &lights[FINE], error);
  if (result == RESULT_OK) result = make_lights(&coarse, how, &lights[COARSE], error);
  slab_free(&fine);
  slab_free(&coarse);
  return result;
}

static double difference(const double *x, const double *y) {
  double sum = 0;
  for (int n = 0; n < PATCH_RECEIVERS; ++n) sum += (x[n] - y[n]) * (x[n] - y[n]);
  return sqrt(sum);
}

/* Step 3. NAN where nothing changes. */
static double compare_blur(double (*e)[PATCH_RECEIVERS]) {
  double gain = NAN;
  for (int truth = FINE; truth <= FINE_SHARP; ++truth) {
    double plain = difference(e[COARSE], e[truth]);
    double ratio = plain > 0 ? difference(e[COARSE_SHARP], e[truth]) / plain : NAN;
    if (!(ratio <= gain)) gain = ratio;
  }
  return gain;
}

/* Step 4. */
static double add_noise(const struct slab *slab, const struct slab_accuracy *accuracy,
                        double blur) {
  double noise = accuracy->noise, resolution = accuracy->all, louder = 1;
  if (isnan(noise) || isnan(resolution) || !(resolution > noise)) return blur;
  resolution = sqrt(resolution * resolution - noise * noise);
  for (int axis = SLAB_S; axis <= SLAB_T; ++axis)
    if (slab->samples[axis] > 1) louder *= noisier;
  return hypot(blur * resolution, louder * noise) / accuracy->all;
}

enum result slab_sharpen_gain(const struct slab *means, const struct slab_sampling *sampling,
                              enum slab_sharpening how, double *gain, struct error *error) {
  struct slab_accuracy accuracy[SLAB_ACCURACY_DISTANCES];
  struct patch_light lights[LIGHTS] = {0};
  struct patch_extent extent = {0};
  *gain = NAN;
  if (means->samples[SLAB_S] < 4 && means->samples[SLAB_T] < 4) return RESULT_OK;
  double(*e)[PATCH_RECEIVERS] = malloc(LIGHTS * sizeof *e);
  enum result result =
      e ? slab_accuracy_table(means, sampling, accuracy, error) : result_no_memory(error);
  if (result == RESULT_OK) result = make_all(means, how, lights, error);
  if (result == RESULT_OK) result = patch_extent_find(means, &lights[FINE], &extent, error);
  for (int n = 0; n < SLAB_ACCURACY_DISTANCES && result == RESULT_OK; ++n) {
    struct patch patch;
    result = patch_make(means, accuracy[n].distance, &extent, &patch, error);
    if (result == RESULT_OK) {
      memset(e, 0, LIGHTS * sizeof *e);
      for (int k = 0; k < LIGHTS; ++k)
        if (lights[k].luminance) patch_irradiance(&patch, &lights[k], e[k]);
      double worse = add_noise(means, &accuracy[n], compare_blur(e));
      if (!(worse <= *gain)) *gain = worse;
    }
    patch_free(&patch);
  }
  for (int k = 0; k < LIGHTS; ++k) free(lights[k].luminance);
  free(e);
  return result;
}
