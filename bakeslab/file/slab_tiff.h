/* slab_tiff.h - rasters in TIFF files, by libtiff: LogLuv (SGILOG32), float
 * and half, one directory a page. Pixels are interleaved float RGB (linear
 * Rec. 709). Page numbers start at 0 here and at 1 in messages. */
#ifndef SLAB_TIFF_H
#define SLAB_TIFF_H

#include <tiffio.h>

#include "base/output.h"
#include "file/slab_raster.h"

/* The `white` of a LogLuv page: factors on XYZ before encoding that move a colour onto the
 * grid to which SGILOG32 rounds chromaticities. Where any pixel is white, that is D65, which
 * so comes back white; else the mean of all, so that a lamp of one colour keeps it. */
void slab_tiff_choose_white(const float *rgb, size_t count, double white[3]);

struct slab_tiff; /* owned by whoever opened it */

/* Reads all directories. Takes over `fd`, also when it fails; `path`, for messages, must
 * stay. Reads strips or tiles, lossless compressions, both planar
 * configurations. */
enum result slab_tiff_open(int fd, const char *path, struct slab_tiff **tiff, struct error *error);
void slab_tiff_close(struct slab_tiff *tiff); /* NULL allowed */
int slab_tiff_pages(const struct slab_tiff *tiff);
/* Owned by the file. The caller sets `white` before it reads LogLuv blocks. */
struct slab_raster *slab_tiff_page(struct slab_tiff *tiff, int page);

/* Reads a block into slab_raster_block_pixels pixels. Negative channels of LogLuv pixels
 * with a positive luminance are rounding, and become 0. */
enum result slab_tiff_read_block(struct slab_tiff *tiff, int page, int column, int row, float *rgb,
                                 struct error *error);

/* libtiff on an open file, by its mode; NULL where that fails. `remember` gets its errors, and
 * `data`; warnings are ignored, so that nothing goes to stderr. */
TIFF *slab_tiff_start(int fd, const char *name, const char *mode, TIFFErrorHandlerExtR remember,
                      void *data);

/* Whether LogLuv can hold a pixel: black, or a colour without negative channels,
 * with a luminance within its range. */
bool slab_tiff_logluv_holds(const float rgb[3]);

/* Writes pages in tiles (multiples of 16), losslessly compressed, as BigTIFF
 * where they may pass 4 GB. `white` of a LogLuv page is applied. */
enum result slab_tiff_write(struct output *output, const struct slab_raster *pages, int count,
                            struct error *error);

#endif
