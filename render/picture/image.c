#include "picture/image.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "picture/image_part.h"
#include "picture/refine.h"

/* Of the first pass where time is limited, and how many rays that has. */
static const double coarsest_tolerance = 0.3;
enum { FIRST_RAYS = 200 };

/* Seconds that a thread may gather without a look at the clock. */
static const double glance = 5e-4;

/* What is known of a tile of the picture. */
struct tile {
  int step;
  double error;          /* sum of the layer of errors */
  double relative_error; /* the largest of its receivers' */
  double tolerance;
};

/* A tile and its place in the order of a pass. */
struct place {
  double error;
  int number;
};

/* One pass over the picture: a ray for step x step pixels, or more where pixels want them. */
struct pass {
  int step;
  bool refines;
  int columns, count; /* of its tiles, which are IMAGE_TILE x step pixels wide */
  double until;       /* it must end, where time is limited */
  bool first;         /* it is finished even if it is late */
  int chunk;          /* receivers from one look at the clock to the next */
  struct gather_settings gather;
};

struct image {
  const struct image_settings *settings;
  struct pass pass;
  struct picture *picture;
  struct gather **gathers;  /* [threads] */
  struct image_part *parts; /* [threads]: a tile each */
  struct refine refine;     /* where there are to be more rays than one a pixel */
  struct refine_rays *rays; /* [threads] */
  int columns, rows;        /* of tiles */
  int first_row, end_row;   /* of tiles that are rendered */
  struct tile *tiles;       /* [columns x rows] */
  struct place *order;      /* the same number, of which a pass of larger steps needs fewer */
};

static int divide_up(int number, int by) {
  return number / by + (number % by > 0);
}

static void set_part(const struct image *image, int number, struct image_part *part) {
  const struct pass *pass = &image->pass;
  part->step = pass->step;
  part->left = number % pass->columns * IMAGE_TILE;
  part->top = number / pass->columns * IMAGE_TILE;
  int width = divide_up(image->picture->width, pass->step) - part->left;
  int height = divide_up(image->picture->height, pass->step) - part->top;
  part->width = width < IMAGE_TILE ? width : IMAGE_TILE;
  part->height = height < IMAGE_TILE ? height : IMAGE_TILE;
}

static bool time_is_over(const struct image *image) {
  return image->settings->until && progress_now() >= image->pass.until;
}

/* Gathers for the receivers; *late, and nothing is of use, where time is over before. */
static enum result gather(const struct image *image, const struct receiver *receivers, int count,
                          int worker, struct gathered *gathered, bool *late, struct error *error) {
  enum result result = RESULT_OK;
  int chunk = image->pass.chunk;
  for (int k = 0; k < count && result == RESULT_OK; k += chunk) {
    *late = !image->pass.first && time_is_over(image);
    if (*late) break;
    result = gather_light(image->gathers[worker], receivers + k,
                          count - k < chunk ? count - k : chunk, gathered + k, error);
  }
  return result;
}

/* Notes what is known now of all tiles of the picture that this one covers. */
static void note_tile(const struct image *image, int number, const struct tile *tile) {
  int step = tile->step;
  int left = number % image->pass.columns * step, top = number / image->pass.columns * step;
  for (int y = top; y < top + step && y < image->rows; ++y)
    for (int x = left; x < left + step && x < image->columns; ++x)
      image->tiles[(size_t)y * (size_t)image->columns + (size_t)x] = *tile;
}

/* One ray for each pixel of the part. */
static enum result do_tile(struct image *image, int number, int worker, struct error *error) {
  const struct pass *pass = &image->pass;
  struct image_part *part = &image->parts[worker];
  struct tile tile = {.step = pass->step, .tolerance = pass->gather.tolerance};
  bool late = false;
  set_part(image, number, part);
  image_part_clear(part);
  image_part_trace(&image->settings->shade, 1, 0, 0, part->width * part->height, part);
  int count = image_part_receivers(part);
  enum result result = gather(image, part->receivers, count, worker, part->gathered, &late, error);
  if (result != RESULT_OK || late) return result;
  tile.relative_error = image_part_add(part);
  tile.error = image_part_store(part, 1, image->picture);
  if (image->refine.seen && pass->step == 1) refine_note(&image->refine, part);
  note_tile(image, number, &tile);
  return RESULT_OK;
}

/* More rays for the pixels in `rays`, in two rounds of gathering. */
static enum result refine_pixels(struct image *image, int worker, bool *late, struct error *error) {
  struct refine_rays *rays = &image->rays[worker];
  enum result result = RESULT_OK;
  refine_trace(&image->refine, rays);
  for (int round = 0; round < 2 && result == RESULT_OK && !*late; ++round) {
    refine_ask(&image->refine, round == 0, rays);
    result = gather(image, rays->receivers, rays->asked, worker, rays->gathered, late, error);
    if (result == RESULT_OK && !*late) refine_take(rays);
  }
  return result;
}

