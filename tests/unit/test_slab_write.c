/* test_slab_write.c - the writer: accuracy of each precision, and what is refused. Files are also
 * read with plain libtiff calls. */
#include <jansson.h>
#include <string.h>
#include <tiffio.h>

#include "file/slab_exr.h"
#include "helpers.h"
#include "oracle/random.h"

static const struct {
  const char *name;
  enum slab_precision precision, stored;
} kinds[] = {{"k.tif", SLAB_PRECISION_DEFAULT, SLAB_PRECISION_LOGLUV},
             {"k.TIFF", SLAB_PRECISION_LOGLUV, SLAB_PRECISION_LOGLUV},
             {"k.tif", SLAB_PRECISION_FLOAT, SLAB_PRECISION_FLOAT},
             {"k.tif", SLAB_PRECISION_HALF, SLAB_PRECISION_HALF},
             {"k.exr", SLAB_PRECISION_DEFAULT, SLAB_PRECISION_FLOAT},
             {"k.exr", SLAB_PRECISION_HALF, SLAB_PRECISION_HALF}};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* Largest error of a channel relative to the pixel's largest channel. */
static double allowed(enum slab_precision precision, int c, bool white) {
  static const double logluv[3] = {0.022, 0.009, 0.020};
  switch (precision) {
  case SLAB_PRECISION_LOGLUV:
    return white ? 0.001355 : logluv[c];
  case SLAB_PRECISION_HALF:
    return 0x1p-11;
  default:
    return 0;
  }
}

static double luminance(const float rgb[3]) {
  return 0.2126390 * (double)rgb[0] + 0.7151687 * (double)rgb[1] + 0.0721923 * (double)rgb[2];
}

static void expect_close(const struct slab *want, const struct slab *got,
                         enum slab_precision precision) {
  size_t count = slab_sample_count(want);
  assert_memory_equal(want->samples, got->samples, sizeof want->samples);
  for (size_t k = 0; k < count; ++k) {
    const float *a = want->rgb + 3 * k, *b = got->rgb + 3 * k;
    double largest = fmax((double)a[0], fmax((double)a[1], (double)a[2]));
    bool white = a[0] == a[1] && a[1] == a[2];
    for (int c = 0; c < 3; ++c)
      assert_near((double)a[c], (double)b[c], allowed(precision, c, white) * largest);
    if (precision == SLAB_PRECISION_LOGLUV) assert_near(luminance(b) / luminance(a), 1, 0.001356);
  }
}

static void expect_same_geometry(const struct slab *a, const struct slab *b) {
  assert_string_equal(a->name, b->name);
  assert_string_equal(a->radiance_unit, b->radiance_unit);
  assert_memory_equal(a->center, b->center, sizeof a->center);
  assert_memory_equal(a->u, b->u, sizeof a->u);
  assert_memory_equal(a->v, b->v, sizeof a->v);
  assert_memory_equal(a->normal, b->normal, sizeof a->normal);
  assert_memory_equal(a->st_window, b->st_window, sizeof a->st_window);
  assert_true(a->st_distance == b->st_distance);
  assert_true(a->metres_per_unit == b->metres_per_unit);
}

/* Two pages, a mirrored frame, tiles that are views and tiles that are not. */
TEST(test_round_trips) {
  static const int grids[][4] = {{3, 2, 16, 32}, {5, 3, 7, 9}, {1, 1, 1, 1}, {70, 1, 1, 70}};
  for (size_t g = 0; g < 4; ++g)
    for (int k = 0; k < KINDS; ++k) {
      struct slab pages[2] = {awkward_slab(grids[g], INFINITY),
                              awkward_slab(grids[3 - g], 1.0 / 3)};
      struct error error = {{0}};
      struct slab_file *file = NULL;
      pages[1].metres_per_unit = 0.001;
      strcpy(pages[1].radiance_unit, "cd/m2");
      strcpy(pages[1].name, "zweite \"Seite\" \xc3\xa4");
      for (int page = 0; page < 2; ++page) fill_colours(&pages[page], (uint32_t)(g + 10));
      const char *path = scratch(kinds[k].name);
      struct slab *got = write_and_load(path, pages, 2, kinds[k].precision);
      assert_ok(slab_file_open(path, &file, &error), &error);
      for (int page = 0; page < 2; ++page) {
        assert_int_equal(slab_file_precision(file, page), kinds[k].stored);
        expect_same_geometry(&pages[page], &got[page]);
        expect_close(&pages[page], &got[page], kinds[k].stored);
      }
      slab_file_close(file);
      slab_file_free_all(got, 2);
      slab_free(&pages[0]);
      slab_free(&pages[1]);
    }
}

