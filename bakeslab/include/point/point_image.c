/* point_image.c - the far fields of a lamp's channels as one image.
 *
 * 1. The intensity of each channel with light is found at nodes over the sphere: that of its pages,
 *    or of the table.
 * 2. Each colour is multiplied by what makes the flux of what is bilinear between the nodes that of
 *    the pages.
 * 3. It is painted over its peak, rounded as the file will be.
 * 4. What the image holds as 1 gets the intensity that makes its flux the channel's. */
#include "include/point/point.h"

#include <math.h>
#include <stdlib.h>

#include "file/slab_half.h"

/* Steps around the sphere. The image is fine, since a window may end sharply; where it does, at
 * slopes of 1 often, the end lies midway between nodes, so that no node is on it. */
enum { LEAST_WIDTH = 1028, MOST_WIDTH = 2052 };

/* Of node (i, j), the unit vector in the image's own axes. */
static void node_direction(const struct point *point, int i, int j, double direction[3]) {
  double longitude = 2 * M_PI * i / (point->columns - 1);
  double latitude = M_PI * j / (point->rows - 1) - M_PI / 2;
  direction[0] = cos(latitude) * cos(longitude);
  direction[1] = sin(latitude);
  direction[2] = cos(latitude) * sin(longitude);
}

/* Wide enough for two columns in the narrowest sample, at the window's corner. */
static int image_width(const struct point_far *pages, int count) {
  double least = INFINITY;
  for (int p = 0; p < count; ++p)
    for (int k = 0; k < 2; ++k) {
      const struct slab *views = &pages[p].views;
      const double *w = views->st_window + 2 * k;
      double steepest = fmax(fabs(w[0]), fabs(w[1]));
      least = fmin(least, slab_spacing(views, SLAB_S + k) / (1 + steepest * steepest));
    }
  return LEAST_WIDTH * least < 4 * M_PI ? MOST_WIDTH : LEAST_WIDTH;
}

/* The integral over all directions of what is bilinear between values at the nodes, one of each
 * `stride`. A node's share falls linearly to 0 at its neighbours in the row, and at the rows h
 * above and below; the integral of the latter times the cosine of latitude is 2 cos(latitude) (1 -
 * cos h)/h, and 1 - sin(h)/h at the poles. */
static double nodes_flux(const struct point *point, const double *values, int stride) {
  double h = M_PI / (point->rows - 1), width = 2 * M_PI / (point->columns - 1), flux = 0;
  for (int j = 0; j < point->rows; ++j) {
    double latitude = j * h - M_PI / 2, sum = 0;
    bool pole = j == 0 || j == point->rows - 1;
    double weight = pole ? 1 - sin(h) / h : 2 * cos(latitude) * (1 - cos(h)) / h;
    for (int i = 0; i < point->columns; ++i, values += stride)
      sum += (i == 0 || i == point->columns - 1 ? 0.5 : 1) * *values;
    flux += weight * width * sum;
  }
  return flux;
}

static void sum_pages(const struct point_far *pages, int count, int channel,
                      const struct point *point, double *image) {
  for (int j = 0; j < point->rows; ++j)
    for (int i = 0; i < point->columns; ++i, image += 3) {
      double along[3], direction[3];
      node_direction(point, i, j, along);
      for (int c = 0; c < 3; ++c)
        direction[c] = along[0] * point->axes[0][c] + along[1] * point->axes[1][c] +
                       along[2] * point->axes[2][c];
      for (int c = 0; c < 3; ++c) image[c] = 0;
      for (int p = 0; p < count; ++p)
        if (include_channel(&point->lamp, pages[p].slab) == channel)
          point_far_add(&pages[p], direction, image);
    }
}

