/* test_image.c - pictures are what their files say of themselves: which way round, which colours,
 * which part; or they are refused by name. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_image.h"
#include "images.h"
#include "testing.h"

static double srgb(double x) {
  return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

static struct slab_image_says says;

static struct picture read_colours(const struct image *image, const char *suffix,
                                   enum slab_image_colours colours) {
  struct picture picture;
  struct error error = {{0}};
  if (slab_image_read("image", image->bytes, image->size, suffix, colours, &picture, &says,
                      &error) != RESULT_OK)
    fail_msg("%s", error.text);
  return picture;
}

static void refused(const struct image *image, const char *suffix, const char *piece) {
  struct picture picture;
  struct error error = {{0}};
  if (slab_image_read("image", image->bytes, image->size, suffix, SLAB_IMAGE_OWN, &picture, NULL,
                      &error) == RESULT_OK)
    fail_msg("was read; it must say '%s'", piece);
  assert_null(picture.rgb);
  assert_null(strchr(error.text, '\n'));
  if (!strstr(error.text, piece)) fail_msg("'%s' does not say '%s'", error.text, piece);
}

/* Each value of the first pixel; free of the file. */
static void expect_pixel(const struct image *image, const char *suffix, const double rgb[3],
                         double tolerance) {
  struct picture picture = read_colours(image, suffix, SLAB_IMAGE_OWN);
  for (int c = 0; c < 3; ++c) assert_near(picture.rgb[c], rgb[c], tolerance);
  picture_free(&picture);
}

/* What oiiotool writes. */
static struct image made(const char *name, const char *words) {
  char command[1024];
  unsigned char bytes[65536];
  struct image image = {0};
  snprintf(command, sizeof command, "oiiotool %s -o '%s'", words, scratch(name));
  assert_int_equal(system(command), 0);
  FILE *file = fopen(scratch(name), "rb");
  assert_non_null(file);
  image_put(&image, bytes, fread(bytes, 1, sizeof bytes, file));
  fclose(file);
  return image;
}

/* ---- Which way round ---- */

/* Six cells, 2 across and 3 down, are stored; EXIF 2.3 says how each orientation shows them. */
static const unsigned char cells[6] = {30, 60, 90, 120, 150, 180};
static const char *const shown[9] = {NULL,      "12/34/56", "21/43/65", "65/43/21", "56/34/12",
                                     "135/246", "531/642",  "642/531",  "246/135"};

static void expect_cells(const struct image *image, const char *suffix, int size, const char *rows,
                         double (*value)(int cell)) {
  struct picture picture = read_colours(image, suffix, SLAB_IMAGE_OWN);
  int width = (int)strcspn(rows, "/"), height = 6 / width;
  assert_int_equal(picture.width, width * size);
  assert_int_equal(picture.height, height * size);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      double wanted = value(rows[y / size * (width + 1) + x / size] - '1');
      assert_near(picture.rgb[3 * (y * picture.width + x)], wanted, 0.008);
    }
  picture_free(&picture);
}

static double cell_srgb(int cell) {
  return srgb(cells[cell] / 255.0);
}

TEST(test_orientations) {
  unsigned char large[24 * 16];
  for (int k = 0; k < 24 * 16; ++k) large[k] = cells[k / 16 / 8 * 2 + k % 16 / 8];
  struct image big = {0};
  image_put(&big, "P5\n16 24\n255\n", 13);
  image_put(&big, large, sizeof large);
  char words[1024], path[512];
  snprintf(path, sizeof path, "%s", scratch("cells.pgm"));
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  fwrite(big.bytes, 1, big.size, file);
  assert_int_equal(fclose(file), 0);
  snprintf(words, sizeof words, "'%s' --compression jpeg:100", path);
  made("cells.jpg", words);
  for (int orientation = 1; orientation <= 8; ++orientation) {
    struct image exif = image_exif(orientation), png = image_png(2, 3, 8, 0, cells);
    image_png_chunk(&png, "eXIf", &exif);
    expect_cells(&png, "png", 1, shown[orientation], cell_srgb);
    struct image segment = {0};
    image_put(&segment, "Exif\0", 6);
    image_put(&segment, exif.bytes, exif.size);
    struct image jpeg = image_jpeg(scratch("cells.jpg"), 0xffe1, &segment);
    expect_cells(&jpeg, "jpg", 8, shown[orientation], cell_srgb);
    const struct image_field field = {274, 3, (uint32_t[]){(uint32_t)orientation}, 1};
    struct image tiff = image_tiff(2, 3, 1, 1, cells, &field, 1);
    expect_cells(&tiff, "tif", 1, shown[orientation], cell_srgb);
  }
}

