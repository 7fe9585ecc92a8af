#include "tradeoff/pixels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "file/slab_exr.h"

/* Of the nearest page that the point is before, in lamp units. */
static double distance_of(const struct shade *shade, const double position[3]) {
  double nearest = INFINITY;
  for (int l = 0; l < shade->light_count; ++l)
    for (int p = 0; p < shade->lights[l].count; ++p) {
      const struct light_page *page = &shade->lights[l].pages[p];
      double way[3];
      vector_subtract(position, page->center, way);
      double along = vector_dot(way, page->frame[2]) / shade->lights[l].scale;
      if (along > 0) nearest = fmin(nearest, along);
    }
  return isfinite(nearest) ? nearest : 0;
}

enum result pixels_find(const struct shade *shade, struct pixels *pixels, struct error *error) {
  size_t count = (size_t)shade->width * (size_t)shade->height;
  *pixels = (struct pixels){.width = shade->width, .height = shade->height};
  pixels->compared = calloc(count, sizeof *pixels->compared);
  pixels->shows = calloc(3 * count, sizeof *pixels->shows);
  pixels->distance = calloc(count, sizeof *pixels->distance);
  if (!pixels->compared || !pixels->shows || !pixels->distance) return result_no_memory(error);
  for (size_t k = 0; k < count; ++k) {
    struct shade_hit hit;
    shade_ray(shade, (double)(k % (size_t)shade->width) + 0.5,
              (double)(k / (size_t)shade->width) + 0.5, k, &hit);
    if (!hit.lit) continue;
    pixels->compared[k] = true;
    ++pixels->count;
    pixels->distance[k] = distance_of(shade, hit.receiver.position);
    for (size_t c = 0; c < 3; ++c) pixels->shows[3 * k + c] = (float)hit.shows[c];
  }
  return RESULT_OK;
}

void pixels_free(struct pixels *pixels) {
  free(pixels->compared);
  free(pixels->shows);
  free(pixels->distance);
  *pixels = (struct pixels){0};
}

enum result pixels_read(const struct pixels *pixels, const char *path, struct picture *picture,
                        struct error *error) {
  enum result result = slab_exr_read(path, picture, error);
  if (result != RESULT_OK) return result;
  size_t values = 3 * (size_t)picture->width * (size_t)picture->height;
  bool good = picture->width == pixels->width && picture->height == pixels->height;
  for (size_t k = 0; good && k < values; ++k) good = isfinite(picture->rgb[k]);
  if (good) return RESULT_OK;
  picture_free(picture);
  return result_fail(error, RESULT_BAD, "%s: not a finite picture of %dx%d", path, pixels->width,
                     pixels->height);
}

void pixels_keep_marked(struct pixels *pixels, const struct picture *marked) {
  static const float mesh = 9e3f; /* of the 1e4 that it glows; mirrors return less */
  size_t count = (size_t)pixels->width * (size_t)pixels->height;
  for (size_t k = 0; k < count; ++k)
    if (pixels->compared[k] && !(marked->rgb[3 * k] > mesh)) {
      pixels->compared[k] = false;
      --pixels->count;
    }
}

/* Of the radiance a - b at a pixel; b NULL: of a. */
static double length_at(const float *a, const float *b, size_t pixel) {
  double square = 0;
  for (size_t c = 0; c < 3; ++c) {
    double difference = (double)a[3 * pixel + c] - (b ? (double)b[3 * pixel + c] : 0);
    square += difference * difference;
  }
  return sqrt(square);
}

double pixels_error(const struct pixels *pixels, const struct picture *picture,
                    const struct picture *truth) {
  size_t count = (size_t)pixels->width * (size_t)pixels->height;
  double square = 0, mean = 0;
  for (size_t k = 0; k < count; ++k) {
    if (!pixels->compared[k]) continue;
    double difference = length_at(picture->rgb, truth->rgb, k);
    square += difference * difference;
    mean += length_at(truth->rgb, NULL, k);
  }
  double all = (double)pixels->count;
  return sqrt(square / all) / (mean / all);
}

/* What pictures in single precision leave of a surface's own light. */
static const double rounding = 1e-5;

double pixels_light(const struct pixels *pixels, const struct picture *picture, double *distance) {
  size_t count = (size_t)pixels->width * (size_t)pixels->height;
  double light = 0, weighted = 0, before = 0;
  for (size_t k = 0; k < count; ++k) {
    if (!pixels->compared[k]) continue;
    double here = length_at(picture->rgb, pixels->shows, k);
    if (here < rounding * length_at(picture->rgb, NULL, k)) here = 0;
    light += here;
    if (pixels->distance[k] > 0) before += here;
    weighted += here * pixels->distance[k];
  }
  *distance = before > 0 ? weighted / before : 0;
  return pixels->count ? light / (double)pixels->count : 0;
}
