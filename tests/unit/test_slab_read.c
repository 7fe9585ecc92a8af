/* test_slab_read.c - the reader, on files that plain libtiff and OpenEXRCore
 * calls wrote: every layout, and everything that must be refused. */
#include <math.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <tiffio.h>
#include <unistd.h>

#include "helpers.h"
#include "raw_files.h"

/* 3 x 2 views of 5 x 7: no size divides another. */
enum { WIDTH = 15, HEIGHT = 14, VALUES = 3 * WIDTH * HEIGHT };
#define TEXT(SAMPLES, MORE)                                                                        \
  "{\"format\": \"light-slab\", \"version\": 1, \"samples\": " SAMPLES                             \
  ", \"center\": [0, 0, 0], \"u\": [0.2, 0, 0], \"v\": [0, 0, 0.2], \"normal\": [0, -1, 0], "      \
  "\"st_window\": [-1.5, 1.5, -1, 1]" MORE "}"
#define GOOD TEXT("[3, 2, 5, 7]", "")

static float pixels[VALUES];

/* Multiples of 1/64 that half holds exactly, negative ones too. */
static int fill_pixels(void **state) {
  (void)state;
  for (int k = 0; k < VALUES; ++k) pixels[k] = (float)((k * 37) % 1000 - 300) / 64;
  return 0;
}

static struct raw_tiff plain_tiff(void) {
  return (struct raw_tiff){.width = WIDTH, .height = HEIGHT, .rgb = pixels, .text = GOOD};
}

static struct raw_exr plain_exr(void) {
  return (struct raw_exr){.width = WIDTH, .height = HEIGHT, .rgb = pixels, .text = GOOD};
}

/* Whole pages and single views are the pixels at pixel (i*Ns + k, j*Nt + l). */
static void expect_pixels(const char *path, int pages) {
  struct error error = {{0}};
  struct slab_file *file = NULL;
  assert_ok(slab_file_open(path, &file, &error), &error);
  assert_int_equal(slab_file_pages(file), pages);
  for (int page = pages - 1; page >= 0; --page) {
    struct slab slab = {0};
    float view[3 * 5 * 7];
    for (int j = 1; j >= 0; --j)
      for (int i = 0; i < 3; ++i) {
        assert_ok(slab_file_read_view(file, page, i, j, view, &error), &error);
        for (int l = 0; l < 7; ++l)
          assert_memory_equal(view + 15 * l, pixels + 3 * ((j * 7 + l) * WIDTH + i * 5),
                              15 * sizeof(float));
      }
    assert_ok(slab_file_load(file, page, &slab, &error), &error);
    assert_memory_equal(slab.rgb, pixels, sizeof pixels);
    slab_free(&slab);
  }
  slab_file_close(file);
}

TEST(test_tiff_layouts) {
  static const int compressions[] = {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_PACKBITS,
                                     COMPRESSION_DEFLATE, COMPRESSION_ADOBE_DEFLATE};
  const char *path = scratch("layout.tif");
  for (int n = 0; n < 5 * 2 * 2 * 4 * 2; ++n) {
    struct raw_tiff page = plain_tiff();
    page.compression = compressions[n % 5];
    page.half = n / 5 % 2;
    page.separate = n / 10 % 2;
    page.tile = n / 20 % 4 == 3 ? 16 : 0;
    page.rows_per_strip = (const int[]){1, 4, HEIGHT, 0}[n / 20 % 4];
    page.big_endian = page.big = n / 80;
    raw_tiff_write(path, &page);
    expect_pixels(path, 1);
  }
}

TEST(test_tiff_pages) {
  const char *path = scratch("pages.tif");
  struct raw_tiff page = plain_tiff();
  for (int n = 0; n < 3; ++n) {
    page.append = n > 0;
    page.tile = n == 1 ? 32 : 0;
    page.half = n == 2;
    raw_tiff_write(path, &page);
  }
  expect_pixels(path, 3);
}