/* ---- Radiance ---- */

static struct image radiance(const char *header, const char *size, int columns, int rows) {
  struct image image = {0};
  char text[512];
  int length = snprintf(text, sizeof text, "#?RADIANCE\n%s\n", header);
  image_put(&image, text, (size_t)length);
  length = snprintf(text, sizeof text, size, rows, columns);
  image_put(&image, text, (size_t)length);
  for (int k = 0; k < columns * rows; ++k)
    image_put(&image, (unsigned char[]){(unsigned char)(128 + 16 * k), 128, 64, 129}, 4);
  return image;
}

static double cell_radiance(int cell) {
  return 1 + cell / 8.0; /* 128/256 * 2^(129 - 128) */
}

static const char rgbe[] = "FORMAT=32-bit_rle_rgbe\n";

TEST(test_radiance_axes) {
  static const struct {
    const char *size, *rows;
    int across;
  } orders[] = {{"-Y %d +X %d\n", "12/34/56", 2}, {"-Y %d -X %d\n", "21/43/65", 2},
                {"+Y %d -X %d\n", "65/43/21", 2}, {"+Y %d +X %d\n", "56/34/12", 2},
                {"+X %d -Y %d\n", "135/246", 2},  {"+X %d +Y %d\n", "246/135", 2},
                {"-X %d +Y %d\n", "642/531", 2},  {"-X %d -Y %d\n", "531/642", 2}};
  for (size_t k = 0; k < sizeof orders / sizeof *orders; ++k) {
    struct image image = radiance(rgbe, orders[k].size, orders[k].across, 3);
    expect_cells(&image, "hdr", 1, orders[k].rows, cell_radiance);
  }
}

TEST(test_radiance_exposure) {
  struct image image =
      radiance("EXPOSURE=2\nEXPOSURE= 4\nCOLORCORR= 1 2 4\nPIXASPECT=2\nFORMAT=32-bit_rle_rgbe\n",
               "-Y %d +X %d\n", 1, 1);
  expect_pixel(&image, "hdr", (double[]){1 / 8.0, 1 / 16.0, 0.5 / 32}, 1e-6);
  assert_near(says.pixel_aspect, 0.5, 1e-6);
  image = radiance("FORMAT=32-bit_rle_xyze\n", "-Y %d +X %d\n", 1, 1);
  refused(&image, "hdr", "XYZE");
  image = radiance("PRIMARIES= 1 0 0 1 0 0 .3333 .3333\nFORMAT=32-bit_rle_rgbe\n", "-Y %d +X %d\n",
                   1, 1);
  refused(&image, "hdr", "PRIMARIES");
  image = radiance("EXPOSURE=0\nFORMAT=32-bit_rle_rgbe\n", "-Y %d +X %d\n", 1, 1);
  refused(&image, "hdr", "exposure");
}

/* ---- Colours ---- */

static struct image png16(const double rgb[3]) {
  struct image pixels = {0};
  for (int c = 0; c < 3; ++c) image_big(&pixels, (uint64_t)lround(rgb[c] * 65535), 2);
  return image_png(1, 1, 16, 2, pixels.bytes);
}

static struct image numbers(const uint32_t *values, int count) {
  struct image data = {0};
  for (int k = 0; k < count; ++k) image_big(&data, values[k], 4);
  return data;
}

