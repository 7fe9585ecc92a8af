/* slab_file.c - reads slabs from containers: recognises the container, parses the pages' JSON and
 * checks the samples. */
#include "file/slab_file.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/files.h"
#include "file/slab_exr.h"
#include "file/slab_json.h"
#include "file/slab_raster.h"
#include "file/slab_tiff.h"

enum { CACHED_BLOCKS = 4 }; /* a view smaller than a tile lies in up to four */

struct block {
  int page, column, row;
  float *rgb; /* NULL when unused */
};

struct slab_file {
  char *path;
  struct slab_tiff *tiff; /* one of the two */
  struct slab_exr *exr;
  struct slab *pages; /* geometry only */
  int count;
  struct block cache[CACHED_BLOCKS];
  int next; /* block to replace next */
};

static struct slab_raster *raster_of(const struct slab_file *file, int page) {
  return file->tiff ? slab_tiff_page(file->tiff, page) : slab_exr_part(file->exr, page);
}

static enum result recognise(int fd, const char *path, bool *exr, struct error *error) {
  static const unsigned char tiffs[4][4] = {
      {'I', 'I', 42, 0}, {'M', 'M', 0, 42}, {'I', 'I', 43, 0}, {'M', 'M', 0, 43}};
  static const unsigned char exrs[4] = {0x76, 0x2f, 0x31, 0x01};
  unsigned char magic[4] = {0};
  ssize_t got = pread(fd, magic, sizeof magic, 0);
  if (got < 0) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  if (got == 0) return result_fail(error, RESULT_BAD, "%s: is empty", path);
  *exr = !memcmp(magic, exrs, sizeof magic);
  bool known = *exr;
  for (int k = 0; k < 4; ++k) known |= !memcmp(magic, tiffs[k], sizeof magic);
  if (known) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s: is neither TIFF nor EXR, so no light slab", path);
}

/* All pages together, each with the block that it is decoded by. */
static enum result check_size(const struct slab_file *file, double bytes, struct error *error) {
  double pixels = 0;
  for (int page = 0; page < file->count; ++page) {
    const struct slab_raster *raster = raster_of(file, page);
    double block = (double)slab_raster_block_pixels(raster);
    pixels += fmax((double)raster->width * raster->height, block);
    if (!slab_raster_plausible(pixels, bytes))
      return result_fail(
          error, RESULT_BAD,
          "%s: page %d: claims more samples than a file of %.0f bytes can hold; it is "
          "damaged",
          file->path, page + 1, bytes);
  }
  return RESULT_OK;
}

static enum result parse_page(struct slab_file *file, int page, struct error *error) {
  struct slab_raster *raster = raster_of(file, page);
  struct slab *slab = &file->pages[page];
  if (!raster->text)
    return result_fail(error, RESULT_BAD, "has no JSON description (%s), so no light slab",
                       file->tiff ? "ImageDescription" : "attribute \"lightslab\"");
  enum result result = slab_json_parse(raster->text, slab, raster->white, error);
  if (result != RESULT_OK) return result;
  if (raster->width == slab_width(slab) && raster->height == slab_height(slab)) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "\"samples\" %d x %d x %d x %d need %d x %d pixels, there are %d x %d",
                     slab->samples[0], slab->samples[1], slab->samples[2], slab->samples[3],
                     slab_width(slab), slab_height(slab), raster->width, raster->height);
}

static enum result find_pages(struct slab_file *file, double bytes, struct error *error) {
  file->count = file->tiff ? slab_tiff_pages(file->tiff) : slab_exr_parts(file->exr);
  file->pages = calloc((size_t)file->count, sizeof *file->pages);
  if (!file->pages) return result_at(result_no_memory(error), error, "%s", file->path);
  enum result result = check_size(file, bytes, error);
  for (int page = 0; page < file->count && result == RESULT_OK; ++page)
    result = result_at(parse_page(file, page, error), error, "%s: page %d", file->path, page + 1);
  return result;
}

