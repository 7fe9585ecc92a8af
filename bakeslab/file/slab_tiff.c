/* slab_tiff.c - reads the TIFF pages that slabs are kept in. */
#include "file/slab_tiff.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file/slab_half.h"
#include "slab/slab_logluv.h"

struct page {
  struct slab_raster raster;
  bool tiled, separate;
  uint64_t offset; /* of its directory: to find it by number, libtiff reads all before it */
};

struct slab_tiff {
  TIFF *tif;
  const char *path; /* not owned */
  char why[256];    /* libtiff's latest message */
  struct page *pages;
  int count;
  int current;    /* libtiff's directory, or -1 */
  uint64_t bytes; /* of the file */
};

static int keep_message(TIFF *tif, void *data, const char *module, const char *format,
                        va_list arguments) {
  (void)tif, (void)module;
  struct slab_tiff *tiff = data;
  vsnprintf(tiff->why, sizeof tiff->why, format, arguments);
  return 1; /* handled: nothing goes to stderr */
}

static int ignore(TIFF *tif, void *data, const char *module, const char *format,
                  va_list arguments) {
  (void)tif, (void)data, (void)module, (void)format, (void)arguments;
  return 1;
}

static enum result refuse(const char *why, struct error *error) {
  return result_fail(error, RESULT_BAD, "%s", why);
}

static enum result damaged(const struct slab_tiff *tiff, struct error *error) {
  return result_fail(error, RESULT_BAD, "damaged or truncated: %s",
                     *tiff->why ? tiff->why : "cannot be decoded");
}

static bool lossless(uint16_t compression) {
  switch (compression) {
  case COMPRESSION_NONE:
  case COMPRESSION_LZW:
  case COMPRESSION_PACKBITS:
  case COMPRESSION_DEFLATE:
  case COMPRESSION_ADOBE_DEFLATE:
  case COMPRESSION_LZMA:
  case COMPRESSION_ZSTD:
    return true;
  default:
    return false;
  }
}