TEST(test_exr_layouts) {
  static const int compressions[] = {EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE,
                                     EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP,
                                     EXR_COMPRESSION_PIZ};
  static const char *const channels[] = {"BGR", "ABGR", "BGRZ"};
  const char *path = scratch("layout.exr");
  for (int n = 0; n < 5 * 2 * 3 * 3; ++n) {
    struct raw_exr part = plain_exr();
    part.compression = compressions[n % 5];
    part.half = n / 5 % 2;
    part.channels = channels[n / 10 % 3];
    part.tile = (const int[]){0, 4, 64}[n / 30];
    part.left = n % 3 == 1 ? -7 : 0;
    part.top = n % 3 == 1 ? 11 : 0;
    raw_exr_write(path, &part, 1);
    expect_pixels(path, 1);
  }
}

TEST(test_exr_parts) {
  const char *path = scratch("parts.exr");
  struct raw_exr parts[3] = {plain_exr(), plain_exr(), plain_exr()};
  parts[1].tile = 8;
  parts[2].half = true;
  raw_exr_write(path, parts, 3);
  expect_pixels(path, 3);
}

/* A LogLuv page of another program: with and without a white correction. */
TEST(test_logluv) {
  static const float white_xyz[3] = {0.9504559F, 1, 1.0890578F};
  for (int corrected = 0; corrected < 2; ++corrected) {
    const char *path = scratch("foreign.tif");
    const double factor[3] = {corrected ? 1.0022531 : 1, 1, corrected ? 0.9844087 : 1};
    float xyz[3], rgb[3];
    for (int c = 0; c < 3; ++c) xyz[c] = (float)((double)white_xyz[c] * factor[c]);
    raw_logluv_write(path, 1, 1, xyz,
                     corrected
                         ? TEXT("[1, 1, 1, 1]", ", \"logluv_white\": [1.0022531, 1.0, 0.9844087]")
                         : TEXT("[1, 1, 1, 1]", ""));
    struct error error = {{0}};
    struct slab_file *file = NULL;
    assert_ok(slab_file_open(path, &file, &error), &error);
    assert_int_equal(slab_file_precision(file, 0), SLAB_PRECISION_LOGLUV);
    assert_ok(slab_file_read_view(file, 0, 0, 0, rgb, &error), &error);
    slab_file_close(file);
    /* Without the correction white comes back tinted: (1.017, .9986, .9835). */
    static const double tinted[3] = {1.017, 0.9986, 0.9835};
    for (int c = 0; c < 3; ++c)
      assert_near((double)rgb[c], corrected ? 1 : tinted[c], corrected ? 0.001355 : 0.0015);
  }
}

#define TEN "1234567890"
#define LONG_NAME TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN "12345678" /* 128 bytes */

static void refuse_text(const char *text, const char *why) {
  struct raw_tiff page = plain_tiff();
  struct raw_exr part = plain_exr();
  const char *tiff = scratch("bad.tif"), *exr = scratch("bad.exr");
  page.text = part.text = text;
  raw_tiff_write(tiff, &page);
  assert_file_refused(tiff, "page 1", why);
  raw_exr_write(exr, &part, 1);
  assert_file_refused(exr, "page 1", why);
}

#define DESCRIPTION(VERSION, SAMPLES, FRAME, WINDOW)                                               \
  "{\"format\": \"light-slab\"" VERSION SAMPLES ", \"center\": [0, 0, 0]" FRAME WINDOW "}"
#define V1 ", \"version\": 1"
#define S ", \"samples\": [3, 2, 5, 7]"
#define F ", \"u\": [1, 0, 0], \"v\": [0, 0, 1], \"normal\": [0, -1, 0]"
#define W ", \"st_window\": [-1, 1, -1, 1]"

