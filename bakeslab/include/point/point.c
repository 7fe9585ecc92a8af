/* point.c - the far field of a lamp.
 *
 * 1. The far field along a direction is the sum over all pages and their views of radiance
 *    times cosine times a view's share of the aperture.
 * 2. It is painted as a lat-long image, each channel over its peak, rounded as the file will be.
 *    A table of intensities, where there is one, is the image instead.
 * 3. What the image holds as 1 gets the intensity that makes the light's flux the slab's.
 * 4. Its errors are told before each page: of the image for a lamp of one page, else of the
 *    page's own far field. */
#include "include/point/point.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_half.h"
#include "slab/plane.h"
#include "slab/plane_shadow.h"
#include "slab/slab_resample.h"

/* At which errors are told, in aperture widths. */
static const double distances[POINT_DISTANCES] = {1, 4, 16};

/* The image is fine, since a window may end sharply. */
enum { LEAST_WIDTH = 1024, MOST_WIDTH = 2048, MOST_VIEWS = 8 };

/* Errors are told around what a page lights, too. */
static const double margin = 1.1;

/* Far away a page is its views' sum: one view where the st plane is at infinity, so
 * that all see the same slopes. */
struct far_page {
  const struct slab *slab;
  struct slab views;         /* owned */
  double u[3], v[3];         /* unit */
  double shift[3];           /* of its centre from the lamp's, along u, v and normal */
  const struct point *image; /* of the lamp, if this is its only page or a table; or NULL */
};

struct far_lamp {
  struct far_page *pages; /* with light; owned */
  int count;
};

static double dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static enum result make_far_page(const struct slab *slab, struct far_page *far,
                                 struct error *error) {
  int most = slab_kappa(slab) > 0 ? MOST_VIEWS : 1, samples[SLAB_AXES];
  far->slab = slab;
  memcpy(samples, slab->samples, sizeof samples);
  for (int axis = SLAB_U; axis <= SLAB_V; ++axis)
    if (samples[axis] > most) samples[axis] = most;
  for (int c = 0; c < 3; ++c) {
    far->u[c] = slab->u[c] / plane_edge(slab, SLAB_U);
    far->v[c] = slab->v[c] / plane_edge(slab, SLAB_V);
  }
  return slab_resample(slab, samples, &far->views, error);
}

/* Intensity of one page along a unit vector of lamp space, added to rgb. */
static void add_intensity(const struct far_page *far, const double direction[3], double rgb[3]) {
  const struct slab *views = &far->views;
  double cosine = dot(direction, views->normal), kappa = slab_kappa(views);
  if (!(cosine > 0)) return;
  double s = dot(direction, far->u) / cosine, t = dot(direction, far->v) / cosine;
  double area = slab_spacing(views, SLAB_U) * slab_spacing(views, SLAB_V);
  for (int j = 0; j < views->samples[SLAB_V]; ++j)
    for (int i = 0; i < views->samples[SLAB_U]; ++i) {
      double a = slab_position(views, SLAB_U, i), b = slab_position(views, SLAB_V, j);
      double radiance[3];
      slab_lookup(views, a, b, s + kappa * a, t + kappa * b, radiance);
      for (int c = 0; c < 3; ++c) rgb[c] += radiance[c] * cosine * area;
    }
}

/* Of the image's texel (i, j), the unit vector in the image's own axes. */
static void texel_direction(const struct point *point, int i, int j, double direction[3]) {
  double longitude = point->first[0] + i * point->step[0];
  double latitude = point->first[1] + j * point->step[1];
  direction[0] = cos(latitude) * cos(longitude);
  direction[1] = sin(latitude);
  direction[2] = cos(latitude) * sin(longitude);
}

/* A vector along three axes, in lamp space. */
static void to_lamp(const double axes[3][3], const double x[3], double vector[3]) {
  for (int c = 0; c < 3; ++c) vector[c] = x[0] * axes[0][c] + x[1] * axes[1][c] + x[2] * axes[2][c];
}

