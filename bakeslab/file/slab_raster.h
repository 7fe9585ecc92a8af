/* slab_raster.h - what the containers know of a page: a picture in blocks, and
 * a text. What the picture means as a slab is slab_file.c's business. */
#ifndef SLAB_RASTER_H
#define SLAB_RASTER_H

#include <stdbool.h>
#include <stddef.h>

#include "file/slab_precision.h"

struct slab_raster {
  int width, height;
  int block_width, block_height; /* tiles or strips, as they are stored; 0 x 0
                                    asks an EXR writer for scan lines */
  enum slab_precision precision; /* never DEFAULT */
  double white[3];               /* LogLuv: factors on XYZ before encoding */
  char *text;                    /* the page's JSON, or NULL */
  const float *rgb;              /* width * height interleaved pixels, when writing */
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

#endif
