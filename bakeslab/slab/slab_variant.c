/* slab_variant.c - how the copies err.
 *
 * Noise: the bake records one number, the RMS standard error of all samples' luminance. The error
 * of a sample that is the mean of rays spread over its cell goes with what the radiance changes by
 * in the cell; so each sample's is taken in proportion to what it differs by from its neighbours
 * along the four axes, and its sign by chance.
 *
 * Rounding: LogLuv (G. Ward Larson, "LogLuv encoding for full-gamut, high-dynamic range images",
 * Journal of Graphics Tools 3(1), 1998) has steps of 2^(1/256) in luminance and of 1/410 in u' and
 * v'; a value errs by a step / sqrt(12) in the RMS. Samples that were rounded to the same code err
 * alike: the sign of an error is drawn for a code, not for a sample. The one colour that the file's
 * white makes exact does not err (slab_tiff_choose_white). */
#include "slab/slab_variant.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "slab/slab_logluv.h"
#include "slab/slab_resample.h"
#include "slab/slab_sharpen.h"

/* 1 or -1, by the bits of a number (D. Stafford's variant 13 of the finaliser of MurmurHash3). */
static double sign_of(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return (x ^ (x >> 31)) & 1 ? 1 : -1;
}

/* ---- Coarser ---- */

/* The samples along the axes first and first + 1 divided by 2^times; none where both have fewer
 * than 4 of them to begin with. */
static enum result halve(const struct slab *slab, bool sharpened, int first, int times,
                         struct slab *copy, struct error *error) {
  int samples[SLAB_AXES], most = 0; /* the most samples along an axis that is halved */
  memcpy(samples, slab->samples, sizeof samples);
  for (int axis = first; axis < first + 2; ++axis)
    for (int n = 0; n < times; ++n) {
      if (samples[axis] > most) most = samples[axis];
      samples[axis] = (samples[axis] + 1) / 2;
    }
  if (most < 4) return RESULT_OK;
  if (!sharpened) return slab_resample(slab, samples, copy, error);
  struct slab means = {0};
  enum result result = slab_resample(slab, slab->samples, &means, error);
  if (result == RESULT_OK) result = slab_unsharpen(&means, error);
  if (result == RESULT_OK) result = slab_resample(&means, samples, copy, error);
  if (result == RESULT_OK) result = slab_sharpen(copy, SLAB_SHARPEN_EXACT, error);
  slab_free(&means);
  return result;
}

/* ---- Noisier ---- */

/* Adds to `squares` the mean square of what each sample's luminance differs by from its neighbours
 * along an axis: `count` samples, a `stride` apart in the raster. */
static void add_changes(const float *luminance, size_t pixels, int count, size_t stride,
                        float *squares) {
  for (size_t n = 0; n < pixels; ++n) {
    size_t at = n / stride % (size_t)count;
    float sum = 0;
    if (at > 0) {
      float change = luminance[n] - luminance[n - stride];
      sum += change * change;
    }
    if (at + 1 < (size_t)count && n + stride < pixels) {
      float change = luminance[n + stride] - luminance[n];
      sum += change * change;
    }
    squares[n] += sum / (at > 0 && at + 1 < (size_t)count ? 2 : 1);
  }
}

/* The mean squared changes of all samples; they are up to a factor the samples' variances. */
static enum result find_changes(const struct slab *slab, float **out, struct error *error) {
  const int *n = slab->samples;
  size_t pixels = slab_sample_count(slab), row = (size_t)slab_width(slab);
  const size_t strides[SLAB_AXES] = {(size_t)n[SLAB_S], row * (size_t)n[SLAB_T], 1, row};
  float *luminance = malloc(pixels * sizeof *luminance), *squares = calloc(pixels, sizeof *squares);
  *out = squares;
  if (!luminance || !squares) {
    free(luminance);
    return result_no_memory(error);
  }
  for (size_t k = 0; k < pixels; ++k) luminance[k] = (float)slab_luminance(slab->rgb + 3 * k);
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    add_changes(luminance, pixels, n[axis], strides[axis], squares);
  free(luminance);
  return RESULT_OK;
}

/* The mean colour, of luminance 1. */
static void find_colour(const struct slab *slab, double colour[3]) {
  size_t pixels = slab_sample_count(slab);
  double sum[3] = {0, 0, 0};
  for (size_t k = 0; k < pixels; ++k)
    for (size_t c = 0; c < 3; ++c) sum[c] += (double)slab->rgb[3 * k + c];
  double all = 0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2];
  for (int c = 0; c < 3; ++c) colour[c] = all > 0 ? sum[c] / all : 1;
}

