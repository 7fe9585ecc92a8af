/* images.h - image files in memory, written byte by byte, so that they say of themselves what a
 * test wants. They are never freed. */
#ifndef IMAGES_H
#define IMAGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct image {
  unsigned char *bytes;
  size_t size;
};

void image_put(struct image *image, const void *bytes, size_t size);
void image_big(struct image *image, uint64_t number, int length); /* the first byte counts most */
void image_little(struct image *image, uint64_t number, int length);

/* PNG. Pixels are rows without filter bytes; chunks go before them. */
struct image image_png(int width, int height, int depth, int colour_type, const void *pixels);
void image_png_chunk(struct image *png, const char *type, const struct image *data);
/* The data of a chunk iCCP. */
struct image image_iccp(const struct image *profile);

/* TIFF of 8 bits a sample. A field's values are bytes, shorts or pairs of longs, by its type. */
struct image_field {
  int tag, type; /* 1, 3, 5 */
  const uint32_t *values;
  size_t count;
};
struct image image_tiff(int width, int height, int samples, int photometric, const void *pixels,
                        const struct image_field *fields, size_t count);

/* EXIF of one field: the orientation, as PNG holds it. */
struct image image_exif(int orientation);

/* JPEG: a file of oiiotool's with a segment after its first two bytes. */
struct image image_jpeg(const char *path, int marker, const struct image *segment);

/* An ICC profile, for RGB or, where columns are NULL, grey: the columns of its matrix, and one
 * curve for all channels, as the profile holds it. */
struct image image_profile(const double columns[3][3], const struct image *curve);
struct image image_curve_power(double exponent);
struct image image_curve_table(const uint16_t *table, size_t count);
struct image image_curve_srgb(void); /* parametric, type 3 */

#endif