static enum result check_pixels(struct slab_tiff *tiff, int page, struct error *error) {
  struct page *p = &tiff->pages[page];
  uint16_t samples = 1, bits = 1, format = SAMPLEFORMAT_UINT, compression = COMPRESSION_NONE;
  uint16_t photometric = 0, planar = PLANARCONFIG_CONTIG, orientation = ORIENTATION_TOPLEFT;
  TIFFGetFieldDefaulted(tiff->tif, TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(tiff->tif, TIFFTAG_COMPRESSION, &compression);
  TIFFGetFieldDefaulted(tiff->tif, TIFFTAG_PLANARCONFIG, &planar);
  TIFFGetFieldDefaulted(tiff->tif, TIFFTAG_ORIENTATION, &orientation);
  TIFFGetField(tiff->tif, TIFFTAG_PHOTOMETRIC, &photometric);
  p->separate = planar == PLANARCONFIG_SEPARATE;
  if (samples != 3) return refuse("must have 3 samples a pixel", error);
  if (orientation != ORIENTATION_TOPLEFT) return refuse("must start at the top left", error);
  if (compression == COMPRESSION_SGILOG && photometric == PHOTOMETRIC_LOGLUV) {
    if (p->separate) return refuse("LogLuv must be in one plane", error);
    p->raster.precision = SLAB_PRECISION_LOGLUV;
    return RESULT_OK;
  }
  TIFFGetFieldDefaulted(tiff->tif, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff->tif, TIFFTAG_SAMPLEFORMAT, &format);
  if (photometric != PHOTOMETRIC_RGB || format != SAMPLEFORMAT_IEEEFP || (bits != 16 && bits != 32))
    return refuse("must be LogLuv (SGILOG32) or RGB of 16 or 32 bit IEEE float", error);
  if (!lossless(compression) || !TIFFIsCODECConfigured(compression))
    return result_fail(error, RESULT_BAD, "compression %d is not lossless or not known to libtiff",
                       compression);
  p->raster.precision = bits == 16 ? SLAB_PRECISION_HALF : SLAB_PRECISION_FLOAT;
  return RESULT_OK;
}

static enum result find_blocks(struct slab_tiff *tiff, int page, struct error *error) {
  struct page *p = &tiff->pages[page];
  uint32_t width = 0, height = 0, block_width = 0, block_height = UINT32_MAX;
  TIFFGetField(tiff->tif, TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff->tif, TIFFTAG_IMAGELENGTH, &height);
  if (width < 1 || height < 1 || width > INT_MAX / 16 || height > INT_MAX / 16)
    return refuse("has an impossible size", error);
  p->tiled = TIFFIsTiled(tiff->tif);
  if (p->tiled) {
    TIFFGetField(tiff->tif, TIFFTAG_TILEWIDTH, &block_width);
    TIFFGetField(tiff->tif, TIFFTAG_TILELENGTH, &block_height);
  } else {
    block_width = width;
    TIFFGetFieldDefaulted(tiff->tif, TIFFTAG_ROWSPERSTRIP, &block_height);
    if (block_height > height) block_height = height;
  }
  /* A small page in huge tiles would take more memory than its size suggests. */
  uint64_t most = (uint64_t)width * height > 1 << 24 ? (uint64_t)width * height : 1 << 24;
  if (block_width < 1 || block_height < 1 || (uint64_t)block_width * block_height > 2 * most)
    return refuse("has tiles of an impossible size", error);
  p->raster.width = (int)width;
  p->raster.height = (int)height;
  p->raster.block_width = (int)block_width;
  p->raster.block_height = (int)block_height;
  return RESULT_OK;
}

/* Every block must lie within the file before anyone allocates memory for all. */
static enum result check_extent(struct slab_tiff *tiff, int page, struct error *error) {
  const struct page *p = &tiff->pages[page];
  uint32_t blocks = p->tiled ? TIFFNumberOfTiles(tiff->tif) : TIFFNumberOfStrips(tiff->tif);
  for (uint32_t block = 0; block < blocks; ++block) {
    uint64_t offset = TIFFGetStrileOffset(tiff->tif, block);
    uint64_t bytes = TIFFGetStrileByteCount(tiff->tif, block);
    if (bytes == 0 || offset > tiff->bytes || bytes > tiff->bytes - offset)
      return refuse("is truncated: pixels lie beyond the end of the file", error);
  }
  return RESULT_OK;
}

static enum result read_page_header(struct slab_tiff *tiff, int page, struct error *error) {
  struct slab_raster *raster = &tiff->pages[page].raster;
  enum result result = check_pixels(tiff, page, error);
  if (result == RESULT_OK) result = find_blocks(tiff, page, error);
  if (result == RESULT_OK) result = check_extent(tiff, page, error);
  if (result != RESULT_OK) return result;
  const char *text = NULL;
  if (TIFFGetField(tiff->tif, TIFFTAG_IMAGEDESCRIPTION, &text) && text) {
    raster->text = strdup(text);
    if (!raster->text) return result_no_memory(error);
  }
  for (int c = 0; c < 3; ++c) raster->white[c] = 1;
  return RESULT_OK;
}

TIFF *slab_tiff_start(int fd, const char *name, const char *mode, TIFFErrorHandlerExtR remember,
                      void *data) {
  TIFFOpenOptions *options = TIFFOpenOptionsAlloc();
  if (!options) return NULL;
  TIFFOpenOptionsSetErrorHandlerExtR(options, remember, data);
  TIFFOpenOptionsSetWarningHandlerExtR(options, ignore, NULL);
  TIFF *tif = TIFFFdOpenExt(fd, name, mode, options);
  TIFFOpenOptionsFree(options);
  return tif;
}

enum result slab_tiff_open(int fd, const char *path, struct slab_tiff **out, struct error *error) {
  enum result result = RESULT_OK;
  struct stat status;
  *out = NULL;
  struct slab_tiff *tiff = calloc(1, sizeof *tiff);
  if (!tiff) {
    close(fd);
    return result_at(result_no_memory(error), error, "%s", path);
  }
  tiff->path = path;
  tiff->current = -1;
  if (fstat(fd, &status) == 0) tiff->bytes = (uint64_t)status.st_size;
  /* Not mapped: a file that shrinks while it is read must not kill us. */
  tiff->tif = slab_tiff_start(fd, path, "rm", keep_message, tiff);
  if (tiff->tif) tiff->count = (int)TIFFNumberOfDirectories(tiff->tif);
  if (!tiff->tif)
    result = result_fail(error, RESULT_BAD, "%s: not a readable TIFF file, or truncated: %s", path,
                         tiff->why);
  else if (!(tiff->pages = calloc((size_t)tiff->count, sizeof *tiff->pages)))
    result = result_at(result_no_memory(error), error, "%s", path);
  for (int page = 0; page < tiff->count && result == RESULT_OK; ++page) {
    *tiff->why = 0;
    bool there = page == 0 || TIFFReadDirectory(tiff->tif);
    result = there ? read_page_header(tiff, page, error) : damaged(tiff, error);
    result_at(result, error, "%s: page %d", path, page + 1);
    tiff->pages[page].offset = TIFFCurrentDirOffset(tiff->tif);
  }
  if (result == RESULT_OK) {
    *out = tiff;
  } else {
    if (!tiff->tif) close(fd);
    slab_tiff_close(tiff);
  }
  return result;
}

void slab_tiff_close(struct slab_tiff *tiff) {
  if (!tiff) return;
  for (int page = 0; tiff->pages && page < tiff->count; ++page) free(tiff->pages[page].raster.text);
  if (tiff->tif) TIFFClose(tiff->tif); /* closes the descriptor too */
  free(tiff->pages);
  free(tiff);
}

int slab_tiff_pages(const struct slab_tiff *tiff) {
  return tiff->count;
}

struct slab_raster *slab_tiff_page(struct slab_tiff *tiff, int page) {
  return &tiff->pages[page].raster;
}

static bool select_page(struct slab_tiff *tiff, int page) {
  if (tiff->current == page) return true;
  tiff->current = -1;
  if (!TIFFSetSubDirectory(tiff->tif, tiff->pages[page].offset)) return false;
  /* Forgotten at every change of directory. */
  if (tiff->pages[page].raster.precision == SLAB_PRECISION_LOGLUV &&
      !TIFFSetField(tiff->tif, TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT))
    return false;
  tiff->current = page;
  return true;
}

/* Decodes one plane of a block, as libtiff delivers it. */
static bool read_plane(struct slab_tiff *tiff, const struct page *p, int column, int row, int plane,
                       void *buffer, tmsize_t bytes) {
  uint32_t x = (uint32_t)(column * p->raster.block_width);
  uint32_t y = (uint32_t)(row * p->raster.block_height);
  if (p->tiled) {
    uint32_t tile = TIFFComputeTile(tiff->tif, x, y, 0, (uint16_t)plane);
    return TIFFReadEncodedTile(tiff->tif, tile, buffer, bytes) == bytes;
  }
  /* The last strip may be short. */
  uint32_t strip = TIFFComputeStrip(tiff->tif, y, (uint16_t)plane);
  int rows = p->raster.height - (int)y;
  if (rows < p->raster.block_height) bytes = bytes / p->raster.block_height * rows;
  return TIFFReadEncodedStrip(tiff->tif, strip, buffer, bytes) == bytes;
}

/* Spreads `count` decoded values into every step-th float of the block. */
static void convert(enum slab_precision precision, const void *raw, size_t count, int step,
                    float *rgb) {
  const uint16_t *halves = raw;
  const float *floats = raw;
  for (size_t k = 0; k < count; ++k)
    rgb[k * (size_t)step] =
        precision == SLAB_PRECISION_HALF ? imath_half_to_float(halves[k]) : floats[k];
}

/* No writer puts negative channels into LogLuv: where there is light, they come from zeros, by the
 * rounding of chromaticities. */
static void decode_xyz(const struct slab_raster *raster, float *pixels, size_t count) {
  for (size_t k = 0; k < count; ++k) {
    double xyz[3];
    float *rgb = pixels + 3 * k;
    for (size_t c = 0; c < 3; ++c) xyz[c] = (double)rgb[c] / raster->white[c];
    slab_logluv_to_rgb(xyz, rgb);
    for (size_t c = 0; c < 3 && xyz[1] > 0; ++c)
      if (rgb[c] < 0) rgb[c] = 0;
  }
}

static enum result read_block(struct slab_tiff *tiff, int page, int column, int row, float *rgb,
                              struct error *error) {
  const struct page *p = &tiff->pages[page];
  size_t pixels = slab_raster_block_pixels(&p->raster);
  size_t element = p->raster.precision == SLAB_PRECISION_HALF ? sizeof(uint16_t) : sizeof(float);
  int planes = p->separate ? 3 : 1; /* and the step between a plane's values in a block */
  size_t values = p->separate ? pixels : 3 * pixels;
  *tiff->why = 0;
  if (!select_page(tiff, page)) return damaged(tiff, error);
  void *raw = calloc(values, element);
  if (!raw) return result_no_memory(error);
  enum result result = RESULT_OK;
  for (int plane = 0; plane < planes && result == RESULT_OK; ++plane) {
    if (read_plane(tiff, p, column, row, plane, raw, (tmsize_t)(values * element)))
      convert(p->raster.precision, raw, values, planes, rgb + plane);
    else
      result = damaged(tiff, error);
  }
  free(raw);
  if (result == RESULT_OK && p->raster.precision == SLAB_PRECISION_LOGLUV)
    decode_xyz(&p->raster, rgb, pixels);
  return result;
}

enum result slab_tiff_read_block(struct slab_tiff *tiff, int page, int column, int row, float *rgb,
                                 struct error *error) {
  return result_at(read_block(tiff, page, column, row, rgb, error), error, "%s: page %d",
                   tiff->path, page + 1);
}
