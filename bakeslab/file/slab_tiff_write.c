/* slab_tiff_write.c - writes pages as tiled LogLuv, float or half TIFF. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "file/slab_half.h"
#include "file/slab_tiff.h"
#include "slab/slab_logluv.h"

/* SGILOG32 holds luminance from 2^-64 to 2^64 and chromaticities u', v' up to
 * 255/410. What is dimmer becomes black. */
static const double brightest = 0x1p63;
static const double widest = 255.0 / 410.0;

/* The middle of the grid's cell that a chromaticity falls into. */
static double grid_middle(double chromaticity) {
  return (floor(410 * chromaticity) + 0.5) / 410;
}

void slab_tiff_choose_white(const float *rgb, size_t count, double white[3]) {
  double sum[3] = {0, 0, 0}, xyz[3];
  for (size_t k = 0; k < count; ++k) {
    const float *pixel = rgb + 3 * k;
    bool is_white = pixel[0] > 0 && pixel[0] == pixel[1] && pixel[1] == pixel[2];
    slab_logluv_from_rgb(pixel, xyz);
    for (int c = 0; c < 3; ++c) sum[c] = is_white ? xyz[c] : sum[c] + xyz[c];
    if (is_white) break;
  }
  for (int c = 0; c < 3; ++c) white[c] = 1;
  if (!(sum[0] > 0 && sum[1] > 0 && sum[2] > 0)) return;
  double all = sum[0] + 15 * sum[1] + 3 * sum[2];
  double u = grid_middle(4 * sum[0] / all), v = grid_middle(9 * sum[1] / all);
  white[0] = 9 * u / (4 * v) * sum[1] / sum[0];
  white[2] = (12 - 3 * u - 20 * v) / (4 * v) * sum[1] / sum[2];
}

bool slab_tiff_logluv_holds(const float rgb[3]) {
  if (rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0) return true;
  if (rgb[0] < 0 || rgb[1] < 0 || rgb[2] < 0) return false; /* readers make them 0 */
  double xyz[3];
  slab_logluv_from_rgb(rgb, xyz);
  double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
  return xyz[1] > 0 && xyz[1] < brightest && xyz[0] >= 0 && xyz[2] >= 0 &&
         4 * xyz[0] < widest * sum && 9 * xyz[1] < widest * sum;
}

struct writer {
  TIFF *tif;
  bool failed;
  char why[256];
};

static int remember(TIFF *tif, void *data, const char *module, const char *format,
                    va_list arguments) {
  (void)tif, (void)module;
  struct writer *writer = data;
  if (writer->failed) return 1; /* the first message names the cause */
  writer->failed = true;
  int why = errno; /* libtiff itself does not say that a disk is full */
  int used = vsnprintf(writer->why, sizeof writer->why, format, arguments);
  if (why && used >= 0 && (size_t)used < sizeof writer->why)
    snprintf(writer->why + used, sizeof writer->why - (size_t)used, ": %s", strerror(why));
  return 1;
}

static bool set_tags(TIFF *tif, const struct slab_raster *raster) {
  bool ok = TIFFSetField(tif, TIFFTAG_IMAGEWIDTH, raster->width) &&
            TIFFSetField(tif, TIFFTAG_IMAGELENGTH, raster->height) &&
            TIFFSetField(tif, TIFFTAG_TILEWIDTH, raster->block_width) &&
            TIFFSetField(tif, TIFFTAG_TILELENGTH, raster->block_height) &&
            TIFFSetField(tif, TIFFTAG_SAMPLESPERPIXEL, 3) &&
            TIFFSetField(tif, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) &&
            TIFFSetField(tif, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT) &&
            TIFFSetField(tif, TIFFTAG_SOFTWARE, "bakeslab");
  if (ok && raster->text) ok = TIFFSetField(tif, TIFFTAG_IMAGEDESCRIPTION, raster->text);
  if (!ok) return false;
  if (raster->precision == SLAB_PRECISION_LOGLUV)
    return TIFFSetField(tif, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_LOGLUV) &&
           TIFFSetField(tif, TIFFTAG_COMPRESSION, COMPRESSION_SGILOG) &&
           TIFFSetField(tif, TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT) &&
           TIFFSetField(tif, TIFFTAG_SGILOGENCODE, SGILOGENCODE_NODITHER);
  int bits = raster->precision == SLAB_PRECISION_HALF ? 16 : 32;
  return TIFFSetField(tif, TIFFTAG_BITSPERSAMPLE, bits) &&
         TIFFSetField(tif, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP) &&
         TIFFSetField(tif, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB) &&
         TIFFSetField(tif, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE) &&
         TIFFSetField(tif, TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT);
}

