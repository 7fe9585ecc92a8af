/* slab_exr.c - reads OpenEXR files: scan lines or tiles, half or float, any
 * compression that OpenEXRCore 3.1 decodes: not DWA. A chunk is a block of the raster. */
#include "file/slab_exr.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file/slab_raster.h"

struct part {
  struct slab_raster raster;
  bool tiled;
  exr_attr_box2i_t window;
};

struct slab_exr {
  exr_context_t context;
  int fd;
  const char *path; /* not owned */
  char why[256];    /* the library's latest message */
  struct part *parts;
  int count;
};

static void remember(exr_const_context_t context, exr_result_t code, const char *message) {
  void *data = NULL;
  (void)code;
  if (exr_get_user_data(context, &data) != EXR_ERR_SUCCESS || !data) return;
  struct slab_exr *exr = data;
  /* The library puts the file's name in front, which our messages do too. */
  const char *text = strstr(message, "': ");
  snprintf(exr->why, sizeof exr->why, "%s", text ? text + 3 : message);
}

static int64_t read_bytes(exr_const_context_t context, void *data, void *buffer, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t complain) {
  struct slab_exr *exr = data;
  uint64_t done = 0;
  while (done < size) {
    ssize_t got = pread(exr->fd, (char *)buffer + done, size - done, (off_t)(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      complain(context, EXR_ERR_READ_IO, "%s", strerror(errno));
      return -1;
    }
    if (got == 0) break;
    done += (uint64_t)got;
  }
  return (int64_t)done;
}

static int64_t query_size(exr_const_context_t context, void *data) {
  (void)context;
  struct slab_exr *exr = data;
  struct stat status;
  return fstat(exr->fd, &status) == 0 ? (int64_t)status.st_size : -1;
}

/* What the library found wrong. */
static enum result fail(const struct slab_exr *exr, exr_result_t code, struct error *error) {
  enum result result = code == EXR_ERR_OUT_OF_MEMORY ? RESULT_MEMORY : RESULT_BAD;
  return result_fail(error, result, "%s: %s",
                     exr->parts ? "damaged or truncated" : "not a readable EXR file, or truncated",
                     *exr->why ? exr->why : exr_get_default_error_message(code));
}

static enum result check_channels(struct slab_exr *exr, int part, struct error *error) {
  const exr_attr_chlist_t *channels = NULL;
  exr_result_t code = exr_get_channels(exr->context, part, &channels);
  if (code != EXR_ERR_SUCCESS) return fail(exr, code, error);
  exr->parts[part].raster.precision = SLAB_PRECISION_HALF;
  for (const char *name = "RGB"; *name; ++name) {
    const exr_attr_chlist_entry_t *found = NULL;
    for (int k = 0; k < channels->num_channels; ++k) {
      const char *candidate = channels->entries[k].name.str;
      if (candidate[0] == *name && !candidate[1]) found = &channels->entries[k];
    }
    if (!found) return result_fail(error, RESULT_BAD, "has no channel %c", *name);
    if (found->x_sampling != 1 || found->y_sampling != 1 || found->pixel_type == EXR_PIXEL_UINT)
      return result_fail(error, RESULT_BAD, "channel %c is %s, must be half or float", *name,
                         found->pixel_type == EXR_PIXEL_UINT ? "integer" : "subsampled");
    if (found->pixel_type == EXR_PIXEL_FLOAT)
      exr->parts[part].raster.precision = SLAB_PRECISION_FLOAT;
  }
  return RESULT_OK;
}

/* After check_channels. PXR24 rounds floats only, B44 halves only. */
static enum result check_compression(struct slab_exr *exr, int part, struct error *error) {
  static const char *const names[EXR_COMPRESSION_LAST_TYPE] = {[EXR_COMPRESSION_PXR24] = "PXR24",
                                                               [EXR_COMPRESSION_B44] = "B44",
                                                               [EXR_COMPRESSION_B44A] = "B44A",
                                                               [EXR_COMPRESSION_DWAA] = "DWAA",
                                                               [EXR_COMPRESSION_DWAB] = "DWAB"};
  struct slab_raster *raster = &exr->parts[part].raster;
  exr_compression_t compression;
  const exr_attr_chlist_t *channels = NULL;
  exr_result_t code = exr_get_compression(exr->context, part, &compression);
  if (code == EXR_ERR_SUCCESS) code = exr_get_channels(exr->context, part, &channels);
  if (code != EXR_ERR_SUCCESS) return fail(exr, code, error);
  bool halves = true;
  for (int k = 0; k < channels->num_channels; ++k)
    halves = halves && channels->entries[k].pixel_type == EXR_PIXEL_HALF;
  bool dwa = compression == EXR_COMPRESSION_DWAA || compression == EXR_COMPRESSION_DWAB;
  bool b44 = compression == EXR_COMPRESSION_B44 || compression == EXR_COMPRESSION_B44A;
  /* OpenEXRCore 3.1 mixes up the floats of B44 */
  if (dwa || (b44 && !halves))
    return result_fail(error, RESULT_BAD,
                       "is compressed by %s, which is lossy%s and is not read; save it again with "
                       "ZIP, from the original",
                       names[compression], b44 ? ", with channels that are not half," : "");
  bool pxr24 = compression == EXR_COMPRESSION_PXR24;
  if (b44 || (pxr24 && raster->precision == SLAB_PRECISION_FLOAT))
    raster->lossy = names[compression];
  return RESULT_OK;
}

/* Of slabs, whose colours are Rec. 709's. */
static enum result check_colours(const struct slab_exr *exr, int part, struct error *error) {
  static const float wanted[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
  exr_attr_chromaticities_t found;
  if (exr_attr_get_chromaticities(exr->context, part, "chromaticities", &found) != EXR_ERR_SUCCESS)
    return RESULT_OK; /* there are none */
  const float xy[8] = {found.red_x,  found.red_y,  found.green_x, found.green_y,
                       found.blue_x, found.blue_y, found.white_x, found.white_y};
  for (int k = 0; k < 8; ++k)
    if (!(fabsf(xy[k] - wanted[k]) <= 0.002F))
      return result_fail(error, RESULT_BAD,
                         "has chromaticities other than Rec. 709's, which slabs have; convert its "
                         "colours first");
  return RESULT_OK;
}

static enum result find_blocks(struct slab_exr *exr, int part, struct error *error) {
  struct part *p = &exr->parts[part];
  exr_storage_t storage;
  exr_result_t code = exr_get_storage(exr->context, part, &storage);
  if (code != EXR_ERR_SUCCESS) return fail(exr, code, error);
  if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
    return result_fail(error, RESULT_BAD, "is a deep image");
  code = exr_get_data_window(exr->context, part, &p->window);
  if (code != EXR_ERR_SUCCESS) return fail(exr, code, error);
  int64_t width = (int64_t)p->window.max.x - p->window.min.x + 1;
  int64_t height = (int64_t)p->window.max.y - p->window.min.y + 1;
  if (width < 1 || height < 1 || width > INT_MAX / 12 || height > INT_MAX)
    return result_fail(error, RESULT_BAD, "has an impossible size");
  p->raster.width = (int)width;
  p->raster.height = (int)height;
  p->tiled = storage == EXR_STORAGE_TILED;
  int32_t block_width = p->raster.width, block_height = 0;
  code = p->tiled ? exr_get_tile_sizes(exr->context, part, 0, 0, &block_width, &block_height)
                  : exr_get_scanlines_per_chunk(exr->context, part, &block_height);
  if (code != EXR_ERR_SUCCESS) return fail(exr, code, error);
  if (block_width < 1 || block_height < 1)
    return result_fail(error, RESULT_BAD, "has tiles of no size");
  p->raster.block_width = block_width < p->raster.width ? block_width : p->raster.width;
  p->raster.block_height = block_height < p->raster.height ? block_height : p->raster.height;
  return RESULT_OK;
}

static exr_result_t chunk_info(struct slab_exr *exr, int part, int column, int row,
                               exr_chunk_info_t *chunk) {
  const struct part *p = &exr->parts[part];
  if (p->tiled) return exr_read_tile_chunk_info(exr->context, part, column, row, 0, 0, chunk);
  int y = p->window.min.y + row * p->raster.block_height;
  return exr_read_scanline_chunk_info(exr->context, part, y, chunk);
}

static enum result read_part_header(struct slab_exr *exr, int part, const char *text_name,
                                    struct error *error) {
  struct slab_raster *raster = &exr->parts[part].raster;
  enum result result = find_blocks(exr, part, error);
  if (result == RESULT_OK) result = check_channels(exr, part, error);
  if (result == RESULT_OK) result = check_compression(exr, part, error);
  if (result == RESULT_OK && text_name) result = check_colours(exr, part, error);
  if (result != RESULT_OK) return result;
  /* The last chunk must be there before anyone allocates memory for all. */
  exr_chunk_info_t chunk;
  exr_result_t code =
      chunk_info(exr, part, slab_raster_columns(raster) - 1, slab_raster_rows(raster) - 1, &chunk);
  if (code != EXR_ERR_SUCCESS) return fail(exr, code, error);
  const exr_attribute_t *attribute = NULL;
  if (text_name &&
      exr_get_attribute_by_name(exr->context, part, text_name, &attribute) == EXR_ERR_SUCCESS &&
      attribute->type == EXR_ATTR_STRING) {
    raster->text = strndup(attribute->string->str, (size_t)attribute->string->length);
    if (!raster->text) return result_no_memory(error);
  }
  return RESULT_OK;
}

enum result slab_exr_open(int fd, const char *path, const char *text_name, struct slab_exr **out,
                          struct error *error) {
  enum result result = RESULT_OK;
  *out = NULL;
  struct slab_exr *exr = calloc(1, sizeof *exr);
  if (!exr) {
    close(fd);
    return result_at(result_no_memory(error), error, "%s", path);
  }
  exr->fd = fd;
  exr->path = path;
  exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
  setup.error_handler_fn = remember;
  setup.user_data = exr;
  setup.read_fn = read_bytes;
  setup.size_fn = query_size;
  setup.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
  exr_result_t code = exr_start_read(&exr->context, path, &setup);
  /* OpenEXRCore 3.1 complains of a compression that it does not know, and goes on with ZIP */
  bool unknown = code == EXR_ERR_SUCCESS && strstr(exr->why, "Attribute 'compression'");
  if (code == EXR_ERR_SUCCESS) code = exr_get_count(exr->context, &exr->count);
  if (code != EXR_ERR_SUCCESS)
    result = result_at(fail(exr, code, error), error, "%s", path);
  else if (unknown)
    result = result_fail(error, RESULT_BAD,
                         "%s: its compression is not known; save it again with ZIP", path);
  else if (!(exr->parts = calloc((size_t)exr->count, sizeof *exr->parts)))
    result = result_at(result_no_memory(error), error, "%s", path);
  /* A picture is the first part. */
  if (!text_name && exr->count > 1) exr->count = 1;
  for (int part = 0; part < exr->count && result == RESULT_OK; ++part)
    result = result_at(read_part_header(exr, part, text_name, error), error, "%s: page %d", path,
                       part + 1);
  if (result == RESULT_OK)
    *out = exr;
  else
    slab_exr_close(exr);
  return result;
}

void slab_exr_close(struct slab_exr *exr) {
  if (!exr) return;
  for (int part = 0; exr->parts && part < exr->count; ++part) free(exr->parts[part].raster.text);
  if (exr->context) exr_finish(&exr->context);
  close(exr->fd);
  free(exr->parts);
  free(exr);
}

int slab_exr_parts(const struct slab_exr *exr) {
  return exr->count;
}

struct slab_raster *slab_exr_part(struct slab_exr *exr, int part) {
  return &exr->parts[part].raster;
}

/* Points R, G and B at the block; other channels are skipped. */
static void aim_channels(exr_decode_pipeline_t *pipeline, int block_width, float *rgb) {
  for (int k = 0; k < pipeline->channel_count; ++k) {
    exr_coding_channel_info_t *channel = &pipeline->channels[k];
    const char *name = channel->channel_name;
    const char *place = name[0] && !name[1] ? strchr("RGB", name[0]) : NULL;
    channel->decode_to_ptr = place ? (uint8_t *)(rgb + (place - strchr("RGB", 'R'))) : NULL;
    channel->user_bytes_per_element = sizeof(float);
    channel->user_data_type = EXR_PIXEL_FLOAT;
    channel->user_pixel_stride = 3 * sizeof(float);
    channel->user_line_stride = 3 * (int)sizeof(float) * block_width;
  }
}

enum result slab_exr_read_block(struct slab_exr *exr, int part, int column, int row, float *rgb,
                                struct error *error) {
  exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
  exr_chunk_info_t chunk;
  *exr->why = 0;
  exr_result_t code = chunk_info(exr, part, column, row, &chunk);
  if (code == EXR_ERR_SUCCESS) {
    code = exr_decoding_initialize(exr->context, part, &chunk, &pipeline);
    if (code == EXR_ERR_SUCCESS) {
      aim_channels(&pipeline, exr->parts[part].raster.block_width, rgb);
      code = exr_decoding_choose_default_routines(exr->context, part, &pipeline);
    }
    if (code == EXR_ERR_SUCCESS) code = exr_decoding_run(exr->context, part, &pipeline);
    exr_decoding_destroy(exr->context, &pipeline);
  }
  if (code == EXR_ERR_SUCCESS) return RESULT_OK;
  return result_at(fail(exr, code, error), error, "%s: page %d", exr->path, part + 1);
}

enum result slab_exr_read(const char *path, struct picture *picture, struct error *error) {
  struct slab_exr *exr = NULL;
  float *block = NULL, *rgb = NULL;
  memset(picture, 0, sizeof *picture);
  int fd = open(path, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  enum result result = slab_exr_open(fd, path, NULL, &exr, error);
  if (result != RESULT_OK) return result;
  const struct slab_raster *raster = slab_exr_part(exr, 0);
  const struct slab_area all = {0, 0, raster->width, raster->height};
  if (!slab_raster_plausible((double)raster->width * raster->height,
                             (double)query_size(NULL, exr))) {
    result = result_fail(error, RESULT_BAD, "%s: claims more pixels than its bytes can hold", path);
    goto out;
  }
  rgb = calloc((size_t)raster->width * (size_t)raster->height, 3 * sizeof(float));
  block = calloc(slab_raster_block_pixels(raster), 3 * sizeof(float));
  if (!rgb || !block) {
    result = result_fail(error, RESULT_MEMORY, "%s: out of memory for %d x %d pixels", path,
                         raster->width, raster->height);
    goto out;
  }
  for (int row = 0; row < slab_raster_rows(raster); ++row)
    for (int column = 0; column < slab_raster_columns(raster); ++column) {
      result = slab_exr_read_block(exr, 0, column, row, block, error);
      if (result != RESULT_OK) goto out;
      slab_raster_copy(raster, column, row, block, &all, rgb);
    }
  *picture = (struct picture){.width = raster->width, .height = raster->height, .rgb = rgb};
  rgb = NULL;
out:
  free(rgb);
  free(block);
  slab_exr_close(exr);
  return result;
}
