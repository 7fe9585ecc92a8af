/* projector.c - the st plane is the focus plane, so that radiance depends on
 * (s, t) alone, and focal blur follows from the geometry of the slab. */
#include "bake/projector.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "file/slab_json.h"
#include "slab/slab_resample.h"

/* A slab without samples; `aspect` is the picture's height over its width. */
static struct slab geometry(const struct projector *projector, double aspect) {
  double s = projector->width / projector->focus / 2, t = s * aspect;
  struct slab slab = {.samples = {1, 1, 1, 1},
                      .u = {projector->aperture[0], 0, 0},
                      .v = {0, projector->aperture[1], 0},
                      .normal = {0, 0, 1},
                      .st_window = {-s, s, -t, t},
                      .st_distance = projector->focus,
                      .metres_per_unit = projector->metres_per_unit};
  snprintf(slab.radiance_unit, sizeof slab.radiance_unit, "%s", projector->unit);
  return slab;
}

enum result projector_check(const struct projector *projector, struct error *error) {
  struct slab slab = geometry(projector, 1);
  return slab_check(&slab, error);
}

/* The radiance of white. */
static enum result find_white(const struct projector *projector, const struct slab *slide,
                              double *white, struct error *error) {
  *white = projector->white;
  if (projector->white > 0) return RESULT_OK;
  struct slab even = *slide;
  float ones[3 + SLAB_PADDING] = {1, 1, 1};
  double flux[3];
  even.rgb = ones;
  for (int axis = 0; axis < SLAB_AXES; ++axis) even.samples[axis] = 1;
  enum result result = slab_flux_metric(&even, flux, error);
  if (result != RESULT_OK) return result;
  *white = projector->flux / flux[0];
  if (flux[0] > 0 && isfinite(*white)) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "the flux %g is too much for an opening of this size",
                     projector->flux);
}

/* The image's rows run downwards, t upwards. */
static void fill(struct slab *slide, const struct picture *image, double white) {
  size_t row = 3 * (size_t)image->width;
  for (int y = 0; y < image->height; ++y) {
    const float *from = image->rgb + (size_t)y * row;
    float *to = slab_at(slide, 0, 0, 0, image->height - 1 - y);
    for (size_t k = 0; k < row; ++k) to[k] = (float)(white * (double)from[k]);
  }
}

static void choose_samples(const struct projector *projector, const struct picture *image,
                           int samples[SLAB_AXES]) {
  const int pixels[2] = {image->width, image->height};
  double longer = fmax(pixels[0], pixels[1]), share = fmin(1, PROJECTOR_ST / longer);
  for (int k = 0; k < 2; ++k) {
    int own = (int)fmax(1, round(share * pixels[k]));
    samples[SLAB_U + k] = projector->uv[k];
    samples[SLAB_S + k] = projector->st[k] ? projector->st[k] : own;
  }
}

enum result projector_slab(const struct projector *projector, const struct picture *image,
                           struct slab *slab, struct error *error) {
  struct slab slide = geometry(projector, (double)image->height / image->width);
  int samples[SLAB_AXES];
  double white = 0;
  slide.samples[SLAB_S] = image->width;
  slide.samples[SLAB_T] = image->height;
  choose_samples(projector, image, samples);
  bool finer = samples[SLAB_S] > image->width || samples[SLAB_T] > image->height;
  enum result result = slab_check(&slide, error);
  if (result == RESULT_OK) result = find_white(projector, &slide, &white, error);
  if (result == RESULT_OK) result = slab_alloc(&slide, error);
  if (result == RESULT_OK) {
    fill(&slide, image, white);
    result = slab_resample(&slide, samples, slab, error);
  }
  slab_free(&slide);
  if (result != RESULT_OK) return result;
  result = slab_json_set(slab, "samples_are", finer ? "\"points\"" : "\"cell_means\"", error);
  if (result != RESULT_OK) slab_free(slab);
  return result;
}
