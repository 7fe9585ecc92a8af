/* test_stability.c - hard cases of the includes in POV-Ray: sizes, places, gains and ranges
 * of radiance at the limits of its numbers, its switches, many lamps in each other's light.
 * Each is right, against the direct sum or itself in easy conditions, or refused. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"

/* The picture's own half floats cost 2e-4. */
static const double tolerance = 5e-4;

static const int samples[4] = {3, 3, 10, 10};
static const double edges[2] = {1, 0.8}, window[4] = {-1, 1, -1, 1};

static struct slab make_slab(double st_distance, uint64_t seed) {
  return chain_slab(samples, edges, window, st_distance, 0, seed);
}

/* The plane two apertures from the lamp, under the lights of `sdl`. */
static void render(const struct chain_lamp *lamp, const char *sdl, struct picture *picture) {
  struct chain_plane plane = chain_facing(lamp, 0, 2);
  chain_scene(&plane, 1, sdl);
  chain_render(picture);
}

/* The same, with a pigment that undoes a gain, against the direct sum. */
static void expect_within(double most, const char *what, const struct chain_lamp *lamps, int count,
                          double pigment, const char *sdl) {
  struct chain_plane plane = chain_facing(&lamps[0], 0, 2);
  double rmse = chain_error(lamps, count, &plane, pigment, sdl);
  print_message("# %-40s %.2g\n", what, rmse);
  if (!(rmse <= most)) fail_msg("%s: relative RMSE %g", what, rmse);
}

static void expect_sum(const char *what, const struct chain_lamp *lamp, double pigment,
                       const char *sdl) {
  expect_within(tolerance, what, lamp, 1, pigment, sdl);
}

/* From the edge of the shadow tolerance, 0.0011 of a sheet's height, to huge units. */
TEST(test_scales) {
  static const double scales[] = {1.001, 2.1, 1e6, 5e10};
  for (int d = 0; d < 2; ++d) {
    struct slab slab = make_slab(d ? 2 : INFINITY, 3);
    double pitch = edges[1] / samples[1];
    double height = pitch / (0.2 * (samples[3] + 2) + (d ? pitch / 2 : 0));
    chain_include(&slab, 1, "lamp", "");
    for (size_t k = 0; k < sizeof scales / sizeof *scales; ++k) {
      struct chain_lamp lamp = chain_lamp_of(&slab, 1, scales[k] * 0.0011 / height);
      char what[64];
      snprintf(what, sizeof what, "sheet%s, %g times the least Scale", d ? ", st plane" : "",
               scales[k]);
      expect_sum(what, &lamp, 1, chain_placed(&lamp, 1));
    }
    slab_free(&slab);
  }
}

/* Thousands of widths off the origin, where single precision knows 1/4000 of a width. */
TEST(test_far_off) {
  const int many[4] = {12, 12, 10, 10};
  struct slab slab = chain_slab(many, edges, window, INFINITY, 0, 3);
  chain_include(&slab, 1, "lamp", "");
  for (int small = 0; small < 2; ++small) {
    struct chain_lamp lamp = chain_lamp_of(&slab, 1, small ? 0.1 : 1);
    const double at[3] = {-0.4, 0.3, 0.866};
    for (int c = 0; c < 3; ++c) lamp.matrix[9 + c] = 3000 * lamp.scale * at[c];
    expect_sum(small ? "3000 widths of 0.1 off" : "3000 widths off", &lamp, 1,
               chain_placed(&lamp, 1));
  }
  slab_free(&slab);
}

/* A cluster or a point of any size gives the same picture of a plane as many times its size. */
TEST(test_other_kinds) {
  static const char *const kinds[] = {"--mode cluster --lights 2", "--mode point"};
  static const double scales[] = {0.0042, 1e6, 1e9};
  struct slab slab = make_slab(INFINITY, 4);
  for (int kind = 0; kind < 2; ++kind) {
    struct picture plain, picture;
    struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
    double right[3 * CHAIN_PIXELS];
    chain_include(&slab, 1, "lamp", kinds[kind]);
    render(&lamp, chain_placed(&lamp, 1), &plain);
    for (int k = 0; k < 3 * CHAIN_PIXELS; ++k) right[k] = (double)plain.rgb[k];
    for (int n = 0; n < 3; ++n) {
      lamp.scale = scales[n];
      render(&lamp, chain_placed(&lamp, 1), &picture);
      double rmse = chain_rmse(&picture, right);
      print_message("# %-32s %7g %.2g\n", kinds[kind], scales[n], rmse);
      assert_true(rmse <= tolerance);
      picture_free(&picture);
    }
    picture_free(&plain);
  }
  slab_free(&slab);
}

/* Light colours end near 1e38, and light below 1e-10 is dropped. */
TEST(test_gains) {
  static const char *const kinds[] = {"", "--mode cluster --lights 2", "--mode point"};
  struct slab slab = make_slab(INFINITY, 5);
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
  char sdl[256];
  for (int kind = 0; kind < 3; ++kind) {
    chain_include(&slab, 1, "lamp", kinds[kind]);
    chain_says(&slab, CHAIN_LIT("1, 1e33"), 1,
               "Test_Lamp_Canned: too bright for POV-Ray's light colours");
    chain_says(&slab, CHAIN_LIT("1, rgb <0, 1e33, 0>"), 1,
               "Test_Lamp_Canned: too bright for POV-Ray's light colours");
    chain_says(&slab, CHAIN_LIT("1, 1e-9"), 1, "apertures, where POV-Ray drops its light: use");
  }
  chain_include(&slab, 1, "lamp", "");
  static const double gains[] = {1e30, 1e4, 1e-3, -3};
  for (size_t k = 0; k < sizeof gains / sizeof *gains; ++k) {
    snprintf(sdl, sizeof sdl, "#include \"lamp.inc\"\nobject { Test_Lamp_Canned(1, %g) }",
             gains[k]);
    expect_sum("Gain", &lamp, 1 / gains[k], sdl);
  }
  chain_says(&slab, CHAIN_LIT("1, 1e-5"), 0, "Parse Warning: Test_Lamp_Canned: too faint beyond 5");
  chain_says(&slab, CHAIN_LIT("1, 0"), 0, "");
  assert_null(strstr(chain_log(), "faint"));
  slab_free(&slab);
}