enum result slab_file_open(const char *path, struct slab_file **out, struct error *error) {
  bool piped = !strcmp(path, "-"), exr = false;
  if (piped) path = "stdin";
  *out = NULL;
  int fd = piped ? files_spool_stdin() : open(path, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return result_fail(error, RESULT_IO, "%s: %s", path, strerror(errno));
  struct slab_file *file = calloc(1, sizeof *file);
  if (file) file->path = strdup(path);
  enum result result =
      file && file->path ? RESULT_OK : result_at(result_no_memory(error), error, "%s", path);
  if (result == RESULT_OK) result = recognise(fd, path, &exr, error);
  if (result == RESULT_OK) {
    double bytes = (double)lseek(fd, 0, SEEK_END);
    lseek(fd, 0, SEEK_SET); /* libtiff reads from where it stands */
    result = exr ? slab_exr_open(fd, file->path, "lightslab", &file->exr, error)
                 : slab_tiff_open(fd, file->path, &file->tiff, error);
    fd = -1; /* theirs now */
    if (result == RESULT_OK) result = find_pages(file, bytes, error);
  }
  if (fd >= 0) close(fd);
  if (result == RESULT_OK)
    *out = file;
  else
    slab_file_close(file);
  return result;
}

void slab_file_close(struct slab_file *file) {
  if (!file) return;
  slab_tiff_close(file->tiff);
  slab_exr_close(file->exr);
  slab_file_free_all(file->pages, file->count);
  for (int k = 0; k < CACHED_BLOCKS; ++k) free(file->cache[k].rgb);
  free(file->path);
  free(file);
}

int slab_file_pages(const struct slab_file *file) {
  return file->count;
}

const struct slab *slab_file_page(const struct slab_file *file, int page) {
  return &file->pages[page];
}

enum slab_precision slab_file_precision(const struct slab_file *file, int page) {
  return raster_of(file, page)->precision;
}

const char *slab_file_lossy(const struct slab_file *file, int page) {
  return raster_of(file, page)->lossy;
}

static enum result decode_block(struct slab_file *file, int page, int column, int row, float *rgb,
                                struct error *error) {
  return file->tiff ? slab_tiff_read_block(file->tiff, page, column, row, rgb, error)
                    : slab_exr_read_block(file->exr, page, column, row, rgb, error);
}

static enum result new_block(const struct slab_file *file, int page, float **rgb,
                             struct error *error) {
  *rgb = calloc(slab_raster_block_pixels(raster_of(file, page)), 3 * sizeof **rgb);
  return *rgb ? RESULT_OK : result_at(result_no_memory(error), error, "%s", file->path);
}

static enum result cached_block(struct slab_file *file, int page, int column, int row,
                                const float **rgb, struct error *error) {
  for (int k = 0; k < CACHED_BLOCKS; ++k) {
    const struct block *block = &file->cache[k];
    if (block->rgb && block->page == page && block->column == column && block->row == row) {
      *rgb = block->rgb;
      return RESULT_OK;
    }
  }
  struct block fresh = {.page = page, .column = column, .row = row};
  enum result result = new_block(file, page, &fresh.rgb, error);
  if (result == RESULT_OK) result = decode_block(file, page, column, row, fresh.rgb, error);
  if (result != RESULT_OK) {
    free(fresh.rgb);
    return result;
  }
  free(file->cache[file->next].rgb);
  file->cache[file->next] = fresh;
  file->next = (file->next + 1) % CACHED_BLOCKS;
  *rgb = fresh.rgb;
  return RESULT_OK;
}

static enum result check_finite(const struct slab_file *file, int page,
                                const struct slab_area *area, const float *rgb,
                                struct error *error) {
  size_t count = 3 * (size_t)area->width * (size_t)area->height;
  size_t k = 0;
  while (k < count && isfinite(rgb[k])) ++k;
  if (k == count) return RESULT_OK;
  const struct slab *slab = &file->pages[page];
  size_t x = (size_t)area->x + k / 3 % (size_t)area->width;
  size_t y = (size_t)area->y + k / 3 / (size_t)area->width;
  int at[SLAB_AXES];
  slab_locate(slab, y * (size_t)slab_width(slab) + x, at);
  return result_fail(error, RESULT_BAD, "%s: page %d: sample (%d, %d, %d, %d) is not finite",
                     file->path, page + 1, at[SLAB_U], at[SLAB_V], at[SLAB_S], at[SLAB_T]);
}

enum result slab_file_read_view(struct slab_file *file, int page, int i, int j, float *rgb,
                                struct error *error) {
  const struct slab_raster *raster = raster_of(file, page);
  const struct slab *slab = &file->pages[page];
  struct slab_area view = {i * slab->samples[SLAB_S], j * slab->samples[SLAB_T],
                           slab->samples[SLAB_S], slab->samples[SLAB_T]};
  int last_row = (view.y + view.height - 1) / raster->block_height;
  int last_column = (view.x + view.width - 1) / raster->block_width;
  for (int row = view.y / raster->block_height; row <= last_row; ++row)
    for (int column = view.x / raster->block_width; column <= last_column; ++column) {
      const float *block;
      enum result result = cached_block(file, page, column, row, &block, error);
      if (result != RESULT_OK) return result;
      slab_raster_copy(raster, column, row, block, &view, rgb);
    }
  return check_finite(file, page, &view, rgb, error);
}

enum result slab_file_load(struct slab_file *file, int page, struct slab *out,
                           struct error *error) {
  const struct slab_raster *raster = raster_of(file, page);
  const struct slab_area all = {0, 0, raster->width, raster->height};
  struct slab slab = {0};
  float *block = NULL;
  enum result result = slab_copy_geometry(&file->pages[page], &slab, error);
  if (result == RESULT_OK) result = slab_alloc(&slab, error);
  result_at(result, error, "%s: page %d", file->path, page + 1);
  if (result == RESULT_OK) result = new_block(file, page, &block, error);
  /* By blocks rather than views, so that each is decoded once. */
  for (int row = 0; row < slab_raster_rows(raster) && result == RESULT_OK; ++row)
    for (int column = 0; column < slab_raster_columns(raster) && result == RESULT_OK; ++column) {
      result = decode_block(file, page, column, row, block, error);
      if (result == RESULT_OK) slab_raster_copy(raster, column, row, block, &all, slab.rgb);
    }
  if (result == RESULT_OK) result = check_finite(file, page, &all, slab.rgb, error);
  free(block);
  if (result == RESULT_OK)
    *out = slab;
  else
    slab_free(&slab);
  return result;
}

enum result slab_file_load_all(const char *path, struct slab **slabs, int *count,
                               struct error *error) {
  struct slab_file *file = NULL;
  *slabs = NULL;
  *count = 0;
  enum result result = slab_file_open(path, &file, error);
  if (result != RESULT_OK) return result;
  struct slab *pages = calloc((size_t)file->count, sizeof *pages);
  if (!pages) result = result_fail(error, RESULT_MEMORY, "%s: out of memory", path);
  for (int page = 0; page < file->count && result == RESULT_OK; ++page)
    result = slab_file_load(file, page, &pages[page], error);
  if (result == RESULT_OK) {
    *slabs = pages;
    *count = file->count;
  } else {
    slab_file_free_all(pages, file->count);
  }
  slab_file_close(file);
  return result;
}

void slab_file_free_all(struct slab *slabs, int count) {
  for (int page = 0; slabs && page < count; ++page) slab_free(&slabs[page]);
  free(slabs);
}