TEST(test_png) {
  struct image png = png16((double[]){0.5, 0.25, 0.75}), data = numbers((uint32_t[]){50000}, 1);
  image_png_chunk(&png, "gAMA", &data);
  expect_pixel(&png, "png", (double[]){0.25, 0.0625, 0.5625}, 1e-4);
  struct image byte = {0};
  image_big(&byte, 0, 1);
  image_png_chunk(&png, "sRGB", &byte); /* counts more */
  expect_pixel(&png, "png", (double[]){srgb(0.5), srgb(0.25), srgb(0.75)}, 1e-4);
  /* Rec. 709's red as XYZ, which is linear */
  png = png16((double[]){0.4124, 0.2126, 0.0193});
  data = numbers((uint32_t[]){100000}, 1);
  image_png_chunk(&png, "gAMA", &data);
  data = numbers((uint32_t[]){33333, 33333, 100000, 0, 0, 100000, 0, 0}, 8);
  image_png_chunk(&png, "cHRM", &data);
  expect_pixel(&png, "png", (double[]){1, 0, 0}, 1e-3);
  png = png16((double[]){0, 1, 0});
  image_png_chunk(&png, "cHRM", &data);
  refused(&png, "png", "outside Rec. 709");
  data = (struct image){0};
  image_big(&data, 0x09100001, 4);
  image_png_chunk(&png, "cICP", &data);
  refused(&png, "png", "cICP");
  png = png16((double[]){0, 1, 0});
  data = numbers((uint32_t[]){1000, 2000}, 2);
  image_big(&data, 0, 1);
  image_png_chunk(&png, "pHYs", &data);
  expect_pixel(&png, "png", (double[]){0, 1, 0}, 0);
  assert_near(says.pixel_aspect, 2, 1e-6);
}

TEST(test_palettes) {
  static const unsigned char pixels[2] = {1, 0};
  struct image png = image_png(2, 1, 8, 3, pixels), palette = {0}, alpha = {0};
  image_put(&palette, "\xff\0\0\0\0\xff", 6);
  image_png_chunk(&png, "PLTE", &palette);
  expect_pixel(&png, "png", (double[]){0, 0, 1}, 0);
  assert_false(says.transparent);
  struct image clear = png;
  image_put(&alpha, "\xff\xff", 2);
  image_png_chunk(&png, "tRNS", &alpha);
  expect_pixel(&png, "png", (double[]){0, 0, 1}, 0);
  assert_false(says.transparent);
  alpha.bytes[1] = 128;
  image_png_chunk(&clear, "tRNS", &alpha);
  expect_pixel(&clear, "png", (double[]){0, 0, 1}, 0);
  assert_true(says.transparent);
  /* green and blue in a GIF of 2 x 1: 3 bits each for clear 4, 1, 0, end 5 */
  struct image gif = {0};
  image_put(&gif, "GIF89a\x02\0\x01\0\x80\0\0\0\0\xff\0\xff\0", 19);
  size_t after = gif.size;
  image_put(&gif, ",\0\0\0\0\x02\0\x01\0\0\x02\x02\x0c\x0a\0;", 16);
  expect_pixel(&gif, "gif", (double[]){0, 1, 0}, 0);
  assert_false(says.transparent);
  gif.size = after; /* the second colour is none */
  image_put(&gif, "!\xf9\x04\x01\0\0\x01\0", 8);
  image_put(&gif, ",\0\0\0\0\x02\0\x01\0\0\x02\x02\x0c\x0a\0;", 16);
  picture_free(&(struct picture){.rgb = read_colours(&gif, "gif", SLAB_IMAGE_OWN).rgb});
  assert_true(says.transparent);
}

/* The first picture is read; that there are others is told. */
TEST(several) {
  struct image gif = {0};
  image_put(&gif, "GIF89a\x02\0\x01\0\x80\0\0\0\0\xff\0\xff\0", 19);
  for (int frame = 0; frame < 2; ++frame) {
    image_put(&gif, ",\0\0\0\0\x02\0\x01\0\0\x02\x02\x0c\x0a\0", 15);
    struct image whole = {0};
    image_put(&whole, gif.bytes, gif.size);
    image_put(&whole, ";", 1);
    expect_pixel(&whole, "gif", (double[]){0, 1, 0}, 0);
    assert_int_equal(says.several, frame > 0);
  }
  for (int k = 0; k < 2; ++k) {
    struct image image = made(k ? "pages.tif" : "parts.exr",
                              "--pattern constant:color=1,0.5,0 2x2 3 --dup --siappend -d float");
    expect_pixel(&image, NULL, (double[]){1, 0.5, 0}, 0);
    assert_true(says.several);
  }
}

/* ICC profiles hold primaries under D50: those of Rec. 709 and of Display P3, red first. */
static const double rec_709[3][3] = {{0.4360747, 0.2225045, 0.0139322},
                                     {0.3850649, 0.7168786, 0.0971045},
                                     {0.1430804, 0.0606169, 0.7141733}};