/* 1e-12 to 1e12, and black. */
TEST(test_logluv_range) {
  struct slab slab = awkward_slab((const int[]){1, 1, 25, 3}, INFINITY);
  for (int k = 0; k < 25; ++k)
    for (int l = 0; l < 3; ++l)
      for (int c = 0; c < 3; ++c)
        slab_at(&slab, 0, 0, k, l)[c] = l == 2 ? 0 : (float)(pow(10, k - 12) * (l ? 0.5 + c : 1));
  struct slab *got = write_and_load(scratch("range.tif"), &slab, 1, SLAB_PRECISION_LOGLUV);
  for (int k = 0; k < 25; ++k) {
    assert_near(luminance(slab_at(got, 0, 0, k, 0)) / luminance(slab_at(&slab, 0, 0, k, 0)), 1,
                0.001356);
    for (int c = 0; c < 3; ++c) {
      assert_near((double)(slab_at(got, 0, 0, k, 0)[c] / slab_at(&slab, 0, 0, k, 0)[c]), 1,
                  0.001356);
      assert_true(slab_at(got, 0, 0, k, 2)[c] == 0);
    }
  }
  slab_file_free_all(got, 1);
  slab_free(&slab);
}

/* The steps of chromaticity make no negative light of saturated colours, at any luminance. */
TEST(test_logluv_saturated) {
  static const float colours[6][3] = {{1, 0, 0},    {0, 1, 0},     {0, 0, 1},
                                      {1, 0.3F, 0}, {0, 0.01F, 1}, {1, 0, 0.6F}};
  struct slab slab = awkward_slab((const int[]){1, 1, 6, 50}, INFINITY);
  for (int k = 0; k < 6; ++k)
    for (int l = 0; l < 50; ++l)
      for (int c = 0; c < 3; ++c)
        slab_at(&slab, 0, 0, k, l)[c] = colours[k][c] * (float)pow(1.3, l - 25);
  struct slab *got = write_and_load(scratch("saturated.tif"), &slab, 1, SLAB_PRECISION_LOGLUV);
  for (int k = 0; k < 6; ++k)
    for (int l = 0; l < 50; ++l)
      for (int c = 0; c < 3; ++c) {
        double read = (double)slab_at(got, 0, 0, k, l)[c];
        assert_true(read >= 0);
        assert_near(read / pow(1.3, l - 25), (double)colours[k][c], 0.025);
      }
  slab_file_free_all(got, 1);
  slab_free(&slab);
}

/* The format's raster and tags, read without our code; the primaries' matrix
 * is solved from their chromaticities. */
TEST(test_tiff_as_others_see_it) {
  struct slab slab = awkward_slab((const int[]){3, 2, 16, 32}, 2);
  struct error error = {{0}};
  fill_colours(&slab, 4);
  const char *path = scratch("others.tif");
  for (int logluv = 0; logluv < 2; ++logluv) {
    assert_ok(slab_file_write(path, &slab, 1, logluv ? SLAB_PRECISION_LOGLUV : SLAB_PRECISION_FLOAT,
                              &error),
              &error);
    TIFF *tif = TIFFOpen(path, "r");
    uint32_t width = 0, height = 0, tile_width = 0, tile_height = 0;
    uint16_t compression = 0;
    const char *text = NULL;
    TIFFGetField(tif, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tif, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetField(tif, TIFFTAG_TILEWIDTH, &tile_width);
    TIFFGetField(tif, TIFFTAG_TILELENGTH, &tile_height);
    TIFFGetField(tif, TIFFTAG_COMPRESSION, &compression);
    TIFFGetField(tif, TIFFTAG_IMAGEDESCRIPTION, &text);
    assert_true(width == 48 && height == 64 && tile_width == 16 && tile_height == 32);
    if (logluv) assert_int_equal(compression, COMPRESSION_SGILOG);
    json_t *json = json_loads(text, 0, NULL);
    assert_string_equal(json_string_value(json_object_get(json, "format")), "light-slab");
    const json_t *white = json_object_get(json, "logluv_white");
    assert_int_equal(json_array_size(white), logluv ? 3 : 0);
    if (logluv) TIFFSetField(tif, TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT);
    static float tile[16 * 32 * 3];
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) {
        assert_int_equal(TIFFReadEncodedTile(tif, (uint32_t)(3 * j + i), tile, sizeof tile),
                         sizeof tile);
        for (int l = 0; l < 32; ++l)
          for (int k = 0; k < 16; ++k) {
            const float *sample = slab_at(&slab, i, j, k, l), *pixel = tile + 3 * (16 * l + k);
            if (!logluv) {
              assert_memory_equal(pixel, sample, 3 * sizeof(float));
              continue;
            }
            double y = luminance(sample);
            assert_near((double)pixel[1] / json_number_value(json_array_get(white, 1)) / y, 1,
                        0.001356);
            if (sample[0] != sample[1] || sample[1] != sample[2]) continue;
            /* white: D65 at x = 0.3127, y = 0.3290 */
            assert_near((double)pixel[0] / json_number_value(json_array_get(white, 0)) / y,
                        0.3127 / 0.3290, 0.0014);
            assert_near((double)pixel[2] / json_number_value(json_array_get(white, 2)) / y,
                        (1 - 0.3127 - 0.3290) / 0.3290, 0.0016);
          }
      }
    json_decref(json);
    TIFFClose(tif);
  }
  slab_free(&slab);
}