/* Steps 2 to 4 of the far field of this number. */
static enum result paint(double *image, const double wanted[3], int number, struct point *point,
                         struct error *error) {
  size_t nodes = (size_t)point->columns * (size_t)point->rows;
  double factor[3], peak = 0, flux = 0, rounded = 0;
  for (int c = 0; c < 3; ++c) {
    double found = nodes_flux(point, image + c, 3);
    if (wanted[c] > 0 && !(found > 0))
      return result_fail(error, RESULT_BAD,
                         "its window is too narrow for a lat-long image of %d x %d texels; use "
                         "--mode sheet",
                         point->columns, point->rows);
    factor[c] = found > 0 ? wanted[c] / found : 0;
    flux += wanted[c];
    point->flux[c] += wanted[c];
  }
  for (size_t k = 0; k < 3 * nodes; ++k) peak = fmax(peak, image[k] *= factor[k % 3]);
  for (size_t k = 0; k < nodes; ++k) {
    /* Rows of pictures run downwards, and the first far field lies lowest. */
    size_t row =
        (size_t)(point->count - number) * (size_t)point->rows - 1 - k / (size_t)point->columns;
    size_t texel = row * (size_t)point->columns + k % (size_t)point->columns;
    for (size_t c = 0; c < 3; ++c) {
      image[3 * k + c] =
          (double)imath_half_to_float(imath_float_to_half((float)(image[3 * k + c] / peak)));
      point->picture.rgb[3 * texel + c] = (float)image[3 * k + c];
    }
  }
  for (int c = 0; c < 3; ++c) rounded += nodes_flux(point, image + c, 3);
  point->intensity[number] = flux / rounded;
  return RESULT_OK;
}

/* Finds the channels with light, in the order of their pages. */
static void list_channels(const struct point_far *pages, int count, struct point *point) {
  for (int p = 0; p < count; ++p) {
    int channel = include_channel(&point->lamp, pages[p].slab), n = 0;
    while (n < point->count && point->channels[n] != channel) ++n;
    if (n == point->count) point->channels[point->count++] = channel;
  }
}

static enum result paint_all(const struct point_far *pages, int count, double *image,
                             struct point *point, struct error *error) {
  enum result result = RESULT_OK;
  for (int n = 0; n < point->count && result == RESULT_OK; ++n) {
    double wanted[3] = {0, 0, 0};
    for (int p = 0; p < count; ++p)
      for (int c = 0; c < 3 && include_channel(&point->lamp, pages[p].slab) == point->channels[n];
           ++c)
        wanted[c] += pages[p].flux[c];
    sum_pages(pages, count, point->channels[n], point, image);
    result = paint(image, wanted, n, point, error);
  }
  return result;
}

static enum result paint_table(double *image, struct point *point, struct error *error) {
  const double *intensity = point->table->intensity;
  size_t nodes = (size_t)point->columns * (size_t)point->rows;
  double flux = nodes_flux(point, intensity, 1);
  for (size_t k = 0; k < 3 * nodes; ++k) image[k] = intensity[k / 3];
  return paint(image, (const double[]){flux, flux, flux}, 0, point, error);
}

enum result point_paint(const struct point_far *pages, int count, struct point *point,
                        struct error *error) {
  const struct point_table *table = point->table;
  struct picture *picture = &point->picture;
  int width = table ? 0 : image_width(pages, count);
  list_channels(pages, count, point);
  point->columns = table ? table->columns : width + 1;
  point->rows = table ? table->rows : width / 2 + 1;
  size_t values = 3 * (size_t)point->columns * (size_t)point->rows;
  double *image = calloc(values, sizeof *image);
  picture->rgb = calloc((size_t)point->count * values, sizeof *picture->rgb);
  picture->width = point->columns;
  picture->height = point->count * point->rows;
  enum result result = !image || !picture->rgb ? result_no_memory(error)
                       : table                 ? paint_table(image, point, error)
                                               : paint_all(pages, count, image, point, error);
  free(image);
  return result;
}

void point_look_up(const struct point *point, const double direction[3], double rgb[3]) {
  const struct picture *picture = &point->picture;
  double longitude = atan2(direction[2], direction[0]);
  double latitude = asin(fmax(-1, fmin(1, direction[1])));
  double x = (longitude < 0 ? longitude + 2 * M_PI : longitude) * (point->columns - 1) / (2 * M_PI);
  double y = (latitude + M_PI / 2) * (point->rows - 1) / M_PI;
  int column = (int)fmin(floor(x), point->columns - 2), row = (int)fmin(floor(y), point->rows - 2);
  for (int k = 0; k < 4; ++k) {
    int i = column + (k & 1), j = picture->height - 1 - (row + (k >> 1));
    double weight = (k & 1 ? x - column : 1 - x + column) * (k >> 1 ? y - row : 1 - y + row);
    const float *texel = picture->rgb + 3 * ((size_t)j * (size_t)picture->width + (size_t)i);
    for (int c = 0; c < 3; ++c) rgb[c] += weight * (double)texel[c] * point->intensity[0];
  }
}
