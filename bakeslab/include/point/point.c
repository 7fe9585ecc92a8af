/* point.c - the far field of a lamp.
 *
 * 1. The lamp stands where its flux has its centre, or where its table was measured.
 * 2. The far field of each channel is painted into an image (point_image.c).
 * 3. Its errors are told before each page: of the image for a lamp of one page, else of the
 *    page's own far field. */
#include "include/point/point.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "slab/plane.h"
#include "slab/plane_shadow.h"

/* At which errors are told, in aperture widths. */
static const double distances[POINT_DISTANCES] = {1, 4, 16};

/* Errors are told around what a page lights, too. */
static const double margin = 1.1;

struct far_lamp {
  struct point_far *pages; /* with light; owned */
  int count;
};

/* A page before which errors are told. */
struct before {
  const struct point_far *far;
  const struct point *image; /* of the lamp, if this is its only page; or NULL */
};

static double dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* The texel nearest to a quarter in some channel, off the poles of its far field. */
static void choose_check(const struct point *point, struct include_check *check) {
  const struct picture *picture = &point->picture;
  double best = INFINITY;
  int height = picture->height, width = picture->width, rows = point->rows;
  int least = rows > 8 ? rows / 8 : 1;
  for (int j = 0; j < height; ++j)
    for (int i = 1; i < width - 1; ++i) {
      const float *rgb = picture->rgb + 3 * ((size_t)(height - 1 - j) * (size_t)width + (size_t)i);
      if (j % rows < least || j % rows >= rows - least) continue;
      for (int c = 0; c < 3; ++c) {
        double miss = fabs((double)rgb[c] - 0.25);
        if (miss >= best) continue;
        best = miss;
        *check = (struct include_check){.at = {(i + 0.5) / width, (j + 0.5) / height},
                                        .rgb = {(double)rgb[0], (double)rgb[1], (double)rgb[2]},
                                        .channel = c};
      }
    }
}

/* Irradiance of the far field on a receiver before a page: of the image, or of the page's own
 * light. */
static void far_irradiance(const void *of, int number, const double at[3], double rgb[3]) {
  (void)number;
  const struct before *before = of;
  const struct point_far *far = before->far;
  double along[3], direction[3], seen[3];
  for (int c = 0; c < 3; ++c) along[c] = at[c] + far->shift[c];
  double r2 = dot(along, along), r = sqrt(r2);
  for (int c = 0; c < 3; ++c)
    direction[c] =
        (along[0] * far->u[c] + along[1] * far->v[c] + along[2] * far->slab->normal[c]) / r;
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (before->image) {
    for (int k = 0; k < 3; ++k) seen[k] = dot(direction, before->image->axes[k]);
    point_look_up(before->image, seen, rgb);
  } else {
    point_far_add(far, direction, rgb);
  }
  for (int c = 0; c < 3; ++c) rgb[c] *= along[2] / r / r2;
}

/* Makes `*worst` at least the error before a page, at a distance in aperture widths. */
static void measure_at(const struct before *before, double distance, double *worst) {
  const struct slab *slab = before->far->slab;
  double error, away = distance * plane_width(slab);
  plane_errors(slab, away, margin, far_irradiance, before, 1, &error);
  *worst = fmax(*worst, error);
}

/* The same past an edge, which hides the light or does not. */
static void shadowed_irradiance(const void *of, int number,
                                const struct plane_shadow_receiver *receiver, double rgb[3]) {
  const struct point_far *far = ((const struct before *)of)->far;
  const double light[3] = {-far->shift[0], -far->shift[1], -far->shift[2]};
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!plane_shadow_hides(receiver, light)) far_irradiance(of, number, receiver->at, rgb);
}

static enum result measure_shadow(const struct before *before, struct point *point,
                                  struct error *error) {
  struct plane_shadow shadow;
  double away = point->distance * plane_width(before->far->slab);
  enum result result = plane_shadow_make(before->far->slab, away, &shadow, error);
  if (result == RESULT_OK)
    point->shadow_at =
        fmax(point->shadow_at, plane_shadow_error(&shadow, shadowed_irradiance, before, 0));
  plane_shadow_free(&shadow);
  return result;
}