TEST(test_refused_descriptions) {
  refuse_text(NULL, "no JSON description");
  refuse_text("a picture of a cat", "malformed JSON");
  refuse_text("{\"format\": \"light-slab\",", "malformed JSON");
  refuse_text("[1, 2]", "not an object");
  refuse_text("{}", "\"format\" is missing");
  refuse_text("{\"format\": \"dark-slab\"}", "\"format\" is not");
  refuse_text(DESCRIPTION("", S, F, W), "\"version\" is missing");
  refuse_text(DESCRIPTION(", \"version\": 2", S, F, W), "version 2");
  refuse_text(DESCRIPTION(", \"version\": \"1\"", S, F, W), "\"version\" must be");
  refuse_text(DESCRIPTION(V1, "", F, W), "\"samples\" is missing");
  refuse_text(DESCRIPTION(V1, ", \"samples\": [3, 2, 5]", F, W), "\"samples\" must be");
  refuse_text(DESCRIPTION(V1, ", \"samples\": [3, 2, 5, 7.5]", F, W), "\"samples\" must be");
  refuse_text(DESCRIPTION(V1, ", \"samples\": [3, 2, 5, 0]", F, W), "at least 1");
  refuse_text(DESCRIPTION(V1, ", \"samples\": [3, 2, 7, 5]", F, W), "need 21 x 10 pixels");
  refuse_text(
      DESCRIPTION(V1, ", \"samples\": [1000000000, 1000000000, 1000000000, 1000000000]", F, W),
      "too many");
  refuse_text(DESCRIPTION(V1, S, "", W), "\"u\" is missing");
  refuse_text(
      DESCRIPTION(V1, S, ", \"u\": [1, 0, 0], \"v\": [0.1, 0, 1], \"normal\": [0, -1, 0]", W),
      "not perpendicular");
  refuse_text(DESCRIPTION(V1, S, ", \"u\": [1, 0, 0], \"v\": [0, 0, 0], \"normal\": [0, -1, 0]", W),
              "v has zero length");
  refuse_text(DESCRIPTION(V1, S, ", \"u\": [1, 0, 0], \"v\": [0, 0, 1], \"normal\": [0, -2, 0]", W),
              "normal has length 2");
  refuse_text(DESCRIPTION(V1, S, ", \"u\": [1, 0, \"0\"], \"v\": [0, 0, 1]", W),
              "array of 3 numbers");
  refuse_text(DESCRIPTION(V1, S, F, ""), "\"st_window\" is missing");
  refuse_text(DESCRIPTION(V1, S, F, ", \"st_window\": [1, 1, -1, 1]"), "is empty");
  refuse_text(DESCRIPTION(V1, S, F, ", \"st_window\": [-1, 1, 1, -1]"), "is empty");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"st_distance\": 0"), "st_distance");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"st_distance\": 1e-320"), "too small to divide by");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"name\": \"" LONG_NAME "\""),
              "\"name\" is longer than 127 bytes");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"name\": \"a\\u0000b\""), "JSON");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"st_distance\": \"far\""), "\"st_distance\" must be");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"radiance_unit\": \"nit\""), "radiance_unit");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"metres_per_unit\": -1"), "metres_per_unit");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"samples_are\": \"good\""), "samples_are");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"name\": 7"), "\"name\" must be");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"logluv_white\": [1, 0, 1]"), "logluv_white");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"logluv_white\": [1, -1, 1]"), "logluv_white");
  refuse_text(DESCRIPTION(V1, S, F, W ", \"name\": \"a\", \"name\": \"b\""), "malformed JSON");
}

/* The second page, and the sample by its four indices. */
TEST(test_refused_samples) {
  static float bad[VALUES];
  static const float values[] = {NAN, INFINITY, -INFINITY};
  for (int n = 0; n < 3; ++n) {
    struct raw_tiff page = plain_tiff();
    struct raw_exr parts[2] = {plain_exr(), plain_exr()};
    const char *tiff = scratch("nan.tif"), *exr = scratch("nan.exr");
    memcpy(bad, pixels, sizeof bad);
    bad[3 * ((1 * 7 + 6) * WIDTH + 2 * 5 + 3) + 1] = values[n];
    raw_tiff_write(tiff, &page);
    page.append = true;
    page.rgb = parts[1].rgb = bad;
    raw_tiff_write(tiff, &page);
    assert_file_refused(tiff, "page 2", "sample (2, 1, 3, 6) is not finite");
    raw_exr_write(exr, parts, 2);
    assert_file_refused(exr, "page 2", "sample (2, 1, 3, 6) is not finite");
    struct error error = {{0}};
    struct slab_file *file = NULL;
    float view[3 * 5 * 7];
    assert_ok(slab_file_open(tiff, &file, &error), &error);
    assert_ok(slab_file_read_view(file, 1, 1, 1, view, &error), &error);
    assert_refused(slab_file_read_view(file, 1, 2, 1, view, &error), &error, tiff, "page 2",
                   "(2, 1, 3, 6)", NULL);
    slab_file_close(file);
  }
}