/* A sheet is an image of half floats, which end at 65504 and 6e-8: it holds shares of the
 * peak. Samples over 30 decades; one bright sample among faint ones. */
TEST(test_ranges) {
  struct slab slab = make_slab(INFINITY, 6);
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
  uint64_t seed = 9;
  size_t values = 3 * slab_sample_count(&slab);
  for (size_t k = 0; k < values; ++k) slab.rgb[k] = (float)random_log(&seed, 1e-5, 1e25);
  chain_include(&slab, 1, "lamp", "");
  const char *sdl = chain_placed(&lamp, 1);
  lamp.gain = 1e-20;
  expect_sum("30 decades", &lamp, 1e-20, sdl);
  for (size_t k = 0; k < values; ++k) slab.rgb[k] = (float)random_between(&seed, 1, 2);
  oracle_sample(&slab, 1, 1, 4, 5)[1] = 1e5F;
  chain_include(&slab, 1, "lamp", "");
  lamp.gain = 1;
  expect_sum("a peak beyond half floats", &lamp, 1, chain_placed(&lamp, 1));
  slab_free(&slab);
}

/* Pictures under each switch against those without: bit for bit, but for antialiasing, which
 * sees more of each pixel and leaves the mean alone. Below +Q4 POV-Ray leaves out
 * shadows; the headers say so. */
TEST(test_switches) {
  static const char *const kinds[] = {"", "--mode point", "--mode cluster --lights 2"};
  static const char *const switches[] = {"+Q4",        "+Q5",           "+Q11",
                                         "+A0.01 +R3", "+A0.1 +AM2 -J", "+WT2 -MB"};
  struct slab slab = make_slab(INFINITY, 7);
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
  for (int kind = 0; kind < 3; ++kind) {
    struct picture plain, picture;
    struct error error;
    chain_include(&slab, 1, "lamp", kinds[kind]);
    render(&lamp, chain_placed(&lamp, 1), &plain);
    for (size_t k = 0; k < sizeof switches / sizeof *switches; ++k) {
      double sum = 0, right = 0;
      chain_must("povray +Iscene.pov +Oframe.exr +FE -A -D +W%d +H%d %s", CHAIN_SIZE, CHAIN_SIZE,
                 switches[k]);
      assert_int_equal(slab_exr_read(chain_path("frame.exr"), &picture, &error), RESULT_OK);
      if (!strstr(switches[k], "+A"))
        assert_memory_equal(picture.rgb, plain.rgb, sizeof(float) * 3 * CHAIN_PIXELS);
      for (int n = 0; n < 3 * CHAIN_PIXELS; ++n) {
        sum += (double)picture.rgb[n];
        right += (double)plain.rgb[n];
      }
      if (!(fabs(sum / right - 1) < 3e-3)) fail_msg("%s: %g, not %g", switches[k], sum, right);
      picture_free(&picture);
    }
    picture_free(&plain);
  }
  slab_free(&slab);
}

/* Twenty lamps that shine at each other and at the plane: each shades the others by its
 * case, and no sheet filters another's light. */
TEST(test_twenty) {
  enum { LAMPS = 20 };
  const int few[4] = {2, 2, 8, 8};
  const double square[2] = {1, 1};
  struct slab slab = chain_slab(few, square, window, INFINITY, 0, 8);
  double height = (1.0 / 2) / (2.0 / 8 * (8 + 2)); /* tiles of 10 x 10 texels meet there */
  struct chain_lamp lamps[LAMPS];
  uint64_t seed = 4;
  for (int n = 0; n < LAMPS; ++n) {
    lamps[n] = chain_lamp_of(&slab, 1, 0.3);
    lamps[n].case_height = height;
    if (n == 0) {
      lamps[n].scale = 1;
      continue;
    }
    /* Turned, in a box before the first lamp. */
    double turned[3][3], nearest;
    random_frame(&seed, 1, turned);
    memcpy(lamps[n].matrix, turned, sizeof turned);
    do {
      double place[3] = {random_between(&seed, -1.2, 1.2), random_between(&seed, -1.2, 1.2),
                         random_between(&seed, 0.5, 1.5)};
      for (int c = 0; c < 3; ++c)
        lamps[n].matrix[9 + c] = slab.center[c] + place[0] * slab.u[c] + place[1] * slab.v[c] +
                                 place[2] * slab.normal[c];
      nearest = 1;
      for (int m = 1; m < n; ++m) {
        double apart[3];
        for (int c = 0; c < 3; ++c) apart[c] = lamps[n].matrix[9 + c] - lamps[m].matrix[9 + c];
        nearest = fmin(nearest, chain_length(apart));
      }
    } while (nearest < 0.55); /* cases do not meet */
  }
  chain_include(&slab, 1, "lamp", "");
  expect_within(3e-3, "twenty lamps", lamps, LAMPS, 1,
                chain_placed(lamps, LAMPS)); /* pixels on hard edges */
  slab_free(&slab);
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
