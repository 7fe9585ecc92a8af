/* image.c - see image.h. */
#include "image.h"

#include <stdlib.h>
#include <string.h>

#include "stats.h"

enum { TILE_PIXELS = IMAGE_TILE * IMAGE_TILE };

/* One thread's memory: what the rays of a tile meet, one ray a pixel at a time. */
struct worker {
  struct gather *gather;
  struct shade_hit hits[TILE_PIXELS];
  struct receiver receivers[TILE_PIXELS];
  struct gathered gathered[TILE_PIXELS];
  double sum[TILE_PIXELS][3], error[TILE_PIXELS][3];
};

struct image {
  const struct image_settings *settings;
  struct slab_picture *picture;
  struct worker *workers;
  int columns; /* of tiles */
};

struct area {
  int left, top, width, height; /* pixels */
};

static struct area area_of(const struct image *image, int tile) {
  const struct image_settings *settings = image->settings;
  struct area area = {.left = tile % image->columns * IMAGE_TILE,
                      .top = tile / image->columns * IMAGE_TILE};
  int width = settings->width - area.left, height = settings->height - area.top;
  area.width = width < IMAGE_TILE ? width : IMAGE_TILE;
  area.height = height < IMAGE_TILE ? height : IMAGE_TILE;
  return area;
}

/* Ray number `sample` of each pixel of the area. Returns how many receivers there are. */
static int trace(const struct image_settings *settings, struct area area, int sample,
                 struct worker *worker) {
  int count = 0, grid = settings->samples;
  double dx = (sample % grid + 0.5) / grid, dy = (sample / grid + 0.5) / grid;
  for (int pixel = 0; pixel < area.width * area.height; ++pixel) {
    int x = area.left + pixel % area.width, y = area.top + pixel / area.width;
    uint64_t number = (uint64_t)y * (uint64_t)settings->width + (uint64_t)x;
    uint64_t index = number * (uint64_t)(grid * grid) + (uint64_t)sample;
    double direction[3];
    camera_ray(&settings->camera, settings->width, settings->height, x + dx, y + dy, direction);
    struct shade_hit *hit = &worker->hits[pixel];
    shade_ray(&settings->shade, settings->camera.from, direction, index, hit);
    if (hit->lit) worker->receivers[count++] = hit->receiver;
  }
  return count;
}

static void add(const struct area area, struct worker *worker) {
  int lit = 0;
  for (int pixel = 0; pixel < area.width * area.height; ++pixel) {
    const struct shade_hit *hit = &worker->hits[pixel];
    const struct gathered *gathered = hit->lit ? &worker->gathered[lit++] : NULL;
    double rgb[3], error[3];
    shade_radiance(hit, gathered, rgb, error);
    for (int c = 0; c < 3; ++c) {
      worker->sum[pixel][c] += rgb[c];
      worker->error[pixel][c] += error[c];
    }
  }
}

static enum slab_result do_tile(void *context, int tile, int number, struct slab_error *error) {
  const struct image *image = context;
  const struct image_settings *settings = image->settings;
  struct worker *worker = &image->workers[number];
  struct area area = area_of(image, tile);
  int samples = settings->samples * settings->samples;
  memset(worker->sum, 0, sizeof worker->sum);
  memset(worker->error, 0, sizeof worker->error);
  for (int sample = 0; sample < samples; ++sample) {
    int count = trace(settings, area, sample, worker);
    if (count > 0) {
      enum slab_result result =
          gather_light(worker->gather, worker->receivers, count, worker->gathered, error);
      if (result != SLAB_OK) return result;
    }
    add(area, worker);
  }
  for (int pixel = 0; pixel < area.width * area.height; ++pixel) {
    size_t x = (size_t)(area.left + pixel % area.width),
           y = (size_t)(area.top + pixel / area.width);
    size_t first = 3 * (y * (size_t)settings->width + x);
    for (size_t c = 0; c < 3; ++c) {
      image->picture->rgb[first + c] = (float)(worker->sum[pixel][c] / samples);
      image->picture->error[first + c] = (float)(worker->error[pixel][c] / samples);
    }
  }
  return SLAB_OK;
}

static void show_progress(void *context, double done) {
  const struct image *image = context;
  const struct image_settings *settings = image->settings;
  if (settings->progress) settings->progress(settings->progress_context, done);
}

enum slab_result image_render(const struct image_settings *settings, struct slab_picture *picture,
                              struct gather_counts *counts, struct slab_error *error) {
  int columns = (settings->width + IMAGE_TILE - 1) / IMAGE_TILE;
  int rows = (settings->height + IMAGE_TILE - 1) / IMAGE_TILE;
  struct image image = {.settings = settings, .picture = picture, .columns = columns};
  enum slab_result result = SLAB_OK;
  *picture = (struct slab_picture){.width = settings->width, .height = settings->height};
  size_t pixels = (size_t)settings->width * (size_t)settings->height;
  picture->rgb = calloc(pixels, 3 * sizeof(float));
  picture->error = calloc(pixels, 3 * sizeof(float));
  image.workers = calloc((size_t)settings->threads, sizeof *image.workers);
  if (!picture->rgb || !picture->error || !image.workers)
    result = slab_fail(error, SLAB_MEMORY, "out of memory for a picture of %dx%d", settings->width,
                       settings->height);
  for (int k = 0; k < settings->threads && result == SLAB_OK; ++k)
    result = gather_create(&settings->gather, &image.workers[k].gather, error);
  if (result == SLAB_OK)
    result = tiles_run(settings->threads, columns * rows, do_tile, show_progress, &image, error);
  for (int k = 0; image.workers && k < settings->threads; ++k) {
    struct gather *gather = image.workers[k].gather;
    if (gather) stats_add_counts(counts, gather_counts(gather));
    gather_free(gather);
  }
  free(image.workers);
  if (result != SLAB_OK) slab_picture_free(picture);
  return result;
}
