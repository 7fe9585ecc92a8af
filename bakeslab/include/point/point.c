/* point.c - the far field of a lamp. */
#include "include/point/point.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_half.h"
#include "include/text/include_light.h"
#include "slab/plane.h"
#include "slab/slab_resample.h"

const double point_distances[POINT_DISTANCES] = {1, 4, 16};

/* The image is fine, since a window may end sharply. */
enum { LEAST_WIDTH = 1024, MOST_WIDTH = 2048, MOST_VIEWS = 8 };

static const double largest_colour = 1e37, margin = 1.1;

/* Far away a page is its views' sum: one view where the st plane is at infinity, so
 * that all see the same slopes. */
struct far_page {
  struct slab views; /* owned */
  double u[3], v[3]; /* unit */
  double shift[3];   /* of its centre from the lamp's, along u, v and normal */
};

struct far_lamp {
  struct far_page *pages; /* owned */
  int count;
};

static double dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static enum result make_far_page(const struct slab *slab, struct far_page *far,
                                 struct error *error) {
  int most = slab_kappa(slab) > 0 ? MOST_VIEWS : 1, samples[SLAB_AXES];
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

/* Paints the intensity of each channel over its peak, rounded to half as the file will be;
 * `flux` is what the bilinear image then gives. */
static enum result paint(const struct far_lamp *lamp, struct point *point, double flux[3],
                         struct error *error) {
  struct picture *picture = &point->picture;
  int width = image_width(lamp), height = width / 2;
  double step = M_PI / height, peak[3] = {0, 0, 0},
         *image = calloc((size_t)width * (size_t)height * 3, sizeof *image);
  picture->rgb = calloc((size_t)width * (size_t)height * 3, sizeof *picture->rgb);
  if (!image || !picture->rgb) {
    free(image);
    return result_fail(error, RESULT_MEMORY, "out of memory for the image");
  }
  picture->width = width;
  picture->height = height;
  const struct far_page *first = &lamp->pages[0];
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      double latitude = (j + 0.5) * step - M_PI / 2, longitude = (i + 0.5) * step, direction[3];
      double *rgb = image + 3 * ((size_t)(height - 1 - j) * (size_t)width + (size_t)i);
      for (int c = 0; c < 3; ++c)
        direction[c] = cos(latitude) * cos(longitude) * first->u[c] + sin(latitude) * first->v[c] +
                       cos(latitude) * sin(longitude) * first->views.normal[c];
      for (int p = 0; p < lamp->count; ++p) add_intensity(&lamp->pages[p], direction, rgb);
      for (int c = 0; c < 3; ++c) peak[c] = fmax(peak[c], rgb[c]);
    }
  flux[0] = flux[1] = flux[2] = 0;
  for (size_t k = 0; k < (size_t)width * (size_t)height * 3; ++k) {
    if (!(peak[k % 3] > 0)) continue;
    double latitude = ((height - 0.5) - (double)(k / 3 / (size_t)width)) * step - M_PI / 2;
    picture->rgb[k] = slab_half_to_float(slab_half_from_float((float)(image[k] / peak[k % 3])));
    /* The integral of a texel's hat function over longitude and latitude. */
    flux[k % 3] += (double)picture->rgb[k] * step * cos(latitude) * 2 * (1 - cos(step)) / step;
  }
  free(image);
  return RESULT_OK;
}

/* The texel nearest to a quarter in some channel, off the poles. */
static void choose_check(struct point *point) {
  const struct picture *picture = &point->picture;
  double best = INFINITY;
  int height = picture->height, width = picture->width;
  for (int j = height / 8; j < height - height / 8; ++j)
    for (int i = 0; i < width; ++i) {
      const float *rgb = picture->rgb + 3 * ((size_t)(height - 1 - j) * (size_t)width + (size_t)i);
      for (int c = 0; c < 3; ++c) {
        double miss = fabs((double)rgb[c] - 0.25);
        if (miss >= best) continue;
        double latitude = (j + 0.5) * M_PI / height - M_PI / 2;
        double longitude = (i + 0.5) * 2 * M_PI / width;
        best = miss;
        point->check = (struct include_check){
            .at = {cos(latitude) * cos(longitude), sin(latitude), cos(latitude) * sin(longitude)},
            .rgb = {(double)rgb[0], (double)rgb[1], (double)rgb[2]},
            .channel = c};
      }
    }
}