static void refuse(enum slab_precision precision, const float rgb[3], const char *why) {
  struct slab slab = awkward_slab((const int[]){2, 3, 4, 5}, 1);
  struct error error = {{0}};
  fill_colours(&slab, 1);
  memcpy(slab_at(&slab, 1, 2, 3, 4), rgb, 3 * sizeof(float));
  int before = scratch_entries();
  const char *path = scratch("refused.tif");
  assert_refused(slab_file_write(path, &slab, 1, precision, &error), &error, path, "page 1",
                 "sample (1, 2, 3, 4)", why, NULL);
  assert_int_equal(scratch_entries(), before);
  slab_free(&slab);
}

TEST(test_refused_samples) {
  refuse(SLAB_PRECISION_LOGLUV, (const float[]){-1, -1, -1}, "--precision float");
  refuse(SLAB_PRECISION_LOGLUV, (const float[]){1, -1, 0}, "--precision float");
  refuse(SLAB_PRECISION_LOGLUV, (const float[]){1e20F, 1e20F, 1e20F}, "--precision float");
  refuse(SLAB_PRECISION_LOGLUV, (const float[]){1, 1, -0.01F}, "negative channel");
  refuse(SLAB_PRECISION_LOGLUV, (const float[]){-1, 0.5F, -1}, "--precision float"); /* no colour */
  refuse(SLAB_PRECISION_LOGLUV, (const float[]){NAN, 1, 1}, "not finite");
  refuse(SLAB_PRECISION_FLOAT, (const float[]){1, INFINITY, 1}, "not finite");
  refuse(SLAB_PRECISION_HALF, (const float[]){1, NAN, 1}, "not finite");
  refuse(SLAB_PRECISION_HALF, (const float[]){1, 1, 65520}, "--precision float");
  refuse(SLAB_PRECISION_HALF, (const float[]){-65520, 1, 1}, "--precision float");
}

/* float takes all finite numbers as they are; half up to its limit. */
TEST(test_extremes) {
  static const float values[] = {-1, 3e38F, -3e38F, 1e-45F, -0.0F, 1.00001F};
  for (int exr = 0; exr < 2; ++exr) {
    struct slab slab = awkward_slab((const int[]){1, 1, 2, 1}, 1);
    const char *path = scratch(exr ? "extreme.exr" : "extreme.tif");
    memcpy(slab.rgb, values, sizeof values);
    struct slab *got = write_and_load(path, &slab, 1, SLAB_PRECISION_FLOAT);
    assert_memory_equal(got->rgb, values, sizeof values);
    slab_file_free_all(got, 1);
    slab.rgb[1] = 65519, slab.rgb[2] = -65504, slab.rgb[3] = 0x1p-24F, slab.rgb[5] = 0x1.004p0F;
    static const float halves[] = {-1, 65504, -65504, 0x1p-24F, -0.0F, 0x1.004p0F};
    got = write_and_load(path, &slab, 1, SLAB_PRECISION_HALF);
    assert_memory_equal(got->rgb, halves, sizeof halves);
    slab_file_free_all(got, 1);
    slab_free(&slab);
  }
}

/* Noise of every length: among these are chunks that compress to exactly their
 * own size. */
TEST(test_exr_chunk_sizes) {
  uint64_t seed = 5;
  const char *path = scratch("noise.exr");
  for (int width = 1; width <= 60; ++width)
    for (int levels = 2; levels < 20; levels += 3) {
      float rgb[3 * 60];
      struct picture picture = {.width = width, .height = 1, .rgb = rgb}, got = {0};
      struct error error = {{0}};
      for (int k = 0; k < 3 * width; ++k) rgb[k] = (float)floor(levels * random_number(&seed));
      assert_ok(slab_exr_write(path, &picture, 1, "noise", &error), &error);
      assert_ok(slab_exr_read(path, &got, &error), &error);
      assert_int_equal(got.width, width);
      assert_memory_equal(got.rgb, rgb, sizeof(float) * 3 * (size_t)width);
      picture_free(&got);
    }
}

/* A picture with errors is read as the picture that it is. */
TEST(test_exr_errors) {
  const char *path = scratch("errors.exr");
  float rgb[3 * 12], off[3 * 12];
  struct picture picture = {.width = 4, .height = 3, .rgb = rgb, .error = off}, got = {0};
  struct error error = {{0}};
  for (int k = 0; k < 3 * 12; ++k) {
    rgb[k] = (float)k / 7;
    off[k] = -1;
  }
  assert_ok(slab_exr_write(path, &picture, 0, "errors", &error), &error);
  assert_ok(slab_exr_read(path, &got, &error), &error);
  assert_int_equal(got.height, 3);
  assert_memory_equal(got.rgb, rgb, sizeof rgb);
  picture_free(&got);
}

int main(void) {
  return testing_run(NULL, NULL);
}
