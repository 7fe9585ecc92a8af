/* fuzz_tiff.c - the TIFF reader: all headers, then blocks of each page. */
#include <stdlib.h>

#include "file/slab_tiff.h"
#include "fuzz.h"

enum { MOST_PIXELS = 1 << 20 }; /* of the blocks that are decoded */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct slab_tiff *tiff = NULL;
  struct error error;
  if (slab_tiff_open(fuzz_file(data, size), "fuzz", &tiff, &error) != RESULT_OK) return 0;
  for (int page = 0; page < slab_tiff_pages(tiff); ++page) {
    const struct slab_raster *raster = slab_tiff_page(tiff, page);
    size_t pixels = slab_raster_block_pixels(raster), left = MOST_PIXELS;
    fuzz_check(raster->width > 0 && raster->height > 0 && pixels > 0);
    float *rgb = pixels <= left ? calloc(pixels, 3 * sizeof *rgb) : NULL;
    for (int row = 0; rgb && row < slab_raster_rows(raster) && left >= pixels; ++row)
      for (int column = 0; column < slab_raster_columns(raster) && left >= pixels; ++column) {
        left -= pixels;
        if (slab_tiff_read_block(tiff, page, column, row, rgb, &error) != RESULT_OK) left = 0;
      }
    free(rgb);
  }
  slab_tiff_close(tiff);
  return 0;
}
