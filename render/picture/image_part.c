#include "picture/image_part.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum result image_part_create(size_t most, struct image_part *part, struct error *error) {
  *part = (struct image_part){.step = 1,
                              .hits = calloc(most, sizeof *part->hits),
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

/* Pixels of the picture that a pixel of the part stands for: fewer at its edges. */
struct block {
  int left, top, width, height;
};

static struct block block_of(const struct image_part *part, int pixel, int width, int height) {
  int step = part->step;
  struct block block = {.left = (part->left + pixel % part->width) * step,
                        .top = (part->top + pixel / part->width) * step};
  block.width = width - block.left < step ? width - block.left : step;
  block.height = height - block.top < step ? height - block.top : step;
  return block;
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
    const struct block block = block_of(part, pixel, shade->width, shade->height);
    int x = block.left, y = block.top;
    uint64_t number = (uint64_t)y * (uint64_t)shade->width + (uint64_t)x;
    uint64_t index = number * (uint64_t)(grid * grid) + (uint64_t)sample;
    shade_ray(shade, x + dx * block.width, y + dy * block.height, index, &part->hits[pixel]);
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

/* What is not its own light has an unknown error. */
static void fill_block(const struct block *block, const double rgb[3], const double error[3],
                       struct picture *picture) {
  bool shared = block->width * block->height > 1;
  for (int y = block->top; y < block->top + block->height; ++y)
    for (int x = block->left; x < block->left + block->width; ++x) {
      size_t first = 3 * ((size_t)y * (size_t)picture->width + (size_t)x);
      for (size_t c = 0; c < 3; ++c) {
        picture->rgb[first + c] = (float)rgb[c];
        picture->error[first + c] = shared ? INFINITY : (float)error[c];
      }
    }
}

double image_part_store(const struct image_part *part, int samples, struct picture *picture) {
  double sum = 0;
  for (int pixel = 0; pixel < count_pixels(part); ++pixel) {
    const struct block block = block_of(part, pixel, picture->width, picture->height);
    double rgb[3], error[3];
    for (size_t c = 0; c < 3; ++c) {
      rgb[c] = part->sums[pixel].rgb[c] / samples;
      error[c] = part->sums[pixel].error[c] / samples;
      sum += error[c];
    }
    fill_block(&block, rgb, error, picture);
  }
  return sum;
}
