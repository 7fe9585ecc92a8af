/* image.c - see image.h. */
#include "picture/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"

/* Of the first pass where time is limited. */
static const double coarsest_tolerance = 0.3;

enum { TILE_PIXELS = IMAGE_TILE * IMAGE_TILE };

/* One thread's memory: what the rays of a tile meet, one ray a pixel at a time. */
struct worker {
  struct gather *gather;
  struct shade_hit hits[TILE_PIXELS];
  struct receiver receivers[TILE_PIXELS];
  struct gathered gathered[TILE_PIXELS];
  double sum[TILE_PIXELS][3], error[TILE_PIXELS][3];
};

/* What is known of a tile of the picture. */
struct tile {
  int number;
  double error;          /* sum of the layer of errors */
  double relative_error; /* the largest of its receivers' */
  double tolerance;
};

struct image {
  const struct image_settings *settings;
  struct gather_settings gather; /* of the pass */
  struct picture *picture;
  struct worker *workers;
  struct tile *tiles; /* in the order of the pass */
  int columns, count; /* of tiles */
  bool first;         /* pass: it is finished even if it is late */
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

void image_trace(const struct image_settings *settings, int x, int y, int sample,
                 struct shade_hit *hit) {
  int grid = settings->samples;
  double dx = (sample % grid + 0.5) / grid, dy = (sample / grid + 0.5) / grid, direction[3];
  uint64_t number = (uint64_t)y * (uint64_t)settings->width + (uint64_t)x;
  uint64_t index = number * (uint64_t)(grid * grid) + (uint64_t)sample;
  camera_ray(&settings->camera, settings->width, settings->height, x + dx, y + dy, direction);
  shade_ray(&settings->shade, settings->camera.from, direction, index, hit);
}

/* Ray number `sample` of each pixel of the area. Returns how many receivers there are. */
static int trace(const struct image_settings *settings, struct area area, int sample,
                 struct worker *worker) {
  int count = 0;
  for (int pixel = 0; pixel < area.width * area.height; ++pixel) {
    struct shade_hit *hit = &worker->hits[pixel];
    image_trace(settings, area.left + pixel % area.width, area.top + pixel / area.width, sample,
                hit);
    if (hit->lit) worker->receivers[count++] = hit->receiver;
  }
  return count;
}

/* Returns the largest relative error. */
static double add(const struct area area, struct worker *worker) {
  double worst = 0;
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
    if (gathered) worst = fmax(worst, gathered->error);
  }
  return worst;
}

/* Puts the means into the picture. Returns the sum of the errors. */
static double store(const struct image *image, const struct area area,
                    const struct worker *worker) {
  const struct image_settings *settings = image->settings;
  int samples = settings->samples * settings->samples;
  double sum = 0;
  for (int pixel = 0; pixel < area.width * area.height; ++pixel) {
    size_t x = (size_t)(area.left + pixel % area.width);
    size_t y = (size_t)(area.top + pixel / area.width);
    size_t first = 3 * (y * (size_t)settings->width + x);
    for (size_t c = 0; c < 3; ++c) {
      image->picture->rgb[first + c] = (float)(worker->sum[pixel][c] / samples);
      image->picture->error[first + c] = (float)(worker->error[pixel][c] / samples);
      sum += worker->error[pixel][c] / samples;
    }
  }
  return sum;
}

static bool time_is_over(const struct image_settings *settings) {
  return settings->until > 0 && progress_now() >= settings->until;
}

static enum result do_tile(void *context, int index, int number, struct error *error) {
  const struct image *image = context;
  const struct image_settings *settings = image->settings;
  struct worker *worker = &image->workers[number];
  struct tile *tile = &image->tiles[index];
  struct area area = area_of(image, tile->number);
  double worst = 0;
  if (!image->first && time_is_over(settings)) return RESULT_OK;
  memset(worker->sum, 0, sizeof worker->sum);
  memset(worker->error, 0, sizeof worker->error);
  for (int sample = 0; sample < settings->samples * settings->samples; ++sample) {
    int count = trace(settings, area, sample, worker);
    if (count > 0) {
      enum result result =
          gather_light(worker->gather, worker->receivers, count, worker->gathered, error);
      if (result != RESULT_OK) return result;
    }
    worst = fmax(worst, add(area, worker));
  }
  tile->error = store(image, area, worker);
  tile->relative_error = worst;
  tile->tolerance = image->gather.tolerance;
  return RESULT_OK;
}

static void show_progress(void *context, double done) {
  const struct image *image = context;
  const struct image_settings *settings = image->settings;
  if (settings->progress) settings->progress(settings->progress_context, done);
}