TEST(test_refused_pixels) {
  const char *path = scratch("odd.tif");
  struct raw_tiff page = plain_tiff();
  page.samples = 4;
  raw_tiff_write(path, &page);
  assert_file_refused(path, "page 1", "3 samples");
  page = plain_tiff();
  page.integer = true;
  raw_tiff_write(path, &page);
  assert_file_refused(path, "page 1", "LogLuv");
  path = scratch("odd.exr");
  struct raw_exr part = plain_exr();
  part.channels = "BR";
  raw_exr_write(path, &part, 1);
  assert_file_refused(path, "page 1", "no channel G");
}

TEST(test_foreign_and_empty) {
  const char *path = scratch("foreign");
  struct error error = {{0}};
  struct slab_file *file = NULL;
  write_bytes(path, "", 0);
  assert_file_refused(path, "is empty", "");
  write_bytes(path, "\x89PNG\r\n\x1a\n", 8);
  assert_file_refused(path, "neither TIFF nor EXR", "");
  write_bytes(path, "I", 1);
  assert_file_refused(path, "neither TIFF nor EXR", "");
  write_bytes(path, "II*\0\xff\xff\xff\xff", 8);
  assert_file_refused(path, "", "");
  write_bytes(path, "\x76\x2f\x31\x01\x02\0\0\0", 8);
  assert_file_refused(path, "", "");
  assert_refused(slab_file_open(scratch("none"), &file, &error), &error, "No such file", NULL);
  assert_refused(slab_file_open("/", &file, &error), &error, "/: Is a directory", NULL);
}

/* A file cut anywhere is refused, at once or when its pixels are read. */
static void expect_truncated(const char *path) {
  struct stat status;
  assert_int_equal(stat(path, &status), 0);
  static char bytes[1 << 16];
  FILE *in = fopen(path, "rb");
  size_t size = fread(bytes, 1, sizeof bytes, in);
  fclose(in);
  assert_true(size > 100 && size < sizeof bytes);
  const char *cut = scratch("cut");
  for (size_t length = 0; length < size; length += length < 16 ? 1 : 13) {
    write_bytes(cut, bytes, length);
    assert_file_refused(cut, "", "");
  }
  write_bytes(cut, bytes, size - 1);
  assert_file_refused(cut, "", "");
}

TEST(test_truncated) {
  struct slab slab = awkward_slab((const int[]){3, 2, 5, 7}, 1);
  fill_colours(&slab, 2);
  struct error error = {{0}};
  static const struct {
    const char *name;
    enum slab_precision precision;
  } files[] = {{"t.tif", SLAB_PRECISION_LOGLUV},
               {"t.tif", SLAB_PRECISION_FLOAT},
               {"t.exr", SLAB_PRECISION_FLOAT},
               {"t.exr", SLAB_PRECISION_HALF}};
  for (size_t k = 0; k < 4; ++k) {
    const char *path = scratch(files[k].name);
    assert_ok(slab_file_write(path, &slab, 1, files[k].precision, &error), &error);
    expect_truncated(path);
  }
  slab_free(&slab);
}

/* A header of a few bytes that promises 30000 x 30000 pixels is refused
 * before anything of that size is allocated. */
TEST(test_lying_header) {
  const char *path = scratch("lie.tif");
  TIFF *tif = TIFFOpen(path, "w");
  TIFFSetField(tif, TIFFTAG_IMAGEWIDTH, 30000);
  TIFFSetField(tif, TIFFTAG_IMAGELENGTH, 30000);
  TIFFSetField(tif, TIFFTAG_SAMPLESPERPIXEL, 3);
  TIFFSetField(tif, TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tif, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tif, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(tif, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tif, TIFFTAG_ROWSPERSTRIP, 30000);
  TIFFSetField(tif, TIFFTAG_IMAGEDESCRIPTION, TEXT("[100, 100, 300, 300]", ""));
  float few[3] = {1, 1, 1};
  TIFFWriteRawStrip(tif, 0, few, sizeof few);
  TIFFClose(tif);
  struct error error = {{0}};
  struct slab *slabs = NULL;
  int count = 0;
  assert_refused(slab_file_load_all(path, &slabs, &count, &error), &error, path, "page 1", NULL);
}

int main(void) {
  TIFFSetWarningHandler(NULL);
  return testing_run(fill_pixels, NULL);
}
