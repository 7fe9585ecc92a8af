/* test_gain.c - lamps far brighter and far darker than half floats can hold: POV-Ray
 * renders them through a gain that the slab undoes, once, wherever light passes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bakes.h"

static const struct bakes_frame front = {
    {0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 1}, {-1, 1.2, -0.8, 0.8}, 0};
/* Opposite to it: light passes one slab and then the other. */
static const struct bakes_frame back = {{0, 0, -1}, {2, 0, 0},          {0, 3, 0},
                                        {0, 0, -1}, {-1, 1, -0.8, 0.7}, 4};
static const struct bakes_frame mirrored_back = {{0, 0, -1}, {-2, 0, 0},         {0, 3, 0},
                                                 {0, 0, -1}, {-1, 1, -0.8, 0.7}, 4};
static const struct bakes_frame small = {{0, 0, 0}, {0.2, 0, 0},          {0, 0.3, 0},
                                         {0, 0, 1}, {-1, 1.2, -0.8, 0.8}, 0};
/* The glowing sheet is beyond the slab on the other side. */
static const double behind = 1.5;

static const struct setting {
  const char *name;
  const struct bakes_frame *frames[2];
  double radiance;
  const char *options;
  double gain;
} settings[] = {
    {"bright", {&front, NULL}, 1e7, "", 0},
    {"bright-given", {&front, NULL}, 1e7, "--gain 2^-12", 0x1p-12},
    {"dark", {&front, NULL}, 1e-6, "", 0},
    {"dark-given", {&front, NULL}, 1e-6, "--gain 1048576", 0x1p20},
    {"open", {&front, &back}, 3e6, "", 0},
    {"open-mirrored", {&front, &mirrored_back}, 1e-5, "", 0},
    {"open-perspective", {&front, &mirrored_back}, 3e6, "--camera perspective", 0},
    {"transposed", {&front, NULL}, 1e7, "--camera transposed", 0},
    {"small", {&small, NULL}, 1e6, "", 0},
    {"plain", {&front, NULL}, 1, "--gain 1", 1},
};
enum { SETTINGS = sizeof settings / sizeof *settings };

static int bake_all(void **state) {
  if (bakes_setup(state)) return -1;
  char output[64], rest[32], options[160];
  for (int n = 0; n < SETTINGS; ++n) {
    const struct setting *setting = &settings[n];
    const char *name = setting->name;
    bakes_lamp(name);
    for (int page = 0; page < 2 && setting->frames[page]; ++page) {
      bakes_lamp_slab(name, setting->frames[page]);
      snprintf(rest, sizeof rest, "%g, %.17g", behind, setting->radiance);
      bakes_lamp_macro(name, "Slope", setting->frames[page], rest);
    }
    snprintf(output, sizeof output, "%s.exr", name);
    snprintf(options, sizeof options, "--uv 2x3 --st 4x3 --rays 2 %s", setting->options);
    bakes_start(name, output, options);
  }
  bakes_lamp("negative");
  bakes_lamp_slab("negative", &front);
  bakes_lamp_add("negative", "sphere { 0, 1000 hollow pigment { rgb <-0.25, 0.5, 2000000> }\n"
                             "  finish { emission 1 diffuse 0 } }\n");
  bakes_start("negative", "negative.exr", "--uv 2 --st 3 --rays 2");
  /* Brighter through a chink that a probe misses: 4 of 65504/8 and more. */
  bakes_lamp("chink");
  bakes_lamp_slab("chink", &front);
  bakes_lamp_macro("chink", "Pane", &front, "1, -0.1, 0.1, -0.1, 0.1, 30000");
  bakes_start("chink", "chink.exr", "--uv 2x3 --st 30x20 --rays 4");
  bakes_wait();
  return 0;
}

/* Largest error of the samples relative to the peak. */
static double page_error(const char *output, int page, const struct setting *setting) {
  struct slab slab = bakes_load(output, page);
  const struct bakes_frame *frame = setting->frames[page];
  double worst = 0, peak = 0, gain = bakes_provenance(&slab, "gain", NULL);
  if (setting->gain > 0) assert_true(gain == setting->gain);
  double bright = setting->radiance * gain;
  assert_true(bright > 0.1 && bright < 65504);
  for (size_t p = 0; p < slab_sample_count(&slab); ++p) {
    int at[SLAB_AXES];
    double abst[4], expected[3];
    bakes_sample(&slab, p, at, abst);
    bakes_slope(frame, behind, abst, expected);
    for (size_t c = 0; c < 3; ++c) {
      expected[c] *= setting->radiance;
      worst = larger(worst, fabs((double)slab.rgb[3 * p + c] - expected[c]));
      peak = fmax(peak, expected[c]);
    }
  }
  slab_free(&slab);
  print_message("# %-16s page %d: gain 2^%g, %.2g of the peak\n", setting->name, page + 1,
                log2(gain), worst / peak);
  return worst / peak;
}

TEST(test_ranges) {
  int bad = 0;
  for (int n = 0; n < SETTINGS; ++n)
    for (int page = 0; page < 2 && settings[n].frames[page]; ++page) {
      char output[64];
      snprintf(output, sizeof output, "%s.exr", settings[n].name);
      bad += !(page_error(output, page, &settings[n]) <= 0.002);
    }
  assert_int_equal(bad, 0);
}

/* Hand-made lights may be negative. */
TEST(test_negative) {
  struct slab slab = bakes_load("negative.exr", 0);
  static const double expected[3] = {-0.25, 0.5, 2000000};
  for (size_t n = 0; n < slab_sample_count(&slab); ++n)
    for (int c = 0; c < 3; ++c)
      assert_true(fabs((double)slab.rgb[3 * n + (size_t)c] / expected[c] - 1) < 0.002);
  slab_free(&slab);
}

/* The probe sees a few thousand rays; what it misses must still fit. */
TEST(test_chink) {
  struct slab slab = bakes_load("chink.exr", 0);
  double peak = 0;
  for (size_t n = 0; n < 3 * slab_sample_count(&slab); ++n) peak = fmax(peak, (double)slab.rgb[n]);
  assert_true(peak > 7000 && peak < 30030);
  slab_free(&slab);
}

int main(void) {
  return testing_run(bake_all, bakes_teardown);
}
