/* raw_files.c - see raw_files.h. */
#include "helpers.h"

#include <math.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tiffio.h>

#include "raw_files.h"

uint16_t raw_half(float value) {
  if (value == 0) return 0;
  int sign = value < 0 ? 0x8000 : 0, exponent = 15;
  double size = fabs((double)value);
  while (size >= 2) size /= 2, ++exponent;
  while (size < 1) size *= 2, --exponent;
  double mantissa = (size - 1) * 1024;
  assert_true(mantissa == floor(mantissa) && exponent > 0 && exponent < 31);
  return (uint16_t)(sign | exponent << 10 | (int)mantissa);
}

/* Bytes of a block of the raster: all samples, or those of one plane. */
static size_t gather(const struct raw_tiff *page, int x0, int y0, int width, int height, int plane,
                     void *block) {
  int samples = page->samples ? page->samples : 3;
  size_t n = 0;
  for (int y = y0; y < y0 + height; ++y)
    for (int x = x0; x < x0 + width; ++x)
      for (int c = 0; c < samples; ++c) {
        if (plane >= 0 && c != plane) continue;
        bool inside = x < page->width && y < page->height && c < 3;
        float value = inside ? page->rgb[3 * (y * page->width + x) + c] : 0;
        if (page->half || page->integer)
          ((uint16_t *)block)[n++] = page->half ? raw_half(value) : (uint16_t)value;
        else
          ((float *)block)[n++] = value;
      }
  return n * (page->half || page->integer ? 2 : 4);
}

