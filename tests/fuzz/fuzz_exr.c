/* fuzz_exr.c - the EXR reader: all headers, then blocks of each part; and as one picture. */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "file/slab_exr.h"
#include "file/slab_raster.h"
#include "fuzz.h"

enum { MOST_PIXELS = 1 << 20 }; /* of the blocks that are decoded */

static void read_parts(int fd) {
  struct slab_exr *exr = NULL;
  struct error error;
  if (slab_exr_open(fd, "fuzz", "lightslab", &exr, &error) != RESULT_OK) return;
  for (int part = 0; part < slab_exr_parts(exr); ++part) {
    const struct slab_raster *raster = slab_exr_part(exr, part);
    size_t pixels = slab_raster_block_pixels(raster), left = MOST_PIXELS;
    fuzz_check(raster->width > 0 && raster->height > 0 && pixels > 0);
    float *rgb = pixels <= left ? calloc(pixels, 3 * sizeof *rgb) : NULL;
    for (int row = 0; rgb && row < slab_raster_rows(raster) && left >= pixels; ++row)
      for (int column = 0; column < slab_raster_columns(raster) && left >= pixels; ++column) {
        left -= pixels;
        if (slab_exr_read_block(exr, part, column, row, rgb, &error) != RESULT_OK) left = 0;
      }
    free(rgb);
  }
  slab_exr_close(exr);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  int fd = fuzz_file(data, size);
  char path[64];
  struct picture picture;
  struct error error;
  snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
  if (slab_exr_read(path, &picture, &error) == RESULT_OK)
    fuzz_check(picture.width > 0 && picture.height > 0 && picture.rgb);
  picture_free(&picture);
  read_parts(fd);
  return 0;
}