/* More rays where pixels of the tile want them. */
static enum result refine_tile(struct image *image, int number, int worker, struct error *error) {
  struct image_part *part = &image->parts[worker];
  struct refine_rays *rays = &image->rays[worker];
  struct tile *tile = &image->tiles[number];
  enum result result = RESULT_OK;
  bool late = false;
  set_part(image, number, part);
  int pixels = part->width * part->height;
  for (int next = 0; next < pixels && result == RESULT_OK && !late;) {
    for (rays->count = 0; next < pixels && rays->count < rays->most; ++next) {
      int x = part->left + next % part->width, y = part->top + next / part->width;
      if (refine_wants(&image->refine, x, y))
        rays->pixels[rays->count++] = y * image->picture->width + x;
    }
    result = refine_pixels(image, worker, &late, error);
    if (result == RESULT_OK && !late)
      tile->relative_error = fmax(tile->relative_error, refine_store(rays, image->picture));
  }
  return result;
}

static enum result do_piece(void *context, int index, int worker, struct error *error) {
  struct image *image = context;
  int number = image->order[index].number;
  if (!image->pass.first && time_is_over(image)) return RESULT_OK;
  return (image->pass.refines ? refine_tile : do_tile)(image, number, worker, error);
}

static void show_progress(void *context, double done) {
  const struct image *image = context;
  const struct image_settings *settings = image->settings;
  if (image->refine.seen) done = (image->pass.refines + done) / 2;
  if (settings->progress) settings->progress(settings->progress_context, done);
}

static int by_error(const void *left, const void *right) {
  const struct place *a = left, *b = right;
  if (a->error != b->error) return a->error > b->error ? -1 : 1;
  return (a->number > b->number) - (a->number < b->number);
}

/* Tiles of the picture itself with the largest errors first. */
static void set_order(struct image *image) {
  struct pass *pass = &image->pass;
  pass->columns = divide_up(image->columns, pass->step);
  int first = image->first_row / pass->step * pass->columns;
  pass->count = pass->columns * divide_up(image->end_row, pass->step) - first;
  for (int k = 0; k < pass->count; ++k)
    image->order[k] = (struct place){pass->step > 1 ? 0 : image->tiles[first + k].error, first + k};
  if (pass->step == 1) qsort(image->order, (size_t)pass->count, sizeof *image->order, by_error);
}

/* Renders all tiles, or those that time allows. */
static enum result run_pass(struct image *image, struct image_report *report, struct error *error) {
  const struct image_settings *settings = image->settings;
  struct gather **gathers = image->gathers;
  set_order(image);
  enum result result = gather_create_all(&image->pass.gather, settings->threads, gathers, error);
  if (result == RESULT_OK)
    result = tiles_run(settings->threads, image->pass.count, do_piece, show_progress, image, error);
  gather_free_all(gathers, settings->threads, &report->counts);
  ++report->passes;
  return result;
}

/* Shadows no finer than the tolerance calls for: blocks of 1/4 and edges of 1/8 at first. */
static void coarsen_shadows(struct gather_settings *gather) {
  double edge = fmin(fmax(2 / gather->tolerance, 8), gather->shadow_edge);
  gather->shadow_edge = (int)edge;
  gather->shadow_grid = (int)fmin(gather->shadow_grid, fmax(4, edge / 4));
}

static double rays_of(const struct picture *picture, int step) {
  return (double)divide_up(picture->width, step) * divide_up(picture->height, step);
}

int image_first_step(int width, int height) {
  const struct picture picture = {.width = width, .height = height};
  int step = 1;
  while (rays_of(&picture, step) > FIRST_RAYS) step *= 2;
  return step;
}

static void set_end(struct image *image) {
  const struct image_settings *settings = image->settings;
  if (settings->until)
    image->pass.until = settings->until(settings->until_context, image->pass.step);
}

static void set_tolerance(struct image *image, double tolerance) {
  struct gather_settings *gather = &image->pass.gather;
  *gather = image->settings->gather;
  if (tolerance <= gather->tolerance) return;
  gather->tolerance = tolerance;
  coarsen_shadows(gather);
}

/* The first pass: a ray for each pixel, where time does not matter. */
static void set_first(struct image *image) {
  const struct image_settings *settings = image->settings;
  const struct picture *picture = image->picture;
  bool limited = settings->until != NULL;
  bool dial = gather_methods[settings->gather.method].dial == METHOD_BY_TOLERANCE;
  image->pass =
      (struct pass){.step = limited ? image_first_step(picture->width, picture->height) : 1,
                    .first = true,
                    .chunk = INT_MAX};
  set_tolerance(image, limited && dial ? coarsest_tolerance : 0);
  set_end(image);
}

/* Of a pass in which pixels share rays, after one that took so many seconds: more rays, as many
 * at once as surely find the time. */
static void set_step(struct image *image, double seconds) {
  struct pass *pass = &image->pass;
  double each = seconds / rays_of(image->picture, pass->step), left = pass->until - progress_now();
  pass->chunk = (int)fmin(fmax(glance / (each * image->settings->threads), 1), INT_MAX);
  if (pass->step == 1) return;
  pass->step /= 2;
  while (pass->step > 1 && 2 * each * rays_of(image->picture, pass->step / 2) < left)
    pass->step /= 2;
}

