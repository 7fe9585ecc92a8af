#include "picture/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "picture/image_part.h"

/* Of the first pass where time is limited. */
static const double coarsest_tolerance = 0.3;

/* What is known of a tile of the picture. */
struct tile {
  int number;
  double error;          /* sum of the layer of errors */
  double relative_error; /* the largest of its receivers' */
  double tolerance;
};

struct image {
  const struct image_settings *settings;
  struct gather_settings pass;
  struct picture *picture;
  struct gather **gathers;  /* [threads] */
  struct image_part *parts; /* [threads]: a tile each */
  struct tile *tiles;       /* in the order of the pass */
  int columns, count;       /* of tiles */
  bool first;               /* pass: it is finished even if it is late */
};

static void set_tile(const struct image *image, int tile, struct image_part *part) {
  part->left = tile % image->columns * IMAGE_TILE;
  part->top = tile / image->columns * IMAGE_TILE;
  int width = image->picture->width - part->left, height = image->picture->height - part->top;
  part->width = width < IMAGE_TILE ? width : IMAGE_TILE;
  part->height = height < IMAGE_TILE ? height : IMAGE_TILE;
}

static bool time_is_over(const struct image_settings *settings) {
  return settings->until > 0 && progress_now() >= settings->until;
}

static enum result do_tile(void *context, int index, int worker, struct error *error) {
  const struct image *image = context;
  const struct image_settings *settings = image->settings;
  struct tile *tile = &image->tiles[index];
  struct image_part *part = &image->parts[worker];
  int samples = settings->samples * settings->samples;
  double worst = 0;
  if (!image->first && time_is_over(settings)) return RESULT_OK;
  set_tile(image, tile->number, part);
  image_part_clear(part);
  for (int sample = 0; sample < samples; ++sample) {
    image_part_trace(&settings->shade, settings->samples, sample, 0, part->width * part->height,
                     part);
    int count = image_part_receivers(part);
    if (count > 0) {
      enum result result =
          gather_light(image->gathers[worker], part->receivers, count, part->gathered, error);
      if (result != RESULT_OK) return result;
    }
    worst = fmax(worst, image_part_add(part));
  }
  tile->error = image_part_store(part, samples, image->picture);
  tile->relative_error = worst;
  tile->tolerance = image->pass.tolerance;
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
  enum result result = gather_create_all(&image->pass, settings->threads, image->gathers, error);
  if (result == RESULT_OK)
    result = tiles_run(settings->threads, image->count, do_tile, show_progress, image, error);
  gather_free_all(image->gathers, settings->threads, &report->counts);
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
    image->pass = settings->gather;
    image->pass.tolerance = tolerance;
    if (tolerance > wanted) coarsen_shadows(&image->pass);
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
  int columns = (picture->width + IMAGE_TILE - 1) / IMAGE_TILE;
  int rows = (picture->height + IMAGE_TILE - 1) / IMAGE_TILE;
  struct image image = {
      .settings = settings, .picture = picture, .columns = columns, .count = columns * rows};
  enum result result = RESULT_OK;
  image.gathers = calloc((size_t)settings->threads, sizeof *image.gathers);
  image.parts = calloc((size_t)settings->threads, sizeof *image.parts);
  image.tiles = calloc((size_t)image.count, sizeof *image.tiles);
  if (!image.gathers || !image.parts || !image.tiles) result = result_no_memory(error);
  for (int k = 0; result == RESULT_OK && k < image.count; ++k) image.tiles[k].number = k;
  for (int k = 0; result == RESULT_OK && k < settings->threads; ++k)
    result = image_part_create(IMAGE_TILE * IMAGE_TILE, &image.parts[k], error);
  if (result == RESULT_OK) result = run_passes(&image, report, error);
  if (result == RESULT_OK) sum_up(&image, report);
  for (int k = 0; image.parts && k < settings->threads; ++k) image_part_free(&image.parts[k]);
  free(image.gathers);
  free(image.parts);
  free(image.tiles);
  return result;
}

enum result image_render(const struct image_settings *settings, struct picture *picture,
                         struct image_report *report, struct error *error) {
  size_t pixels = (size_t)settings->shade.width * (size_t)settings->shade.height;
  enum result result = RESULT_OK;
  *report = (struct image_report){0};
  *picture = (struct picture){.width = settings->shade.width,
                              .height = settings->shade.height,
                              .rgb = calloc(pixels, 3 * sizeof(float)),
                              .error = calloc(pixels, 3 * sizeof(float))};
  if (!picture->rgb || !picture->error)
    result = result_fail(error, RESULT_MEMORY, "out of memory for a picture of %dx%d",
                         picture->width, picture->height);
  if (result == RESULT_OK)
    result = (settings->gl ? image_render_gl : render_tiles)(settings, picture, report, error);
  if (result != RESULT_OK) picture_free(picture);
  return result;
}