/* The image along a unit vector in its own axes, as POV-Ray interpolates it. */
static void look_up(const struct point *point, const double direction[3], double rgb[3]) {
  const struct picture *picture = &point->picture;
  double longitude = atan2(direction[2], direction[0]) / (2 * M_PI);
  double x = (longitude < 0 ? longitude + 1 : longitude) * picture->width - 0.5;
  double y = (0.5 - asin(direction[1]) / M_PI) * picture->height - 0.5;
  int column = (int)floor(x), row = (int)floor(y);
  for (int k = 0; k < 4; ++k) {
    int i = (column + (k & 1) + picture->width) % picture->width, j = row + (k >> 1);
    if (j < 0 || j >= picture->height) continue;
    double weight = (k & 1 ? x - column : 1 - x + column) * (k >> 1 ? y - row : 1 - y + row);
    const float *texel = picture->rgb + 3 * ((size_t)j * (size_t)picture->width + (size_t)i);
    for (int c = 0; c < 3; ++c) rgb[c] += weight * (double)texel[c] * point->intensity[c];
  }
}

/* Irradiance of the far field on a receiver before a page: of the page's own light,
 * or, where it is the only one, of the image. */
static void far_irradiance(const struct point *point, const struct far_page *far, bool alone,
                           const double at[3], double rgb[3]) {
  double place[3], direction[3], r2 = 0;
  for (int c = 0; c < 3; ++c) {
    place[c] = at[c] + far->shift[c];
    r2 += place[c] * place[c];
  }
  double r = sqrt(r2);
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (alone) {
    for (int c = 0; c < 3; ++c) direction[c] = place[c] / r;
    look_up(point, direction, rgb);
  } else {
    for (int c = 0; c < 3; ++c)
      direction[c] =
          (place[0] * far->u[c] + place[1] * far->v[c] + place[2] * far->views.normal[c]) / r;
    add_intensity(far, direction, rgb);
  }
  for (int c = 0; c < 3; ++c) rgb[c] *= place[2] / r / r2;
}

/* Relative RMSE on a plane before a page, and around what the page lights there. */
static double far_error(const struct slab *slab, const struct point *point,
                        const struct far_page *far, bool alone, double distance) {
  double error = 0, size = 0;
  struct plane plane = plane_make(slab, distance * plane_width(slab), margin, 0);
  for (int row = 0; row < plane.receivers; ++row)
    for (int column = 0; column < plane.receivers; ++column) {
      double at[3] = {0, 0, plane.distance}, exact[3], sum[3];
      plane_receiver(&plane, column, row, at);
      plane_irradiance(slab, plane.points, at, plane.distance, exact);
      far_irradiance(point, far, alone, at, sum);
      for (int c = 0; c < 3; ++c) {
        size += exact[c] * exact[c];
        error += (sum[c] - exact[c]) * (sum[c] - exact[c]);
      }
    }
  return size > 0 ? sqrt(error / size) : 0;
}

static void measure(const struct slab *slabs, int count, const struct far_lamp *lamp,
                    struct point *point) {
  bool alone = lamp->count == 1;
  for (int k = 0, p = 0; k < count; ++k) {
    if (include_peak(&slabs[k]) <= 0) continue;
    struct far_page *far = &lamp->pages[p++];
    double from[3];
    for (int c = 0; c < 3; ++c) from[c] = slabs[k].center[c] - point->center[c];
    far->shift[0] = dot(from, far->u);
    far->shift[1] = dot(from, far->v);
    far->shift[2] = dot(from, slabs[k].normal);
    for (int d = 0; d < POINT_DISTANCES; ++d)
      point->error[d] =
          fmax(point->error[d], far_error(&slabs[k], point, far, alone, point_distances[d]));
    point->error_at =
        fmax(point->error_at, far_error(&slabs[k], point, far, alone, point->distance));
  }
}