static enum result add_noise(const struct slab_sampling *sampling, struct slab *copy,
                             struct error *error) {
  float *squares = NULL;
  double colour[3], sum = 0;
  size_t pixels = slab_sample_count(copy);
  enum result result = find_changes(copy, &squares, error);
  find_colour(copy, colour);
  for (size_t k = 0; k < pixels && squares; ++k) sum += (double)squares[k];
  bool even = !(sum > 0); /* all samples are the same */
  double scale = sampling->sample_noise / (even ? 1 : sqrt(sum / (double)pixels));
  for (size_t k = 0; k < pixels && squares && result == RESULT_OK; ++k) {
    double off = scale * (even ? 1 : sqrt((double)squares[k])) * sign_of(k + 1);
    float *rgb = copy->rgb + 3 * k;
    for (int c = 0; c < 3; ++c) rgb[c] += (float)(off * colour[c]);
  }
  free(squares);
  return result;
}

/* ---- Rounded ---- */

static const double rms_of_step = 0.28867513459481287; /* 1/sqrt(12) */

/* A colour as LogLuv holds it. */
struct logluv {
  double y, u, v;
  uint64_t y_code, uv_code;
};

/* False where it is black, or no colour that LogLuv holds. */
static bool encode(const float rgb[3], const double white[3], struct logluv *logluv) {
  double xyz[3];
  slab_logluv_from_rgb(rgb, xyz);
  for (int c = 0; c < 3; ++c) xyz[c] *= white[c];
  double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
  if (!(xyz[1] > 0x1p-64 && xyz[1] < 0x1p64 && xyz[0] >= 0 && sum > 0)) return false;
  *logluv = (struct logluv){.y = xyz[1], .u = 4 * xyz[0] / sum, .v = 9 * xyz[1] / sum};
  logluv->y_code = (uint64_t)(256 * (log2(xyz[1]) + 64));
  logluv->uv_code = (uint64_t)(410 * logluv->u) * 512 + (uint64_t)(410 * logluv->v);
  return true;
}

static void decode(const struct logluv *logluv, const double white[3], float rgb[3]) {
  double u = logluv->u, v = logluv->v, y = logluv->y;
  const double xyz[3] = {9 * u / (4 * v) * y / white[0], y / white[1],
                         (12 - 3 * u - 20 * v) / (4 * v) * y / white[2]};
  slab_logluv_to_rgb(xyz, rgb);
}

static void round_again(const double white[3], struct slab *copy) {
  double colour[3];
  struct logluv exact = {0}, logluv;
  find_colour(copy, colour);
  encode((float[3]){(float)colour[0], (float)colour[1], (float)colour[2]}, white, &exact);
  size_t pixels = slab_sample_count(copy);
  for (size_t k = 0; k < pixels; ++k) {
    float *rgb = copy->rgb + 3 * k;
    if (!encode(rgb, white, &logluv)) continue;
    bool grey = fabsf(rgb[0] - rgb[1]) + fabsf(rgb[2] - rgb[1]) < 1e-5F * rgb[1];
    logluv.y *= exp2(sign_of(logluv.y_code + 1) * rms_of_step / 256);
    if (!grey && logluv.uv_code != exact.uv_code) {
      logluv.u += sign_of(~logluv.uv_code) * rms_of_step / 410;
      logluv.v += sign_of(~logluv.uv_code << 20) * rms_of_step / 410;
    }
    if (logluv.v > 0) decode(&logluv, white, rgb);
  }
}

enum result slab_variant_make(const struct slab *slab, const struct slab_sampling *sampling,
                              enum slab_variant which, struct slab *copy, struct error *error) {
  *copy = (struct slab){0};
  if (which <= SLAB_UV_4)
    return halve(slab, sampling->sharpened, which < SLAB_UV_2 ? SLAB_S : SLAB_U, which % 2 ? 2 : 1,
                 copy, error);
  if (which == SLAB_NOISY ? isnan(sampling->sample_noise) : !sampling->logluv) return RESULT_OK;
  enum result result = slab_resample(slab, slab->samples, copy, error);
  if (result == RESULT_OK && which == SLAB_NOISY)
    result = add_noise(sampling, copy, error);
  else if (result == RESULT_OK)
    round_again(sampling->white, copy);
  if (result != RESULT_OK) slab_free(copy);
  return result;
}
