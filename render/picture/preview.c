#include "picture/preview.h"

#include <errno.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double percentile = 0.99, brightness = 0.9;

/* The number of that rank, from 0, among floats that are not negative: these are in the order of
 * their bits, of which the upper half is found first. */
static float find_rank(const float *numbers, size_t count, size_t rank, size_t *tally) {
  enum { HALF = 1 << 16 };
  uint32_t upper = 0, bits;
  for (int round = 0; round < 2; ++round) {
    memset(tally, 0, HALF * sizeof *tally);
    for (size_t k = 0; k < count; ++k) {
      memcpy(&bits, &numbers[k], sizeof bits);
      if (round == 0 || bits >> 16 == upper) ++tally[round == 0 ? bits >> 16 : bits % HALF];
    }
    uint32_t at = 0;
    while (rank >= tally[at]) rank -= tally[at++];
    upper = round == 0 ? at : upper << 16 | at;
  }
  float number;
  memcpy(&number, &upper, sizeof number);
  return number;
}

enum result preview_exposure(const struct picture *picture, double *white, struct error *error) {
  size_t count = (size_t)picture->width * (size_t)picture->height;
  float *brightest = malloc(count * sizeof *brightest), most = 0;
  size_t *tally = malloc((1 << 16) * sizeof *tally);
  enum result result = brightest && tally ? RESULT_OK : result_no_memory(error);
  for (size_t k = 0; k < count && result == RESULT_OK; ++k) {
    const float *rgb = picture->rgb + 3 * k;
    float bright = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
    brightest[k] = isfinite(bright) && bright > 0 ? bright : 0;
    most = fmaxf(most, brightest[k]);
  }
  if (result == RESULT_OK) {
    size_t rank = (size_t)(percentile * (double)(count - 1));
    double bright = find_rank(brightest, count, rank, tally);
    if (!(bright > 0)) bright = most;
    *white = bright > 0 ? bright / brightness : 1;
  }
  free(brightest);
  free(tally);
  return result;
}

/* Where libpng writes to, and its error. */
struct sink {
  struct output *output;
  uint64_t written;
  bool whole; /* all of it is written */
  char trouble[160];
  jmp_buf out; /* libpng longjmps here on error */
};

static void take_bytes(png_structp png, png_bytep bytes, size_t count) {
  struct sink *sink = png_get_io_ptr(png);
  if (output_write(sink->output, bytes, count, sink->written) != 0) png_error(png, strerror(errno));
  sink->written += count;
}

static void flush_bytes(png_structp png) {
  (void)png;
}

static void take_error(png_structp png, png_const_charp text) {
  struct sink *sink = png_get_error_ptr(png);
  snprintf(sink->trouble, sizeof sink->trouble, "%s", text);
  longjmp(sink->out, 1);
}

static void ignore_warning(png_structp png, png_const_charp text) {
  (void)png, (void)text;
}

/* The sRGB curve, IEC 61966-2-1. */
static png_byte encode(double value) {
  if (!(value > 0)) return 0;
  if (value >= 1) return 255;
  double srgb = value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1 / 2.4) - 0.055;
  return (png_byte)(255 * srgb + 0.5);
}

static void put_texts(png_structp png, png_infop info, double white, const char *comment) {
  char exposure[64], key_comment[] = "Comment", key_exposure[] = "Exposure";
  snprintf(exposure, sizeof exposure, "%.9g is white", white);
  char *copy = strdup(comment); /* libpng wants no const */
  if (!copy) png_error(png, "out of memory");
  png_text texts[2] = {
      {.compression = PNG_TEXT_COMPRESSION_NONE, .key = key_comment, .text = copy},
      {.compression = PNG_TEXT_COMPRESSION_NONE, .key = key_exposure, .text = exposure}};
  png_set_text(png, info, texts, 2); /* copies them */
  free(copy);
}

/* Does not return where libpng fails: take_error longjmps. */
static void put_picture(png_structp png, png_infop info, const struct picture *picture,
                        double white, const char *comment, png_byte *row) {
  png_set_IHDR(png, info, (png_uint_32)picture->width, (png_uint_32)picture->height, 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
  put_texts(png, info, white, comment);
  png_write_info(png, info);
  size_t values = 3 * (size_t)picture->width;
  for (int y = 0; y < picture->height; ++y) {
    const float *rgb = picture->rgb + values * (size_t)y;
    for (size_t k = 0; k < values; ++k) row[k] = encode(rgb[k] / white);
    png_write_row(png, row);
  }
  png_write_end(png, info);
}

enum result preview_put(struct output *output, const struct picture *picture, double white,
                        const char *comment, struct error *error) {
  struct sink *sink = calloc(1, sizeof *sink);
  png_byte *row = malloc(3 * (size_t)picture->width);
  png_structp png = NULL;
  png_infop info = NULL;
  if (sink && row)
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, sink, take_error, ignore_warning);
  if (png) info = png_create_info_struct(png);
  if (info) sink->output = output;
  if (info && setjmp(sink->out) == 0) {
    png_set_write_fn(png, sink, take_bytes, flush_bytes);
    put_picture(png, info, picture, white, comment, row);
    sink->whole = true;
  }
  enum result result = RESULT_OK;
  if (!info)
    result = result_fail(error, RESULT_MEMORY, "%s: out of memory", output->target);
  else if (!sink->whole)
    result =
        result_fail(error, RESULT_IO, "%s: cannot be written: %s", output->target, sink->trouble);
  png_destroy_write_struct(png ? &png : NULL, info ? &info : NULL);
  free(row);
  free(sink);
  return result;
}

enum result preview_write(const char *path, const struct picture *picture, double white,
                          const char *comment, struct error *error) {
  struct output output = {0};
  enum result result = output_begin(&output, path, error);
  if (result == RESULT_OK) result = preview_put(&output, picture, white, comment, error);
  if (result == RESULT_OK) result = output_commit(&output, error);
  output_abandon(&output);
  return result;
}
