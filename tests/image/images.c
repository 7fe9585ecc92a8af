/* images.c - see images.h; PNG 3rd edition, TIFF 6.0, ICC.1:2010, JFIF. */
#include "images.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "testing.h"

/* The bytes of all images: the leak sanitizer finds them here. */
static unsigned char *kept[1024];
static size_t images;

void image_put(struct image *image, const void *bytes, size_t size) {
  size_t place = image->bytes ? 0 : images++;
  while (place < images && kept[place] != image->bytes) ++place;
  assert_true(place < sizeof kept / sizeof *kept);
  kept[place] = image->bytes = realloc(image->bytes, image->size + size + 1);
  assert_non_null(image->bytes);
  if (size > 0) memcpy(image->bytes + image->size, bytes, size);
  image->size += size;
}

void image_big(struct image *image, uint64_t number, int length) {
  for (int k = length - 1; k >= 0; --k)
    image_put(image, &(unsigned char){(unsigned char)(number >> (8 * k))}, 1);
}

void image_little(struct image *image, uint64_t number, int length) {
  for (int k = 0; k < length; ++k)
    image_put(image, &(unsigned char){(unsigned char)(number >> (8 * k))}, 1);
}

static void put_text(struct image *image, const char *text) {
  image_put(image, text, strlen(text));
}

/* ---- PNG ---- */

static void put_chunk(struct image *png, const char *type, const struct image *data) {
  uint32_t crc = 0xffffffff;
  image_big(png, data->size, 4);
  size_t start = png->size;
  put_text(png, type);
  image_put(png, data->bytes, data->size);
  for (size_t k = start; k < png->size; ++k) {
    crc ^= png->bytes[k];
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
  }
  image_big(png, ~crc & 0xffffffff, 4);
}

/* zlib's format, uncompressed. */
static void put_zlib(struct image *image, const struct image *data) {
  uint32_t a = 1, b = 0;
  assert_true(data->size < 65536);
  image_put(image, "\x78\x01\x01", 3);
  image_little(image, data->size, 2);
  image_little(image, ~data->size & 0xffff, 2);
  image_put(image, data->bytes, data->size);
  for (size_t k = 0; k < data->size; ++k) {
    a = (a + data->bytes[k]) % 65521;
    b = (b + a) % 65521;
  }
  image_big(image, b << 16 | a, 4);
}

struct image image_png(int width, int height, int depth, int colour_type, const void *pixels) {
  static const int samples[] = {[0] = 1, [2] = 3, [3] = 1, [4] = 2, [6] = 4};
  struct image png = {0}, head = {0}, rows = {0}, data = {0};
  size_t row = (size_t)(width * depth * samples[colour_type] / 8);
  image_put(&png, "\x89PNG\r\n\x1a\n", 8);
  image_big(&head, (uint64_t)width, 4);
  image_big(&head, (uint64_t)height, 4);
  image_big(&head, (uint64_t)depth << 32 | (uint64_t)colour_type << 24, 5);
  put_chunk(&png, "IHDR", &head);
  for (int k = 0; k < height; ++k) {
    image_big(&rows, 0, 1);
    image_put(&rows, (const char *)pixels + (size_t)k * row, row);
  }
  put_zlib(&data, &rows);
  put_chunk(&png, "IDAT", &data);
  put_chunk(&png, "IEND", &(struct image){0});
  return png;
}

void image_png_chunk(struct image *png, const char *type, const struct image *data) {
  const size_t head = 8 + 25, before = strcmp(type, "tRNS") == 0 ? png->size : head;
  size_t at = head;
  /* transparency comes after the palette */
  for (; before > head && memcmp(png->bytes + at + 4, "IDAT", 4) != 0; ++at) continue;
  struct image made = {0};
  image_put(&made, png->bytes, at);
  put_chunk(&made, type, data);
  image_put(&made, png->bytes + at, png->size - at);
  *png = made;
}

struct image image_iccp(const struct image *profile) {
  struct image data = {0};
  image_put(&data, "any\0", 5);
  put_zlib(&data, profile);
  return data;
}

/* ---- TIFF, EXIF, JPEG ---- */

static void put_field(struct image *tiff, struct image *far, size_t far_at,
                      const struct image_field *field) {
  static const int lengths[] = {[1] = 1, [3] = 2, [4] = 4, [5] = 4};
  struct image values = {0};
  size_t numbers = field->count * (field->type == 5 ? 2 : 1);
  for (size_t k = 0; k < numbers; ++k)
    image_little(&values, field->values[k], lengths[field->type]);
  image_little(tiff, (uint64_t)field->tag, 2);
  image_little(tiff, (uint64_t)field->type, 2);
  image_little(tiff, field->count, 4);
  if (values.size <= 4) {
    image_put(tiff, values.bytes, values.size);
    image_little(tiff, 0, 4 - (int)values.size);
  } else {
    image_little(tiff, far_at + far->size, 4);
    image_put(far, values.bytes, values.size);
  }
}