/* The mean over N x N receivers has edges of shadows N times as fine as each of them. */
static void set_refine(struct image *image) {
  struct gather_settings *gather = &image->pass.gather;
  int edge = gather->shadow_edge / image->settings->samples;
  image->pass.refines = true;
  gather->shadow_edge = edge > gather->shadow_grid ? edge : gather->shadow_grid;
}

/* The next pass, after one that took so many seconds; false where all is done: a ray for each
 * pixel; then smaller tolerances; then more rays where pixels want them. */
static bool set_next(struct image *image, double seconds) {
  const struct image_settings *settings = image->settings;
  struct pass *pass = &image->pass;
  bool shared = pass->step > 1;
  pass->first = settings->until == NULL;
  if (settings->until) set_step(image, seconds);
  if (!shared) {
    if (pass->gather.tolerance > settings->gather.tolerance)
      set_tolerance(image, pass->gather.tolerance / 10);
    else if (image->refine.seen && !pass->refines)
      set_refine(image);
    else
      return false;
  }
  set_end(image);
  return true;
}

/* The first pass over a row of tiles beside those that are rendered: pixels look at their
 * neighbours where they want more rays. It is not counted. */
static enum result run_beside(struct image *image, int row, struct error *error) {
  const int first = image->first_row, end = image->end_row;
  struct image_report own = {0};
  if (!image->refine.seen || row < 0 || row >= image->rows) return RESULT_OK;
  image->first_row = row;
  image->end_row = row + 1;
  enum result result = run_pass(image, &own, error);
  image->first_row = first;
  image->end_row = end;
  return result;
}

static enum result run_passes(struct image *image, struct image_report *report,
                              struct error *error) {
  double start;
  set_first(image);
  enum result beside = run_beside(image, image->first_row - 1, error);
  if (beside == RESULT_OK) beside = run_beside(image, image->end_row, error);
  if (beside != RESULT_OK) return beside;
  do {
    start = progress_now();
    enum result result = run_pass(image, report, error);
    if (result != RESULT_OK) return result;
  } while (set_next(image, progress_now() - start) && !time_is_over(image));
  return RESULT_OK;
}

static void sum_up(const struct image *image, struct image_report *report) {
  report->best_tolerance = INFINITY;
  report->worst_step = 1;
  for (int k = image->columns * image->first_row; k < image->columns * image->end_row; ++k) {
    const struct tile *tile = &image->tiles[k];
    report->error = fmax(report->error, tile->relative_error);
    report->worst_tolerance = fmax(report->worst_tolerance, tile->tolerance);
    report->best_tolerance = fmin(report->best_tolerance, tile->tolerance);
    if (tile->step > report->worst_step) report->worst_step = tile->step;
  }
  report->counts.error = report->worst_step > 1 ? INFINITY : report->error;
}

static enum result create(struct image *image, struct error *error) {
  const struct image_settings *settings = image->settings;
  size_t tiles = (size_t)image->columns * (size_t)image->rows, threads = (size_t)settings->threads;
  enum result result = RESULT_OK;
  image->gathers = calloc(threads, sizeof *image->gathers);
  image->parts = calloc(threads, sizeof *image->parts);
  image->rays = calloc(threads, sizeof *image->rays);
  image->tiles = calloc(tiles, sizeof *image->tiles);
  image->order = calloc(tiles, sizeof *image->order);
  if (!image->gathers || !image->parts || !image->rays || !image->tiles || !image->order)
    result = result_no_memory(error);
  for (size_t k = 0; result == RESULT_OK && k < threads; ++k)
    result = image_part_create(IMAGE_TILE * IMAGE_TILE, &image->parts[k], error);
  if (settings->samples == 1) return result;
  if (result == RESULT_OK)
    result = refine_create(&settings->shade, settings->gather.tolerance, &image->refine, error);
  for (size_t k = 0; result == RESULT_OK && k < threads; ++k)
    result = refine_rays_create(settings->samples, IMAGE_TILE * IMAGE_TILE, &image->rays[k], error);
  return result;
}

static void destroy(struct image *image) {
  for (int k = 0; image->parts && k < image->settings->threads; ++k)
    image_part_free(&image->parts[k]);
  for (int k = 0; image->rays && k < image->settings->threads; ++k)
    refine_rays_free(&image->rays[k]);
  refine_free(&image->refine);
  free(image->gathers);
  free(image->parts);
  free(image->rays);
  free(image->tiles);
  free(image->order);
}

/* By the CPU: tile by tile. */
static enum result render_tiles(const struct image_settings *settings, struct picture *picture,
                                struct image_report *report, struct error *error) {
  struct image image = {.settings = settings,
                        .picture = picture,
                        .columns = divide_up(picture->width, IMAGE_TILE),
                        .rows = divide_up(picture->height, IMAGE_TILE)};
  image.first_row = settings->first_row;
  image.end_row = settings->end_row > 0 ? settings->end_row : image.rows;
  enum result result = create(&image, error);
  if (result == RESULT_OK) result = run_passes(&image, report, error);
  if (result == RESULT_OK) sum_up(&image, report);
  destroy(&image);
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