/* The pages with light, where the lamp's centre is, and its flux. */
static enum result gather(const struct slab *slabs, int count, struct far_lamp *lamp,
                          struct point *point, struct error *error) {
  double total = 0;
  lamp->pages = calloc((size_t)count, sizeof *lamp->pages);
  if (!lamp->pages) return result_fail(error, RESULT_MEMORY, "out of memory");
  for (int k = 0; k < count; ++k) {
    double flux[3];
    enum result result = include_check_radiance(&slabs[k], k, error);
    if (result != RESULT_OK) return result;
    if (include_peak(&slabs[k]) <= 0) continue;
    if (lamp->count == 0) {
      point->frame = slabs[k];
      point->frame.rgb = NULL;
      point->frame.json = NULL;
    }
    result = make_far_page(&slabs[k], &lamp->pages[lamp->count++], error);
    if (result == RESULT_OK) result = slab_flux(&slabs[k], flux, error);
    if (result != RESULT_OK) return result;
    double weight = flux[0] + flux[1] + flux[2];
    for (int c = 0; c < 3; ++c) {
      point->center[c] += weight * slabs[k].center[c];
      point->flux[c] += flux[c];
    }
    total += weight;
    point->width = fmax(point->width, plane_width(&slabs[k]));
  }
  point->black_pages = count - lamp->count;
  if (!lamp->count) return include_no_light(error);
  for (int c = 0; c < 3; ++c) point->center[c] /= total;
  return RESULT_OK;
}

static enum result finish(struct point *point, const double flux[3], struct error *error) {
  for (int c = 0; c < 3; ++c) {
    if (point->flux[c] > 0 && !(flux[c] > 0))
      return result_fail(error, RESULT_BAD,
                         "its window is too narrow for a lat-long image of %d x %d texels; use "
                         "--mode sheet",
                         point->picture.width, point->picture.height);
    point->intensity[c] = flux[c] > 0 ? point->flux[c] / flux[c] : 0;
    double fade = 1e-3 * point->width;
    if (!(point->intensity[c] / (2 * M_PI * fade * fade) <= largest_colour))
      return result_fail(error, RESULT_BAD,
                         "it is brighter than POV-Ray's light colours hold (1e37); use a larger "
                         "radiance unit");
  }
  choose_check(point);
  const struct picture *picture = &point->picture;
  size_t bytes = (size_t)picture->width * (size_t)picture->height * 3 * sizeof *picture->rgb;
  point->stamp = include_hash(include_hash_start, picture->rgb, bytes);
  point->stamp = include_hash(point->stamp, point->center, sizeof point->center);
  point->stamp = include_hash(point->stamp, point->intensity, sizeof point->intensity);
  point->stamp = include_hash(point->stamp, point->frame.u, sizeof point->frame.u);
  point->stamp = include_hash(point->stamp, point->frame.v, sizeof point->frame.v);
  return RESULT_OK;
}

enum result point_make(const struct slab *slabs, int count, double distance, struct point *point,
                       struct error *error) {
  struct far_lamp lamp = {0};
  double flux[3] = {0, 0, 0};
  memset(point, 0, sizeof *point);
  point->distance = distance;
  enum result result = gather(slabs, count, &lamp, point, error);
  if (result == RESULT_OK) result = paint(&lamp, point, flux, error);
  if (result == RESULT_OK) result = finish(point, flux, error);
  if (result == RESULT_OK) measure(slabs, count, &lamp, point);
  for (int p = 0; p < lamp.count; ++p) slab_free(&lamp.pages[p].views);
  free(lamp.pages);
  return result;
}

void point_free(struct point *point) {
  picture_free(&point->picture);
  memset(point, 0, sizeof *point);
}