static enum result measure(const struct far_lamp *lamp, struct progress *progress,
                           struct point *point, struct error *error) {
  for (int p = 0; p < lamp->count; ++p) {
    struct point_far *far = &lamp->pages[p];
    const struct before before = {far, lamp->count == 1 ? point : NULL};
    double from[3];
    if (progress) progress_show(progress, (double)p / lamp->count, "measuring the far field");
    for (int c = 0; c < 3; ++c) from[c] = far->slab->center[c] - point->center[c];
    far->shift[0] = dot(from, far->u);
    far->shift[1] = dot(from, far->v);
    far->shift[2] = dot(from, far->slab->normal);
    for (int d = 0; d < POINT_DISTANCES; ++d) measure_at(&before, distances[d], &point->error[d]);
    measure_at(&before, point->distance, &point->error_at);
    enum result result = measure_shadow(&before, point, error);
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}

/* The pages with light, where the lamp's centre is, and its axes. */
static enum result gather(const struct slab *const *lit, int count, struct far_lamp *lamp,
                          struct point *point, struct error *error) {
  double total = 0;
  lamp->pages = calloc((size_t)count, sizeof *lamp->pages);
  if (!lamp->pages) return result_no_memory(error);
  for (int p = 0; p < count; ++p) {
    struct point_far *far = &lamp->pages[lamp->count++];
    enum result result = point_far_make(lit[p], far, error);
    if (result != RESULT_OK) return result;
    double weight = far->flux[0] + far->flux[1] + far->flux[2];
    for (int c = 0; c < 3; ++c) point->center[c] += weight * lit[p]->center[c];
    total += weight;
    point->width = fmax(point->width, plane_width(lit[p]));
  }
  for (int c = 0; c < 3; ++c) {
    point->center[c] /= total;
    point->axes[0][c] = lamp->pages[0].u[c];
    point->axes[1][c] = lamp->pages[0].v[c];
    point->axes[2][c] = lit[0]->normal[c];
  }
  return RESULT_OK;
}

/* Stands where the table was measured, and has its axes. */
static void take_table(const struct point_table *table, struct point *point) {
  memset(point->center, 0, sizeof point->center);
  memcpy(point->axes, table->axes, sizeof point->axes);
  point->table = table;
}

static enum result finish(struct point *point, struct error *error) {
  const struct picture *picture = &point->picture;
  double fade = 1e-3 * point->width;
  for (int n = 0; n < point->count; ++n) {
    enum result result =
        include_check_colour(point->intensity[n] / (2 * M_PI * fade * fade), -1, error);
    if (result != RESULT_OK) return result;
  }
  point->lamp.flux = include_luminance(point->flux);
  choose_check(point, &point->lamp.check);
  size_t bytes = (size_t)picture->width * (size_t)picture->height * 3 * sizeof *picture->rgb;
  uint64_t hash = include_hash(include_hash_start, picture->rgb, bytes);
  hash = include_hash(hash, point->center, sizeof point->center);
  hash = include_hash(hash, point->intensity, sizeof point->intensity);
  point->lamp.stamp = include_hash(hash, point->axes, sizeof point->axes);
  return RESULT_OK;
}

enum result point_make(const struct slab *slabs, int count, const struct point_table *table,
                       double distance, struct progress *progress, struct point *point,
                       struct error *error) {
  struct far_lamp lamp = {0};
  const struct slab **lit = NULL;
  int lit_count = 0;
  memset(point, 0, sizeof *point);
  point->distance = distance;
  enum result result = include_lit_pages(slabs, count, &point->lamp, &lit, &lit_count, error);
  if (result == RESULT_OK) result = gather(lit, lit_count, &lamp, point, error);
  if (table && result == RESULT_OK) take_table(table, point);
  if (result == RESULT_OK) result = point_paint(lamp.pages, lamp.count, point, error);
  if (result == RESULT_OK) result = finish(point, error);
  if (result == RESULT_OK) result = measure(&lamp, progress, point, error);
  for (int p = 0; p < lamp.count; ++p) point_far_free(&lamp.pages[p]);
  free(lamp.pages);
  free(lit);
  return result;
}

void point_free(struct point *point) {
  picture_free(&point->picture);
  memset(point, 0, sizeof *point);
}
