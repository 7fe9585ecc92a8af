/* raw_files.h - writes pages with plain libtiff and OpenEXRCore calls, as
 * another program would, so that tests of the reader share no code with our
 * writer. */
#ifndef RAW_FILES_H
#define RAW_FILES_H

#include <stdbool.h>
#include <stdint.h>

struct raw_tiff {
  int width, height;
  const float *rgb; /* width * height * 3 */
  const char *text; /* ImageDescription, or NULL */
  int tile;         /* side of a tile, 0 for strips */
  int rows_per_strip;
  int compression;      /* libtiff's, 0 for none */
  bool separate;        /* planes */
  bool half;            /* values must be exact in half */
  bool big_endian, big; /* BigTIFF */
  bool append;          /* another page */
  int samples;          /* a pixel, 0 for 3 */
  bool integer;         /* 16 bit integers instead */
};

void raw_tiff_write(const char *path, const struct raw_tiff *page);

/* SGILOG32 in strips; xyz is written as it is. */
void raw_logluv_write(const char *path, int width, int height, const float *xyz, const char *text);

struct raw_exr {
  int width, height;
  const float *rgb;
  const char *text;
  const char *channels; /* in alphabetical order, "BGR" for NULL; others are 9 */
  int tile;             /* 0: scan lines */
  int compression;      /* OpenEXRCore's */
  bool half;
  int left, top; /* of the data window */
};

void raw_exr_write(const char *path, const struct raw_exr *parts, int count);

/* Half bits of a value that is a small multiple of 2^-6; no rounding. */
uint16_t raw_half(float value);

#endif