static const double display_p3[3][3] = {{0.515102, 0.241182, -0.001050},
                                        {0.291965, 0.692236, 0.041882},
                                        {0.157153, 0.066581, 0.784378}};

static struct image tiff_with_profile(const void *pixel, const struct image *profile) {
  uint32_t values[1024];
  assert_true(profile->size <= 1024);
  for (size_t k = 0; k < profile->size; ++k) values[k] = profile->bytes[k];
  const struct image_field field = {34675, 1, values, profile->size};
  return image_tiff(1, 1, 3, 2, pixel, &field, 1);
}

TEST(test_profiles) {
  /* in P3's own light: Rec. 709's (0.5, 0.2, 0.1), by the matrix of both primaries and D65 */
  const double p3[3] = {0.8224621 * 0.5 + 0.1775380 * 0.2, 0.0331942 * 0.5 + 0.9668058 * 0.2,
                        0.0170827 * 0.5 + 0.0723974 * 0.2 + 0.9105199 * 0.1};
  const double roots[3] = {sqrt(p3[0]), sqrt(p3[1]), sqrt(p3[2])};
  struct image curve = image_curve_power(2), profile = image_profile(display_p3, &curve);
  struct image png = png16(roots), data = image_iccp(&profile);
  image_png_chunk(&png, "iCCP", &data);
  expect_pixel(&png, "png", (double[]){0.5, 0.2, 0.1}, 1e-3);
  /* the same in TIFF and, grey, in JPEG: 8 bits */
  unsigned char bytes[3];
  for (int c = 0; c < 3; ++c) bytes[c] = (unsigned char)lround(roots[c] * 255);
  struct image tiff = tiff_with_profile(bytes, &profile);
  expect_pixel(&tiff, "tif", (double[]){0.5, 0.2, 0.1}, 5e-3);
  curve = image_curve_table((uint16_t[]){0, 16384, 65535}, 3);
  profile = image_profile(NULL, &curve);
  made("grey.jpg", "--create 8x8 1 --fill:color=0.75 8x8 -d uint8");
  struct image segment = {0};
  image_put(&segment, "ICC_PROFILE\0\x01\x01", 14);
  image_put(&segment, profile.bytes, profile.size);
  struct image jpeg = image_jpeg(scratch("grey.jpg"), 0xffe2, &segment);
  expect_pixel(&jpeg, "jpg", (double[]){0.625, 0.625, 0.625}, 5e-3);
  /* sRGB's own changes no bit */
  curve = image_curve_srgb();
  profile = image_profile(rec_709, &curve);
  png = png16((double[]){0.9, 0.2, 0});
  struct picture plain = read_colours(&png, "png", SLAB_IMAGE_OWN);
  data = image_iccp(&profile);
  image_png_chunk(&png, "iCCP", &data);
  struct picture same = read_colours(&png, "png", SLAB_IMAGE_OWN);
  assert_memory_equal(plain.rgb, same.rgb, 3 * sizeof(float));
  picture_free(&plain);
  picture_free(&same);
  /* glTF's textures are sRGB, whatever they say */
  png = png16(roots);
  curve = image_curve_power(2);
  profile = image_profile(display_p3, &curve);
  data = image_iccp(&profile);
  image_png_chunk(&png, "iCCP", &data);
  same = read_colours(&png, "png", SLAB_IMAGE_SRGB);
  for (int c = 0; c < 3; ++c) assert_near(same.rgb[c], srgb(roots[c]), 1e-4);
  picture_free(&same);
  /* what cannot be */
  memcpy(profile.bytes + 128 + 4 + 12, "A2B0", 4);
  tiff = tiff_with_profile(bytes, &profile);
  refused(&tiff, "tif", "is made of tables");
  memcpy(profile.bytes + 16, "CMYK", 4);
  tiff = tiff_with_profile(bytes, &profile);
  refused(&tiff, "tif", "is for neither RGB nor grey");
}