/* Wide enough for two columns in the narrowest sample, at the window's corner. */
static int image_width(const struct far_lamp *lamp) {
  double least = INFINITY;
  for (int p = 0; p < lamp->count; ++p)
    for (int k = 0; k < 2; ++k) {
      const struct slab *views = &lamp->pages[p].views;
      const double *w = views->st_window + 2 * k;
      double steepest = fmax(fabs(w[0]), fabs(w[1]));
      least = fmin(least, slab_spacing(views, SLAB_S + k) / (1 + steepest * steepest));
    }
  int width = LEAST_WIDTH;
  while (width < MOST_WIDTH && width * least < 4 * M_PI) width *= 2;
  return width;
}

/* What the file holds of a value. */
static double round_as_file(double value) {
  return (double)imath_half_to_float(imath_float_to_half((float)value));
}

/* Paints the intensity of each channel over its peak, rounded to half as the file will be;
 * `flux` is what the bilinear image then gives. */
static enum result paint(const struct far_lamp *lamp, struct point *point, double flux[3],
                         struct error *error) {
  struct picture *picture = &point->picture;
  int width = image_width(lamp), height = width / 2;
  size_t values = (size_t)width * (size_t)height * 3;
  double step = M_PI / height, peak[3] = {0, 0, 0}, *image = calloc(values, sizeof *image);
  picture->rgb = calloc(values, sizeof *picture->rgb);
  if (!image || !picture->rgb) {
    free(image);
    return result_fail(error, RESULT_MEMORY, "out of memory for the image");
  }
  picture->width = width;
  picture->height = height;
  for (int k = 0; k < 2; ++k) point->step[k] = step;
  point->first[0] = step / 2;
  point->first[1] = step / 2 - M_PI / 2;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      double along[3], direction[3];
      double *rgb = image + 3 * ((size_t)(height - 1 - j) * (size_t)width + (size_t)i);
      texel_direction(point, i, j, along);
      to_lamp(point->axes, along, direction);
      for (int p = 0; p < lamp->count; ++p) add_intensity(&lamp->pages[p], direction, rgb);
      for (int c = 0; c < 3; ++c) peak[c] = fmax(peak[c], rgb[c]);
    }
  flux[0] = flux[1] = flux[2] = 0;
  for (size_t k = 0; k < values; ++k) {
    if (!(peak[k % 3] > 0)) continue;
    double latitude = ((height - 0.5) - (double)(k / 3 / (size_t)width)) * step - M_PI / 2;
    picture->rgb[k] = (float)round_as_file(image[k] / peak[k % 3]);
    /* The integral of a texel's hat function over longitude and latitude. */
    flux[k % 3] += (double)picture->rgb[k] * step * cos(latitude) * 2 * (1 - cos(step)) / step;
  }
  free(image);
  return RESULT_OK;
}

/* The table as the image, rounded in the same way. */
static enum result paint_table(const struct point_table *table, struct point *point, double flux[3],
                               struct error *error) {
  struct picture *picture = &point->picture;
  int width = table->columns, height = table->rows;
  size_t nodes = (size_t)width * (size_t)height;
  double peak = 0, *rounded = malloc(nodes * sizeof *rounded);
  picture->rgb = calloc(nodes, 3 * sizeof *picture->rgb);
  if (!rounded || !picture->rgb) {
    free(rounded);
    return result_no_memory(error);
  }
  picture->width = width;
  picture->height = height;
  point->step[0] = 2 * M_PI / (width - 1);
  point->step[1] = M_PI / (height - 1);
  point->first[1] = -M_PI / 2;
  for (size_t k = 0; k < nodes; ++k) peak = fmax(peak, table->intensity[k]);
  for (size_t k = 0; k < nodes; ++k) {
    size_t row = (size_t)height - 1 - k / (size_t)width, column = k % (size_t)width;
    float *rgb = picture->rgb + 3 * (row * (size_t)width + column);
    rounded[k] = round_as_file(table->intensity[k] / peak);
    for (int c = 0; c < 3; ++c) rgb[c] = (float)rounded[k];
  }
  for (int c = 0; c < 3; ++c) {
    flux[c] = point_table_flux(table, rounded);
    point->flux[c] = point_table_flux(table, table->intensity);
  }
  free(rounded);
  return RESULT_OK;
}

