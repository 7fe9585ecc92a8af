#include "picture/image_part.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum result image_part_create(size_t most, struct image_part *part, struct error *error) {
  *part = (struct image_part){.hits = calloc(most, sizeof *part->hits),
                              .receivers = calloc(most, sizeof *part->receivers),
                              .gathered = calloc(most, sizeof *part->gathered),
                              .sums = calloc(most, sizeof *part->sums)};
  if (part->hits && part->receivers && part->gathered && part->sums) return RESULT_OK;
  return result_no_memory(error);
}

void image_part_free(struct image_part *part) {
  free(part->hits);
  free(part->receivers);
  free(part->gathered);
  free(part->sums);
  *part = (struct image_part){0};
}

static int count_pixels(const struct image_part *part) {
  return part->width * part->height;
}

void image_part_clear(struct image_part *part) {
  memset(part->sums, 0, (size_t)count_pixels(part) * sizeof *part->sums);
}

void image_part_trace(const struct shade *shade, int grid, int sample, int first, int end,
                      struct image_part *part) {
  double dx = (sample % grid + 0.5) / grid, dy = (sample / grid + 0.5) / grid;
  for (int pixel = first; pixel < end; ++pixel) {
    int x = part->left + pixel % part->width, y = part->top + pixel / part->width;
    uint64_t number = (uint64_t)y * (uint64_t)shade->width + (uint64_t)x;
    uint64_t index = number * (uint64_t)(grid * grid) + (uint64_t)sample;
    shade_ray(shade, x + dx, y + dy, index, &part->hits[pixel]);
  }
}

int image_part_receivers(struct image_part *part) {
  int count = 0;
  for (int pixel = 0; pixel < count_pixels(part); ++pixel)
    if (part->hits[pixel].lit) part->receivers[count++] = part->hits[pixel].receiver;
  return count;
}

double image_part_add(struct image_part *part) {
  double worst = 0;
  int lit = 0;
  for (int pixel = 0; pixel < count_pixels(part); ++pixel) {
    const struct shade_hit *hit = &part->hits[pixel];
    const struct gathered *gathered = hit->lit ? &part->gathered[lit++] : NULL;
    double rgb[3], error[3];
    shade_radiance(hit, gathered, rgb, error);
    for (int c = 0; c < 3; ++c) {
      part->sums[pixel].rgb[c] += rgb[c];
      part->sums[pixel].error[c] += error[c];
    }
    if (gathered) worst = fmax(worst, gathered->error);
  }
  return worst;
}

double image_part_store(const struct image_part *part, int samples, struct picture *picture) {
  double sum = 0;
  for (int pixel = 0; pixel < count_pixels(part); ++pixel) {
    size_t x = (size_t)(part->left + pixel % part->width);
    size_t y = (size_t)(part->top + pixel / part->width);
    size_t first = 3 * (y * (size_t)picture->width + x);
    for (size_t c = 0; c < 3; ++c) {
      picture->rgb[first + c] = (float)(part->sums[pixel].rgb[c] / samples);
      picture->error[first + c] = (float)(part->sums[pixel].error[c] / samples);
      sum += part->sums[pixel].error[c] / samples;
    }
  }
  return sum;
}