/* Renders all tiles, or those that time allows. */
static enum result run_pass(struct image *image, struct image_report *report, struct error *error) {
  const struct image_settings *settings = image->settings;
  enum result result = RESULT_OK;
  for (int k = 0; k < settings->threads && result == RESULT_OK; ++k)
    result = gather_create(&image->gather, &image->workers[k].gather, error);
  if (result == RESULT_OK)
    result = tiles_run(settings->threads, image->count, do_tile, show_progress, image, error);
  for (int k = 0; k < settings->threads; ++k) {
    struct gather *gather = image->workers[k].gather;
    if (gather) gather_counts_add(&report->counts, gather_counts(gather));
    gather_free(gather);
    image->workers[k].gather = NULL;
  }
  ++report->passes;
  return result;
}

static int by_error(const void *left, const void *right) {
  const struct tile *a = left, *b = right;
  if (a->error != b->error) return a->error > b->error ? -1 : 1;
  return (a->number > b->number) - (a->number < b->number);
}

/* Shadows no finer than the tolerance calls for: blocks of 1/4 and edges of 1/8 at first. */
static void coarsen_shadows(struct gather_settings *gather) {
  double edge = fmin(fmax(2 / gather->tolerance, 8), gather->shadow_edge);
  gather->shadow_edge = (int)edge;
  gather->shadow_grid = (int)fmin(gather->shadow_grid, fmax(4, edge / 4));
}

/* Passes with ever smaller tolerances; one with that asked for where time does not matter. */
static enum result run_passes(struct image *image, struct image_report *report,
                              struct error *error) {
  const struct image_settings *settings = image->settings;
  double wanted = settings->gather.tolerance, tolerance = wanted;
  if (settings->until > 0 && settings->gather.method == GATHER_AUTO)
    tolerance = fmax(coarsest_tolerance, wanted);
  for (image->first = true;; image->first = false) {
    image->gather = settings->gather;
    image->gather.tolerance = tolerance;
    if (tolerance > wanted) coarsen_shadows(&image->gather);
    enum result result = run_pass(image, report, error);
    if (result != RESULT_OK) return result;
    if (image->first) report->late = time_is_over(settings);
    if (tolerance <= wanted || time_is_over(settings)) return RESULT_OK;
    qsort(image->tiles, (size_t)image->count, sizeof *image->tiles, by_error);
    tolerance = fmax(tolerance / 10, wanted);
  }
}

static void sum_up(const struct image *image, struct image_report *report) {
  report->best_tolerance = INFINITY;
  for (int k = 0; k < image->count; ++k) {
    report->error = fmax(report->error, image->tiles[k].relative_error);
    report->worst_tolerance = fmax(report->worst_tolerance, image->tiles[k].tolerance);
    report->best_tolerance = fmin(report->best_tolerance, image->tiles[k].tolerance);
  }
  report->counts.error = report->error;
}

/* By the CPU: tile by tile. */
static enum result render_tiles(const struct image_settings *settings, struct picture *picture,
                                struct image_report *report, struct error *error) {
  int columns = (settings->width + IMAGE_TILE - 1) / IMAGE_TILE;
  int rows = (settings->height + IMAGE_TILE - 1) / IMAGE_TILE;
  struct image image = {
      .settings = settings, .picture = picture, .columns = columns, .count = columns * rows};
  enum result result = RESULT_OK;
  image.workers = calloc((size_t)settings->threads, sizeof *image.workers);
  image.tiles = calloc((size_t)image.count, sizeof *image.tiles);
  if (!image.workers || !image.tiles) result = result_fail(error, RESULT_MEMORY, "out of memory");
  for (int k = 0; result == RESULT_OK && k < image.count; ++k) image.tiles[k].number = k;
  if (result == RESULT_OK) result = run_passes(&image, report, error);
  if (result == RESULT_OK) sum_up(&image, report);
  free(image.workers);
  free(image.tiles);
  return result;
}

enum result image_render(const struct image_settings *settings, struct picture *picture,
                         struct image_report *report, struct error *error) {
  size_t pixels = (size_t)settings->width * (size_t)settings->height;
  enum result result = RESULT_OK;
  *report = (struct image_report){0};
  *picture = (struct picture){.width = settings->width,
                              .height = settings->height,
                              .rgb = calloc(pixels, 3 * sizeof(float)),
                              .error = calloc(pixels, 3 * sizeof(float))};
  if (!picture->rgb || !picture->error)
    result = result_fail(error, RESULT_MEMORY, "out of memory for a picture of %dx%d",
                         settings->width, settings->height);
  if (result == RESULT_OK)
    result = (settings->gl ? image_render_gl : render_tiles)(settings, picture, report, error);
  if (result != RESULT_OK) picture_free(picture);
  return result;
}