/* The texel nearest to a quarter in some channel, off the poles. */
static void choose_check(const struct point *point, struct include_check *check) {
  const struct picture *picture = &point->picture;
  double best = INFINITY;
  int height = picture->height, width = picture->width, least = height > 8 ? height / 8 : 1;
  for (int j = least; j < height - least; ++j)
    for (int i = 0; i < width; ++i) {
      const float *rgb = picture->rgb + 3 * ((size_t)(height - 1 - j) * (size_t)width + (size_t)i);
      for (int c = 0; c < 3; ++c) {
        double miss = fabs((double)rgb[c] - 0.25);
        if (miss >= best) continue;
        best = miss;
        *check = (struct include_check){.rgb = {(double)rgb[0], (double)rgb[1], (double)rgb[2]},
                                        .channel = c};
        texel_direction(point, i, j, check->at);
      }
    }
}

/* The image along a unit vector in its own axes, as POV-Ray interpolates it. */
static void look_up(const struct point *point, const double direction[3], double rgb[3]) {
  const struct picture *picture = &point->picture;
  double longitude = atan2(direction[2], direction[0]), latitude = asin(direction[1]);
  if (longitude < 0) longitude += 2 * M_PI;
  double x = (longitude - point->first[0]) / point->step[0];
  double y = picture->height - 1 - (latitude - point->first[1]) / point->step[1];
  int column = (int)floor(x), row = (int)floor(y);
  for (int k = 0; k < 4; ++k) {
    int i = (column + (k & 1) + picture->width) % picture->width, j = row + (k >> 1);
    if (j < 0 || j >= picture->height) continue;
    double weight = (k & 1 ? x - column : 1 - x + column) * (k >> 1 ? y - row : 1 - y + row);
    const float *texel = picture->rgb + 3 * ((size_t)j * (size_t)picture->width + (size_t)i);
    for (int c = 0; c < 3; ++c) rgb[c] += weight * (double)texel[c] * point->intensity[c];
  }
}

/* Irradiance of the far field on a receiver before a page: of the image, or of the page's own
 * light. */
static void far_irradiance(const void *of, int number, const double at[3], double rgb[3]) {
  (void)number;
  const struct far_page *far = of;
  double along[3], direction[3], seen[3];
  for (int c = 0; c < 3; ++c) along[c] = at[c] + far->shift[c];
  double r2 = dot(along, along), r = sqrt(r2);
  for (int c = 0; c < 3; ++c)
    direction[c] =
        (along[0] * far->u[c] + along[1] * far->v[c] + along[2] * far->slab->normal[c]) / r;
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (far->image) {
    for (int k = 0; k < 3; ++k) seen[k] = dot(direction, far->image->axes[k]);
    look_up(far->image, seen, rgb);
  } else {
    add_intensity(far, direction, rgb);
  }
  for (int c = 0; c < 3; ++c) rgb[c] *= along[2] / r / r2;
}

/* Makes `*worst` at least the error before a page, at a distance in aperture widths. */
static void measure_at(const struct far_page *far, double distance, double *worst) {
  double error, away = distance * plane_width(far->slab);
  plane_errors(far->slab, away, margin, far_irradiance, far, 1, &error);
  *worst = fmax(*worst, error);
}

/* The same past an edge, which hides the light or does not. */
static void shadowed_irradiance(const void *of, int number,
                                const struct plane_shadow_receiver *receiver, double rgb[3]) {
  const struct far_page *far = of;
  const double light[3] = {-far->shift[0], -far->shift[1], -far->shift[2]};
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!plane_shadow_hides(receiver, light)) far_irradiance(of, number, receiver->at, rgb);
}

static enum result measure_shadow(const struct far_page *far, struct point *point,
                                  struct error *error) {
  struct plane_shadow shadow;
  double away = point->distance * plane_width(far->slab);
  enum result result = plane_shadow_make(far->slab, away, &shadow, error);
  if (result == RESULT_OK)
    point->shadow_at =
        fmax(point->shadow_at, plane_shadow_error(&shadow, shadowed_irradiance, far, 0));
  plane_shadow_free(&shadow);
  return result;
}