struct image image_tiff(int width, int height, int samples, int photometric, const void *pixels,
                        const struct image_field *fields, size_t count) {
  uint32_t w = (uint32_t)width, h = (uint32_t)height, n = (uint32_t)samples, bytes = w * h * n;
  const struct image_field own[] = {
      {256, 3, &w, 1},
      {257, 3, &h, 1},
      {258, 3, (uint32_t[]){8, 8, 8, 8}, n},
      {259, 3, (uint32_t[]){1}, 1},
      {262, 3, (uint32_t[]){(uint32_t)photometric}, 1},
      {273, 4, (uint32_t[]){8}, 1},
      {277, 3, &n, 1},
      {278, 3, &h, 1},
      {279, 4, &bytes, 1},
  };
  size_t all = sizeof own / sizeof *own + count;
  size_t far_at = 8 + bytes + 2 + 12 * all + 4;
  struct image tiff = {0}, far = {0};
  image_put(&tiff, "II*", 4);
  image_little(&tiff, 8 + bytes, 4);
  image_put(&tiff, pixels, bytes);
  image_little(&tiff, all, 2);
  for (int tag = 0; tag < 65536; ++tag) {
    for (size_t k = 0; k < sizeof own / sizeof *own; ++k)
      if (own[k].tag == tag) put_field(&tiff, &far, far_at, &own[k]);
    for (size_t k = 0; k < count; ++k)
      if (fields[k].tag == tag) put_field(&tiff, &far, far_at, &fields[k]);
  }
  image_little(&tiff, 0, 4);
  image_put(&tiff, far.bytes, far.size);
  return tiff;
}

struct image image_exif(int orientation) {
  struct image exif = {0};
  image_put(&exif, "II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0", 18);
  image_little(&exif, (uint64_t)orientation, 8);
  return exif;
}

struct image image_jpeg(const char *path, int marker, const struct image *segment) {
  struct image jpeg = {0};
  unsigned char bytes[65536];
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  image_put(&jpeg, bytes, 2);
  image_big(&jpeg, (uint64_t)marker, 2);
  image_big(&jpeg, 2 + segment->size, 2);
  image_put(&jpeg, segment->bytes, segment->size);
  image_put(&jpeg, bytes + 2, size - 2);
  return jpeg;
}

/* ---- ICC ---- */

static void put_fixed(struct image *image, double number) {
  image_big(image, (uint64_t)(uint32_t)(int32_t)lround(number * 65536), 4);
}

struct image image_curve_power(double exponent) {
  struct image curve = {0};
  image_put(&curve, "curv\0\0\0\0\0\0\0\x01", 12);
  image_big(&curve, (uint64_t)lround(exponent * 256), 2);
  image_big(&curve, 0, 2);
  return curve;
}

struct image image_curve_table(const uint16_t *table, size_t count) {
  struct image curve = {0};
  image_put(&curve, "curv\0\0\0\0", 8);
  image_big(&curve, count, 4);
  for (size_t k = 0; k < count; ++k) image_big(&curve, table[k], 2);
  if (count % 2) image_big(&curve, 0, 2);
  return curve;
}

struct image image_curve_srgb(void) {
  static const double numbers[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  struct image curve = {0};
  image_put(&curve, "para\0\0\0\0\0\x03\0\0", 12);
  for (size_t k = 0; k < 5; ++k) put_fixed(&curve, numbers[k]);
  return curve;
}

struct image image_profile(const double columns[3][3], const struct image *curve) {
  static const char *const tags[] = {"rXYZ", "gXYZ", "bXYZ", "rTRC", "gTRC", "bTRC"};
  static const double white[3] = {0.9642, 1, 0.8249};
  struct image body = {0}, profile = {0}, table = {0};
  size_t count = columns ? 8 : 3, at = 128 + 4 + 12 * count;
  image_big(&table, count, 4);
  put_text(&table, "desc");
  image_big(&table, at << 32 | 0x60, 8);
  image_put(&body, "desc\0\0\0\0\0\0\0\x05test", 17);
  while (body.size < 0x60) image_big(&body, 0, 1);
  for (size_t k = 0; columns && k < 3; ++k) {
    put_text(&table, tags[k]);
    image_big(&table, (at + body.size) << 32 | 20, 8);
    image_put(&body, "XYZ \0\0\0\0", 8);
    for (size_t i = 0; i < 3; ++i) put_fixed(&body, columns[k][i]);
  }
  put_text(&table, "wtpt");
  image_big(&table, (at + body.size) << 32 | 20, 8);
  image_put(&body, "XYZ \0\0\0\0", 8);
  for (size_t i = 0; i < 3; ++i) put_fixed(&body, white[i]);
  for (size_t k = columns ? 3 : 5; k < 6; ++k) {
    put_text(&table, columns ? tags[k] : "kTRC");
    image_big(&table, (at + body.size) << 32 | curve->size, 8);
  }
  image_put(&body, curve->bytes, curve->size);
  image_big(&profile, 128 + table.size + body.size, 4);
  image_put(&profile, "\0\0\0\0\x02\x40\0\0", 8);
  put_text(&profile, columns ? "mntrRGB XYZ " : "mntrGRAYXYZ ");
  while (profile.size < 36) image_big(&profile, 0, 1);
  put_text(&profile, "acsp");
  while (profile.size < 68) image_big(&profile, 0, 1);
  for (size_t i = 0; i < 3; ++i) put_fixed(&profile, white[i]);
  while (profile.size < 128) image_big(&profile, 0, 1);
  image_put(&profile, table.bytes, table.size);
  image_put(&profile, body.bytes, body.size);
  free(table.bytes);
  free(body.bytes);
  return profile;
}