static void encode_pixel(const struct slab_raster *raster, const float *rgb, void *tile,
                         size_t pixel) {
  if (raster->precision == SLAB_PRECISION_HALF) {
    uint16_t *halves = tile;
    for (size_t c = 0; c < 3; ++c) halves[3 * pixel + c] = imath_float_to_half(rgb[c]);
    return;
  }
  float *floats = (float *)tile + 3 * pixel;
  memcpy(floats, rgb, 3 * sizeof *floats);
  if (raster->precision != SLAB_PRECISION_LOGLUV) return;
  double xyz[3];
  slab_logluv_from_rgb(rgb, xyz);
  for (int c = 0; c < 3; ++c) floats[c] = (float)(xyz[c] * raster->white[c]);
}

/* Fills a tile; beyond the border the last pixels repeat, which packs well. */
static void encode_tile(const struct slab_raster *raster, int x0, int y0, void *tile) {
  size_t pixel = 0;
  for (int y = y0; y < y0 + raster->block_height; ++y)
    for (int x = x0; x < x0 + raster->block_width; ++x, ++pixel) {
      size_t row = (size_t)(y < raster->height ? y : raster->height - 1);
      size_t column = (size_t)(x < raster->width ? x : raster->width - 1);
      encode_pixel(raster, raster->rgb + 3 * (row * (size_t)raster->width + column), tile, pixel);
    }
}

static bool write_page(TIFF *tif, const struct slab_raster *raster) {
  if (!set_tags(tif, raster)) return false;
  size_t element = raster->precision == SLAB_PRECISION_HALF ? sizeof(uint16_t) : sizeof(float);
  size_t bytes = 3 * element * slab_raster_block_pixels(raster);
  void *tile = malloc(bytes);
  if (!tile) return false;
  bool ok = true;
  uint32_t index = 0;
  for (int row = 0; ok && row < slab_raster_rows(raster); ++row)
    for (int column = 0; ok && column < slab_raster_columns(raster); ++column) {
      encode_tile(raster, column * raster->block_width, row * raster->block_height, tile);
      ok = TIFFWriteEncodedTile(tif, index++, tile, (tmsize_t)bytes) >= 0;
    }
  free(tile);
  return ok && TIFFWriteDirectory(tif);
}

/* Upper bound of the file's size: compression may add a little. */
static bool may_pass_4gb(const struct slab_raster *pages, int count) {
  double bytes = 0;
  for (int page = 0; page < count; ++page) {
    double pixels = (double)slab_raster_block_pixels(&pages[page]) *
                    slab_raster_columns(&pages[page]) * slab_raster_rows(&pages[page]);
    double each = pages[page].precision == SLAB_PRECISION_LOGLUV ? 4
                  : pages[page].precision == SLAB_PRECISION_HALF ? 6
                                                                 : 12;
    bytes += 1.05 * pixels * each + 1e6;
  }
  return bytes > 0xffffffff;
}

enum result slab_tiff_write(struct output *output, const struct slab_raster *pages, int count,
                            struct error *error) {
  struct writer writer = {0};
  const char *mode = may_pass_4gb(pages, count) ? "w8" : "w";
  errno = 0;
  int fd = dup(output->fd); /* libtiff closes its own, the output syncs the other */
  if (fd >= 0) writer.tif = slab_tiff_start(fd, output->target, mode, remember, &writer);
  if (!writer.tif) {
    if (fd >= 0) close(fd);
    writer.failed = true;
  }
  for (int page = 0; page < count && !writer.failed; ++page)
    if (!write_page(writer.tif, &pages[page])) writer.failed = true;
  if (writer.tif) TIFFClose(writer.tif); /* may fail too, and then calls remember() */
  if (!writer.failed) return RESULT_OK;
  return result_fail(error, RESULT_IO, "%s: cannot be written: %s", output->target,
                     *writer.why ? writer.why : "out of memory");
}
