/* slab_exr_write.c - writes OpenEXR files, ZIP compressed, in tiles or scan
 * lines, half or float. */
#include <errno.h>
#include <openexr.h>
#include <stdio.h>
#include <string.h>

#include "base/output.h"
#include "file/slab_exr.h"
#include "file/slab_half.h"
#include "file/slab_raster.h"

struct writer {
  exr_context_t context;
  struct output *output;
  const struct slab_raster *parts;
  char why[256]; /* of a write that failed */
};

/* The library holds its lock while it calls this: to ask it for our data would be a deadlock. */
static void ignore(exr_const_context_t context, exr_result_t code, const char *message) {
  (void)context, (void)code, (void)message;
}

static int64_t write_bytes(exr_const_context_t context, void *data, const void *buffer,
                           uint64_t size, uint64_t offset, exr_stream_error_func_ptr_t complain) {
  (void)context, (void)complain;
  struct writer *writer = data;
  if (output_write(writer->output, buffer, size, offset) == 0) return (int64_t)size;
  snprintf(writer->why, sizeof writer->why, "%s", strerror(errno));
  return -1;
}

static exr_result_t define_part(struct writer *writer, int index, const char *text_name) {
  const struct slab_raster *raster = &writer->parts[index];
  bool tiled = raster->block_width > 0;
  exr_pixel_type_t type =
      raster->precision == SLAB_PRECISION_HALF ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
  char name[32];
  int part;
  if (raster->layer)
    snprintf(name, sizeof name, "%s", raster->layer);
  else
    snprintf(name, sizeof name, "page%d", index + 1);
  exr_result_t code =
      exr_add_part(writer->context, name, tiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, &part);
  if (code == EXR_ERR_SUCCESS)
    code = exr_initialize_required_attr_simple(writer->context, part, raster->width, raster->height,
                                               EXR_COMPRESSION_ZIP);
  if (code == EXR_ERR_SUCCESS && tiled)
    code = exr_set_tile_descriptor(writer->context, part, (uint32_t)raster->block_width,
                                   (uint32_t)raster->block_height, EXR_TILE_ONE_LEVEL,
                                   EXR_TILE_ROUND_DOWN);
  for (const char *colour = "BGR"; *colour && code == EXR_ERR_SUCCESS; ++colour) {
    char channel[64];
    snprintf(channel, sizeof channel, "%s%s%c", raster->layer ? raster->layer : "",
             raster->layer ? "." : "", *colour);
    code =
        exr_add_channel(writer->context, part, channel, type, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
  }
  if (code == EXR_ERR_SUCCESS && raster->text)
    code = exr_attr_set_string(writer->context, part, text_name, raster->text);
  if (code == EXR_ERR_SUCCESS && raster->about)
    code = exr_attr_set_string(writer->context, part, "error", raster->about);
  return code;
}

typedef exr_result_t (*write_step)(exr_encode_pipeline_t *);

/* OpenEXRCore 3.1 keeps a compressed chunk that is exactly as long as its raw
 * pixels; readers take that length for uncompressed, and get garbage. */
static exr_result_t write_shorter(exr_encode_pipeline_t *pipeline) {
  if (pipeline->compressed_bytes == pipeline->packed_bytes &&
      pipeline->compressed_buffer != pipeline->packed_buffer)
    memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
  return (*(write_step *)pipeline->encoding_user_data)(pipeline);
}

/* Encodes the block at (x, y). */
static exr_result_t write_block(struct writer *writer, int part, const exr_chunk_info_t *chunk,
                                int x, int y) {
  const struct slab_raster *raster = &writer->parts[part];
  const float *from = raster->rgb + 3 * ((size_t)y * (size_t)raster->width + (size_t)x);
  exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
  exr_result_t code = exr_encoding_initialize(writer->context, part, chunk, &pipeline);
  for (int k = 0; code == EXR_ERR_SUCCESS && k < pipeline.channel_count; ++k) {
    exr_coding_channel_info_t *channel = &pipeline.channels[k];
    char colour = channel->channel_name[strlen(channel->channel_name) - 1];
    channel->encode_from_ptr = (const uint8_t *)(from + (colour == 'R'   ? 0
                                                         : colour == 'G' ? 1
                                                                         : 2));
    channel->user_bytes_per_element = sizeof(float);
    channel->user_data_type = EXR_PIXEL_FLOAT;
    channel->user_pixel_stride = 3 * sizeof(float);
    channel->user_line_stride = 3 * (int)sizeof(float) * raster->width;
  }
  if (code == EXR_ERR_SUCCESS)
    code = exr_encoding_choose_default_routines(writer->context, part, &pipeline);
  write_step write = pipeline.write_fn;
  pipeline.write_fn = write_shorter;
  pipeline.encoding_user_data = &write;
  if (code == EXR_ERR_SUCCESS) code = exr_encoding_run(writer->context, part, &pipeline);
  exr_encoding_destroy(writer->context, &pipeline);
  return code;
}

static exr_result_t write_part(struct writer *writer, int part) {
  const struct slab_raster *raster = &writer->parts[part];
  bool tiled = raster->block_width > 0;
  int32_t lines = 0;
  exr_result_t code = EXR_ERR_SUCCESS;
  if (!tiled) code = exr_get_scanlines_per_chunk(writer->context, part, &lines);
  int step_x = tiled ? raster->block_width : raster->width;
  int step_y = tiled ? raster->block_height : lines;
  for (int y = 0; y < raster->height && code == EXR_ERR_SUCCESS; y += step_y)
    for (int x = 0; x < raster->width && code == EXR_ERR_SUCCESS; x += step_x) {
      exr_chunk_info_t chunk = {0};
      code = tiled ? exr_write_tile_chunk_info(writer->context, part, x / step_x, y / step_y, 0, 0,
                                               &chunk)
                   : exr_write_scanline_chunk_info(writer->context, part, y, &chunk);
      if (code == EXR_ERR_SUCCESS) code = write_block(writer, part, &chunk, x, y);
    }
  return code;
}

enum result slab_exr_write_parts(struct output *output, const struct slab_raster *parts, int count,
                                 const char *text_name, struct error *error) {
  struct writer writer = {.output = output, .parts = parts};
  exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
  setup.error_handler_fn = ignore;
  setup.user_data = &writer;
  setup.write_fn = write_bytes;
  exr_result_t code =
      exr_start_write(&writer.context, output->target, EXR_WRITE_FILE_DIRECTLY, &setup);
  for (int part = 0; part < count && code == EXR_ERR_SUCCESS; ++part)
    code = define_part(&writer, part, text_name);
  if (code == EXR_ERR_SUCCESS) code = exr_write_header(writer.context);
  for (int part = 0; part < count && code == EXR_ERR_SUCCESS; ++part)
    code = write_part(&writer, part);
  if (writer.context) {
    exr_result_t finished = exr_finish(&writer.context);
    if (code == EXR_ERR_SUCCESS) code = finished;
  }
  if (code == EXR_ERR_SUCCESS) return RESULT_OK;
  return result_fail(error, code == EXR_ERR_OUT_OF_MEMORY ? RESULT_MEMORY : RESULT_IO,
                     "%s: cannot be written: %s", output->target,
                     *writer.why ? writer.why : exr_get_default_error_message(code));
}

static enum result check_half(const char *path, const struct picture *picture,
                              struct error *error) {
  size_t width = (size_t)picture->width, count = 3 * width * (size_t)picture->height;
  for (size_t n = 0; n < count; ++n)
    if (!slab_half_holds(picture->rgb[n]))
      return result_fail(error, RESULT_BAD,
                         "%s: pixel %zu,%zu is %g, half holds at most 65504: write float", path,
                         n / 3 % width, n / 3 / width, (double)picture->rgb[n]);
  return RESULT_OK;
}

enum result slab_exr_put(struct output *output, const struct picture *picture, int half,
                         const char *comment, struct error *error) {
  enum result result = half ? check_half(output->target, picture, error) : RESULT_OK;
  if (result != RESULT_OK) return result;
  struct slab_raster parts[2] = {{.width = picture->width,
                                  .height = picture->height,
                                  .precision = half ? SLAB_PRECISION_HALF : SLAB_PRECISION_FLOAT,
                                  .text = (char *)comment, /* which is only read */
                                  .about = picture->about,
                                  .rgb = picture->rgb}};
  parts[1] = parts[0];
  parts[1].layer = "error";
  parts[1].rgb = picture->error;
  return slab_exr_write_parts(output, parts, picture->error && !half ? 2 : 1, "comments", error);
}

enum result slab_exr_write(const char *path, const struct picture *picture, int half,
                           const char *comment, struct error *error) {
  struct output output = {0};
  enum result result = output_begin(&output, path, error);
  if (result == RESULT_OK) result = slab_exr_put(&output, picture, half, comment, error);
  if (result == RESULT_OK) result = output_commit(&output, error);
  output_abandon(&output);
  return result;
}