/* From the published matrices of ACES (SMPTE ST 2065-1) and Rec. 709. */
TEST(test_exr_colours) {
  const double rgb[3] = {0.2, 0.6, 0.4};
  double xyz[3] = {0.4123908 * rgb[0] + 0.3575843 * rgb[1] + 0.1804808 * rgb[2],
                   0.2126390 * rgb[0] + 0.7151687 * rgb[1] + 0.0721923 * rgb[2],
                   0.0193308 * rgb[0] + 0.1191948 * rgb[1] + 0.9505322 * rgb[2]};
  double blue = xyz[2] / 1.0088251844, red = (xyz[0] - 0.0000936786 * blue) / 0.9525523959;
  double green = (xyz[1] - 0.3439664498 * red + 0.0721325464 * blue) / 0.7281660966;
  static const char *const says_so[] = {
      "--attrib:type='float[8]' chromaticities 0.7347,0.2653,0,1,0.0001,-0.077,0.32168,0.33767",
      "--attrib:type=int acesImageContainerFlag 1"};
  char words[512];
  for (int k = 0; k < 2; ++k) {
    snprintf(words, sizeof words, "--create 1x1 3 --fill:color=%.9g,%.9g,%.9g 1x1 %s -d float", red,
             green, blue, says_so[k]);
    struct image exr = made("aces.exr", words);
    expect_pixel(&exr, "exr", rgb, 1e-3);
  }
  struct image exr = made("names.exr", "--create 1x1 3 --chnames N.x,N.y,N.z -d half");
  refused(&exr, "exr", "has the channels N.x, N.y, N.z");
}

TEST(test_exr_windows) {
  /* stored: 4 x 2 from (10, 5), and more than all of it */
  struct image exr = made("part.exr", "--create 4x2+10+5 3 --fill:color=1,0.5,0 4x2+10+5 "
                                      "--fullsize 8x4+8+4 -d half");
  struct picture picture = read_colours(&exr, "exr", SLAB_IMAGE_OWN);
  assert_int_equal(picture.width, 8);
  assert_int_equal(picture.height, 4);
  for (int k = 0; k < 32; ++k) {
    bool there = k % 8 >= 2 && k % 8 < 6 && k / 8 >= 1 && k / 8 < 3;
    assert_near(picture.rgb[3 * k + 1], there ? 0.5 : 0, 0);
  }
  picture_free(&picture);
  exr = made("over.exr", "--create 6x6-2-2 3 --fill:color=1,0.5,0 1x1+1+1 --fullsize 2x2+0+0 "
                         "-d half");
  picture = read_colours(&exr, "exr", SLAB_IMAGE_OWN);
  assert_int_equal(picture.width, 2);
  for (int k = 0; k < 4; ++k) assert_near(picture.rgb[3 * k], k == 3 ? 1 : 0, 0);
  picture_free(&picture);
}

TEST(test_refused) {
  static const unsigned char pixels[8] = {0};
  struct image image = image_tiff(1, 1, 4, 5, pixels, NULL, 0);
  refused(&image, "tif", "CMYK");
  image = image_tiff(1, 1, 3, 8, pixels, NULL, 0);
  refused(&image, "tif", "Lab");
  image = (struct image){0};
  image_put(&image, "\xff\xd8\xff\xc0\0\x14\x08\0\x08\0\x08\x04", 12);
  refused(&image, "jpg", "CMYK");
  image = made("cut.jpg", "--create 64x64 3 --noise -d uint8");
  image.size /= 2;
  refused(&image, "jpg", "truncated");
  image = (struct image){0};
  image_put(&image, "RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\x20\0\0\0\0\0\0\0\0\0", 30);
  refused(&image, "webp", "profile");
  image = image_png(1, 1, 8, 0, pixels);
  struct image junk = {0};
  image_put(&junk, "any\0\0junk", 9);
  image_png_chunk(&image, "iCCP", &junk);
  refused(&image, "png", "colour profile that is damaged");
  /* a large one of few bytes */
  image = (struct image){0};
  image_put(&image, "GIF89a\xff\xff\xff\xff\0\0\0;", 14);
  refused(&image, "gif", "more than 2^27 pixels");
  image = image_png(1, 1, 8, 0, pixels);
  memcpy(image.bytes + 16, "\0\0\xff\xff\0\0\xff\xff\x08\0\0\0\0\x93\xb5\x5b\x76", 17);
  refused(&image, "png", "is no image that can be read");
}

int main(void) {
  return testing_run(NULL, NULL);
}