static enum result measure(const struct far_lamp *lamp, struct progress *progress,
                           struct point *point, struct error *error) {
  for (int p = 0; p < lamp->count; ++p) {
    struct far_page *far = &lamp->pages[p];
    double from[3];
    if (progress) progress_show(progress, (double)p / lamp->count, "measuring the far field");
    for (int c = 0; c < 3; ++c) from[c] = far->slab->center[c] - point->center[c];
    far->shift[0] = dot(from, far->u);
    far->shift[1] = dot(from, far->v);
    far->shift[2] = dot(from, far->slab->normal);
    far->image = lamp->count == 1 ? point : NULL;
    for (int d = 0; d < POINT_DISTANCES; ++d) measure_at(far, distances[d], &point->error[d]);
    measure_at(far, point->distance, &point->error_at);
    enum result result = measure_shadow(far, point, error);
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}

/* The pages with light, where the lamp's centre is, and its flux. */
static enum result gather(const struct slab *const *lit, int count, struct far_lamp *lamp,
                          struct point *point, struct error *error) {
  double total = 0;
  lamp->pages = calloc((size_t)count, sizeof *lamp->pages);
  if (!lamp->pages) return result_no_memory(error);
  for (int p = 0; p < count; ++p) {
    double flux[3];
    enum result result = make_far_page(lit[p], &lamp->pages[lamp->count++], error);
    if (result == RESULT_OK) result = slab_flux(lit[p], flux, error);
    if (result != RESULT_OK) return result;
    double weight = flux[0] + flux[1] + flux[2];
    for (int c = 0; c < 3; ++c) {
      point->center[c] += weight * lit[p]->center[c];
      point->flux[c] += flux[c];
    }
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

/* `flux` is that of the image. */
static enum result finish(struct point *point, const double flux[3], struct error *error) {
  const struct picture *picture = &point->picture;
  double fade = 1e-3 * point->width;
  for (int c = 0; c < 3; ++c) {
    if (point->flux[c] > 0 && !(flux[c] > 0))
      return result_fail(error, RESULT_BAD,
                         "its window is too narrow for a lat-long image of %d x %d texels; use "
                         "--mode sheet",
                         picture->width, picture->height);
    point->intensity[c] = flux[c] > 0 ? point->flux[c] / flux[c] : 0;
    enum result result =
        include_check_colour(point->intensity[c] / (2 * M_PI * fade * fade), -1, error);
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

/* Stands where the table was measured, and has its axes. */
static enum result take_table(const struct point_table *table, struct point *point, double flux[3],
                              struct error *error) {
  memset(point->center, 0, sizeof point->center);
  memcpy(point->axes, table->axes, sizeof point->axes);
  point->table = table;
  return paint_table(table, point, flux, error);
}

enum result point_make(const struct slab *slabs, int count, const struct point_table *table,
                       double distance, struct progress *progress, struct point *point,
                       struct error *error) {
  struct far_lamp lamp = {0};
  const struct slab **lit = NULL;
  int lit_count = 0;
  double flux[3] = {0, 0, 0};
  memset(point, 0, sizeof *point);
  point->distance = distance;
  enum result result = include_lit_pages(slabs, count, &point->lamp, &lit, &lit_count, error);
  if (result == RESULT_OK) result = gather(lit, lit_count, &lamp, point, error);
  if (result == RESULT_OK)
    result = table ? take_table(table, point, flux, error) : paint(&lamp, point, flux, error);
  if (result == RESULT_OK) result = finish(point, flux, error);
  if (result == RESULT_OK) result = measure(&lamp, progress, point, error);
  for (int p = 0; p < lamp.count; ++p) slab_free(&lamp.pages[p].views);
  free(lamp.pages);
  free(lit);
  return result;
}

void point_free(struct point *point) {
  picture_free(&point->picture);
  memset(point, 0, sizeof *point);
}
