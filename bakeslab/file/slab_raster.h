/* slab_raster.h - a page as a container holds it: a picture in blocks, and a text. slab_file.c
 * makes a slab of it. */
#ifndef SLAB_RASTER_H
#define SLAB_RASTER_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "file/slab_precision.h"

struct slab_raster {
  int width, height;
  int block_width, block_height; /* tiles or strips, as they are stored; 0 x 0
                                    asks an EXR writer for scan lines */
  enum slab_precision precision; /* never DEFAULT */
  const char *lossy;             /* name of the compression, where it changed samples; or NULL */
  double white[3];               /* LogLuv: factors on XYZ before encoding */
  char *text;                    /* the page's JSON, or NULL */
  const float *rgb;              /* width * height interleaved pixels, when writing */
  const char *about;             /* EXR, when writing: string attribute "error"; NULL: none */
  const char *layer;             /* EXR, when writing: name of the part and of its channels, as in
                                    error.R; NULL: pageN, and R, G, B */
};

/* Pixels of a block, as read_block functions deliver it: rows of block_width
 * pixels, of which those inside the raster are set. */
static inline size_t slab_raster_block_pixels(const struct slab_raster *raster) {
  return (size_t)raster->block_width * (size_t)raster->block_height;
}

/* Whether a file of `bytes` can hold so many pixels: no compression has longer runs than
 * ZSTD, 128 KB in 4 bytes. Else a few bytes could ask for all the memory there is. */
static inline bool slab_raster_plausible(double pixels, double bytes) {
  return 3 * sizeof(float) * pixels <= (1 << 26) + 65536 * bytes;
}

static inline int slab_raster_columns(const struct slab_raster *raster) {
  if (raster->block_width < 1) return 1; /* scan lines */
  return raster->width / raster->block_width + (raster->width % raster->block_width != 0);
}

static inline int slab_raster_rows(const struct slab_raster *raster) {
  if (raster->block_height < 1) return raster->height;
  return raster->height / raster->block_height + (raster->height % raster->block_height != 0);
}

/* A rectangle of the raster, in pixels. */
struct slab_area {
  int x, y, width, height;
};

/* Copies what a block and an area share to the area's own pixels. */
static inline void slab_raster_copy(const struct slab_raster *raster, int column, int row,
                                    const float *block, const struct slab_area *area, float *rgb) {
  int x0 = column * raster->block_width, y0 = row * raster->block_height;
  int left = area->x > x0 ? area->x : x0, top = area->y > y0 ? area->y : y0;
  int right = area->x + area->width, bottom = area->y + area->height;
  if (right > x0 + raster->block_width) right = x0 + raster->block_width;
  if (bottom > y0 + raster->block_height) bottom = y0 + raster->block_height;
  for (int y = top; y < bottom; ++y)
    memcpy(rgb + 3 * ((size_t)(y - area->y) * (size_t)area->width + (size_t)(left - area->x)),
           block + 3 * ((size_t)(y - y0) * (size_t)raster->block_width + (size_t)(left - x0)),
           3 * sizeof(float) * (size_t)(right - left));
}

#endif