void raw_tiff_write(const char *path, const struct raw_tiff *page) {
  char mode[4] = {page->append ? 'a' : 'w', page->big_endian ? 'b' : 'l', page->big ? '8' : 0, 0};
  TIFF *tif = TIFFOpen(path, mode);
  assert_non_null(tif);
  int samples = page->samples ? page->samples : 3;
  TIFFSetField(tif, TIFFTAG_IMAGEWIDTH, page->width);
  TIFFSetField(tif, TIFFTAG_IMAGELENGTH, page->height);
  TIFFSetField(tif, TIFFTAG_SAMPLESPERPIXEL, samples);
  TIFFSetField(tif, TIFFTAG_BITSPERSAMPLE, page->half || page->integer ? 16 : 32);
  TIFFSetField(tif, TIFFTAG_SAMPLEFORMAT, page->integer ? SAMPLEFORMAT_UINT : SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tif, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(tif, TIFFTAG_PLANARCONFIG,
               page->separate ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
  TIFFSetField(tif, TIFFTAG_COMPRESSION, page->compression ? page->compression : COMPRESSION_NONE);
  if (page->text) TIFFSetField(tif, TIFFTAG_IMAGEDESCRIPTION, page->text);
  int rows = page->rows_per_strip ? page->rows_per_strip : page->height;
  int step_x = page->tile ? page->tile : page->width, step_y = page->tile ? page->tile : rows;
  if (page->tile) {
    TIFFSetField(tif, TIFFTAG_TILEWIDTH, page->tile);
    TIFFSetField(tif, TIFFTAG_TILELENGTH, page->tile);
  } else {
    TIFFSetField(tif, TIFFTAG_ROWSPERSTRIP, rows);
  }
  void *block = calloc((size_t)(step_x * step_y * samples), 4);
  uint32_t index = 0;
  for (int plane = 0; plane < (page->separate ? samples : 1); ++plane)
    for (int y = 0; y < page->height; y += step_y)
      for (int x = 0; x < page->width; x += step_x) {
        int height = !page->tile && y + step_y > page->height ? page->height - y : step_y;
        size_t bytes = gather(page, x, y, step_x, height, page->separate ? plane : -1, block);
        tmsize_t written = page->tile ? TIFFWriteEncodedTile(tif, index++, block, (tmsize_t)bytes)
                                      : TIFFWriteEncodedStrip(tif, index++, block, (tmsize_t)bytes);
        assert_true(written >= 0);
      }
  free(block);
  TIFFClose(tif);
}

void raw_logluv_write(const char *path, int width, int height, const float *xyz, const char *text) {
  TIFF *tif = TIFFOpen(path, "w");
  assert_non_null(tif);
  TIFFSetField(tif, TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(tif, TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(tif, TIFFTAG_SAMPLESPERPIXEL, 3);
  TIFFSetField(tif, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tif, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_LOGLUV);
  TIFFSetField(tif, TIFFTAG_COMPRESSION, COMPRESSION_SGILOG);
  TIFFSetField(tif, TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT);
  TIFFSetField(tif, TIFFTAG_ROWSPERSTRIP, 1);
  TIFFSetField(tif, TIFFTAG_IMAGEDESCRIPTION, text);
  for (int y = 0; y < height; ++y)
    assert_int_equal(
        TIFFWriteScanline(tif, (void *)(uintptr_t)(xyz + 3 * y * width), (uint32_t)y, 0), 1);
  TIFFClose(tif);
}

static exr_result_t (*write_chunk)(exr_encode_pipeline_t *);

/* OpenEXRCore 3.1 gets chunks wrong that compress to exactly their own size. */
static exr_result_t write_raw_if_equal(exr_encode_pipeline_t *pipeline) {
  if (pipeline->compressed_bytes == pipeline->packed_bytes &&
      pipeline->compressed_buffer != pipeline->packed_buffer)
    memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
  return write_chunk(pipeline);
}

static void encode(exr_context_t file, int part, const exr_chunk_info_t *chunk, int x, int y,
                   const struct raw_exr *page) {
  const char *channels = page->channels ? page->channels : "BGR";
  exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
  size_t pixels = (size_t)(chunk->width * chunk->height);
  int size = page->half ? 2 : 4;
  uint8_t *planes = calloc(pixels * strlen(channels), (size_t)size);
  assert_int_equal(exr_encoding_initialize(file, part, chunk, &pipeline), EXR_ERR_SUCCESS);
  for (int k = 0; k < pipeline.channel_count; ++k) {
    exr_coding_channel_info_t *channel = &pipeline.channels[k];
    char name = channel->channel_name[0];
    int c = name == 'R' ? 0 : name == 'G' ? 1 : 2;
    uint8_t *plane = planes + (size_t)k * pixels * (size_t)size;
    for (int dy = 0; dy < chunk->height; ++dy)
      for (int dx = 0; dx < chunk->width; ++dx) {
        float value =
            strchr("RGB", name) ? page->rgb[3 * ((y + dy) * page->width + x + dx) + c] : 9;
        uint16_t half = page->half ? raw_half(value) : 0;
        memcpy(plane + (dy * chunk->width + dx) * size, page->half ? (void *)&half : (void *)&value,
               (size_t)size);
      }
    channel->encode_from_ptr = plane;
    channel->user_bytes_per_element = (int16_t)size;
    channel->user_data_type = channel->data_type;
    channel->user_pixel_stride = size;
    channel->user_line_stride = size * chunk->width;
  }
  assert_int_equal(exr_encoding_choose_default_routines(file, part, &pipeline), EXR_ERR_SUCCESS);
  write_chunk = pipeline.write_fn;
  pipeline.write_fn = write_raw_if_equal;
  assert_int_equal(exr_encoding_run(file, part, &pipeline), EXR_ERR_SUCCESS);
  exr_encoding_destroy(file, &pipeline);
  free(planes);
}

static void define(exr_context_t file, const struct raw_exr *page, int number) {
  char name[16];
  int part;
  snprintf(name, sizeof name, "p%d", number);
  exr_attr_box2i_t window = {
      .min = {{{page->left, page->top}}},
      .max = {{{page->left + page->width - 1, page->top + page->height - 1}}}};
  exr_attr_v2f_t center = {{{0, 0}}};
  exr_add_part(file, name, page->tile ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, &part);
  exr_initialize_required_attr(file, part, &window, &window, 1, &center, 1,
                               EXR_LINEORDER_INCREASING_Y, (exr_compression_t)page->compression);
  if (page->tile)
    exr_set_tile_descriptor(file, part, (uint32_t)page->tile, (uint32_t)page->tile,
                            EXR_TILE_ONE_LEVEL, EXR_TILE_ROUND_DOWN);
  for (const char *channel = page->channels ? page->channels : "BGR"; *channel; ++channel) {
    const char one[2] = {*channel, 0};
    exr_add_channel(file, part, one, page->half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
                    EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
  }
  if (page->text) exr_attr_set_string(file, part, "lightslab", page->text);
}

void raw_exr_write(const char *path, const struct raw_exr *parts, int count) {
  exr_context_t file = NULL;
  exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
  assert_int_equal(exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &setup), EXR_ERR_SUCCESS);
  for (int part = 0; part < count; ++part) define(file, &parts[part], part);
  assert_int_equal(exr_write_header(file), EXR_ERR_SUCCESS);
  for (int part = 0; part < count; ++part) {
    const struct raw_exr *page = &parts[part];
    int32_t lines = 0;
    if (!page->tile) exr_get_scanlines_per_chunk(file, part, &lines);
    int step_x = page->tile ? page->tile : page->width, step_y = page->tile ? page->tile : lines;
    for (int y = 0; y < page->height; y += step_y)
      for (int x = 0; x < page->width; x += step_x) {
        exr_chunk_info_t chunk = {0};
        exr_result_t code =
            page->tile ? exr_write_tile_chunk_info(file, part, x / step_x, y / step_y, 0, 0, &chunk)
                       : exr_write_scanline_chunk_info(file, part, page->top + y, &chunk);
        assert_int_equal(code, EXR_ERR_SUCCESS);
        encode(file, part, &chunk, x, y, page);
      }
  }
  assert_int_equal(exr_finish(&file), EXR_ERR_SUCCESS);
}
