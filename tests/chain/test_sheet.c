/* test_sheet.c - POV-Ray lit through the include of a slab against the direct
 * sum over the slab, wherever the include promises to be exact. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"

/* The picture's own half floats cost 2e-4. */
static const double tolerance = 5e-4;

/* A picture of one lamp: what to make, where to put it, where to look. */
struct setting {
  const char *what;
  int samples[4];
  double edges[2];
  double window[4];
  double st_distance;
  int mirrored;
  double scale, gain;
  double distance; /* of the receiving plane, in aperture widths */
};

#define SQUARE                                                                                     \
  { 1, 1 }
#define WIDE                                                                                       \
  { -1.5, 1.5, -1.5, 1.5 }

static const struct setting settings[] = {
    {"1x1 near", {1, 1, 16, 16}, SQUARE, WIDE, INFINITY, 0, 1, 1, 0.5},
    {"1x1 far", {1, 1, 16, 16}, SQUARE, WIDE, INFINITY, 0, 1, 1, 6},
    {"3x2, columns", {3, 2, 9, 7}, SQUARE, WIDE, INFINITY, 0, 1, 1, 1},
    {"2x3, rows", {2, 3, 9, 7}, SQUARE, WIDE, INFINITY, 0, 1, 1, 1},
    {"4x4 near", {4, 4, 16, 16}, SQUARE, WIDE, INFINITY, 0, 1, 1, 0.5},
    {"4x4 far", {4, 4, 16, 16}, SQUARE, WIDE, INFINITY, 0, 1, 1, 6},
    {"8x8 near", {8, 8, 12, 12}, SQUARE, WIDE, INFINITY, 0, 1, 1, 0.5},
    {"8x8 far", {8, 8, 12, 12}, SQUARE, WIDE, INFINITY, 0, 1, 1, 6},
    {"16x16 near", {16, 16, 16, 16}, SQUARE, WIDE, INFINITY, 0, 1, 1, 0.5},
    {"16x16 far", {16, 16, 16, 16}, SQUARE, WIDE, INFINITY, 0, 1, 1, 6},
    {"scale 0.3, gain 2.5", {4, 4, 16, 16}, SQUARE, WIDE, INFINITY, 0, 0.3, 2.5, 2},
    {"scale 3, gain 0.1", {4, 4, 16, 16}, SQUARE, WIDE, INFINITY, 0, 3, 0.1, 2},
    {"u x v = -n", {4, 4, 16, 16}, SQUARE, WIDE, INFINITY, 1, 1, 1, 2},
    {"st plane at 1.5", {8, 8, 12, 12}, SQUARE, {-1, 1, -1, 1}, 1.5, 0, 1, 1, 1},
    {"st plane at 1.5, beyond", {4, 4, 16, 16}, SQUARE, {-1, 1, -1, 1}, 1.5, 0, 1, 1, 6},
    {"st plane at 1.5, scale 0.3", {4, 4, 16, 16}, SQUARE, {-1, 1, -1, 1}, 1.5, 1, 0.3, 1, 2},
    {"rectangle", {4, 4, 12, 12}, {1, 0.4}, WIDE, INFINITY, 0, 1, 1, 1},
    {"rectangle upright, st plane", {5, 3, 9, 14}, {0.5, 1.2}, WIDE, 4, 1, 1, 1, 1},
    {"window off centre", {4, 4, 10, 10}, SQUARE, {0.5, 2.5, -2, -0.2}, INFINITY, 0, 1, 1, 2},
    {"window off centre, st plane", {4, 3, 10, 8}, SQUARE, {0.2, 1, -3, 0.4}, 2, 0, 1, 1, 2},
    {"row of lights", {6, 1, 8, 8}, {1, 0.1}, WIDE, INFINITY, 0, 1, 1, 1},
    {"1-wide s and t", {3, 4, 1, 1}, SQUARE, {-0.5, 0.5, -1, 1}, INFINITY, 0, 1, 1, 1},
    {"1-wide s", {2, 2, 1, 12}, SQUARE, WIDE, 3, 0, 1, 1, 1},
};

/* Renders the lamps onto the plane and holds the picture against the sum. */
static void compare(const char *what, const struct chain_lamp *lamps, int count,
                    const struct chain_plane *plane, const char *sdl) {
  double rmse = chain_error(lamps, count, plane, 1, sdl);
  print_message("%-32s %.2g\n", what, rmse);
  if (!(rmse <= tolerance)) fail_msg("%s: relative RMSE %g", what, rmse);
}

static void compare_setting(const struct setting *setting, uint64_t seed) {
  struct slab slab = chain_slab(setting->samples, setting->edges, setting->window,
                                setting->st_distance, setting->mirrored, seed);
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, setting->scale);
  lamp.gain = setting->gain;
  struct chain_plane plane = chain_facing(&lamp, 0, setting->distance);
  chain_include(&slab, 1, "lamp", "");
  compare(setting->what, &lamp, 1, &plane, chain_placed(&lamp, 1));
  slab_free(&slab);
}

TEST(test_settings) {
  for (size_t k = 0; k < sizeof settings / sizeof *settings; ++k)
    compare_setting(&settings[k], 100 + k);
}

static const int small_samples[4] = {4, 3, 12, 14};
static const double small_edges[2] = {1, 0.7}, small_window[4] = {-1.2, 1, -0.8, 1.4};

static struct slab small_slab(double st_distance, uint64_t seed) {
  return chain_slab(small_samples, small_edges, small_window, st_distance, 0, seed);
}

/* Lamps placed with POV-Ray's own words, which the test spells as a matrix. */
TEST(test_words) {
  struct slab slab = small_slab(INFINITY, 1);
  double c = cos(M_PI / 6), s = sin(M_PI / 6);
  const struct {
    const char *what, *words;
    double matrix[12];
  } cases[] = {
      {"rotate x*30 translate",
       "rotate x*30 translate <1, 2, 3>",
       {1, 0, 0, 0, c, s, 0, -s, c, 1, 2, 3}},
      {"rotate y*30", "rotate y*30", {c, 0, -s, 0, 1, 0, s, 0, c, 0, 0, 0}},
      {"rotate z*30", "rotate z*30", {c, s, 0, -s, c, 0, 0, 0, 1, 0, 0, 0}},
      {"mirrored", "scale <-1, 1, 1> translate y", {-1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0}},
  };
  chain_include(&slab, 1, "lamp", "");
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
    memcpy(lamp.matrix, cases[k].matrix, sizeof lamp.matrix);
    struct chain_plane plane = chain_facing(&lamp, 0, 1.5);
    char sdl[256];
    snprintf(sdl, sizeof sdl, "#include \"lamp.inc\"\nobject { Test_Lamp_Canned(1, 1) %s }\n",
             cases[k].words);
    compare(cases[k].what, &lamp, 1, &plane, sdl);
  }
  slab_free(&slab);
}

/* Two lamps side by side, also as copies of one declared object. */
TEST(test_instances) {
  struct slab slab = small_slab(2, 2);
  struct chain_lamp lamps[2] = {chain_lamp_of(&slab, 1, 1), chain_lamp_of(&slab, 1, 1)};
  lamps[1].gain = 0.5;
  for (int c = 0; c < 3; ++c) lamps[1].matrix[9 + c] = 1.1 * slab.u[c] + 0.4 * slab.v[c];
  struct chain_plane plane = chain_facing(&lamps[0], 0, 1);
  char sdl[2048];
  chain_include(&slab, 1, "lamp", "");
  compare("two instances", lamps, 2, &plane, chain_placed(lamps, 2));
  snprintf(sdl, sizeof sdl,
           "#include \"lamp.inc\"\n#declare Lamp = object { Test_Lamp_Canned(1, 1) }\n"
           "object { Lamp } object { Lamp translate <%.17g, %.17g, %.17g> }\n",
           lamps[1].matrix[9], lamps[1].matrix[10], lamps[1].matrix[11]);
  lamps[1].gain = 1;
  compare("two of one declared object", lamps, 2, &plane, sdl);
  slab_free(&slab);
}

/* A lamp behind another, then one that looks into its side: the front lamp's
 * case, not its sheet, is what their light meets. */
TEST(test_case) {
  const int samples[4] = {3, 3, 8, 8};
  const double edges[2] = {1, 1}, window[4] = {-1, 1, -1, 1};
  struct slab slab = chain_slab(samples, edges, window, INFINITY, 0, 8);
  double height = (1.0 / 3) / (2.0 / 8 * (8 + 2)); /* tiles of 10 x 10 texels meet there */
  struct chain_lamp lamps[2] = {chain_lamp_of(&slab, 1, 1), chain_lamp_of(&slab, 1, 1)};
  lamps[0].case_height = height;
  const double away[2][3] = {{0.1, 0.2, -0.8}, {1.2, 0.1, -0.3}};
  struct chain_plane plane = chain_facing(&lamps[0], 0, 1);
  chain_include(&slab, 1, "lamp", "");
  for (int k = 0; k < 2; ++k) {
    for (int c = 0; c < 3; ++c)
      lamps[1].matrix[9 + c] =
          away[k][0] * slab.u[c] + away[k][1] * slab.v[c] + away[k][2] * slab.normal[c];
    compare(k ? "a lamp beside and behind" : "a lamp behind", lamps, 2, &plane,
            chain_placed(lamps, 2));
  }
  slab_free(&slab);
}

/* Two pages of one lamp in one aperture plane, back to back, then side by side. */
TEST(test_pages) {
  struct slab pages[2] = {small_slab(INFINITY, 3), small_slab(3, 4)};
  struct chain_lamp lamp = chain_lamp_of(pages, 2, 0.8);
  for (int c = 0; c < 3; ++c) {
    pages[1].center[c] = pages[0].center[c];
    pages[1].u[c] = pages[0].u[c];
    pages[1].v[c] = pages[0].v[c];
    pages[1].normal[c] = -pages[0].normal[c];
  }
  chain_include(pages, 2, "lamp", "");
  for (int page = 0; page < 2; ++page) {
    struct chain_plane plane = chain_facing(&lamp, page, 1);
    compare(page ? "back to back, back" : "back to back, front", &lamp, 1, &plane,
            chain_placed(&lamp, 1));
  }
  for (int c = 0; c < 3; ++c) {
    pages[1].center[c] += pages[0].u[c];
    pages[1].normal[c] = pages[0].normal[c];
  }
  chain_include(pages, 2, "lamp", "");
  struct chain_plane plane = chain_facing(&lamp, 0, 2);
  compare("side by side", &lamp, 1, &plane, chain_placed(&lamp, 1));
  slab_free(&pages[0]);
  slab_free(&pages[1]);
}

/* Fewer lights, asked for in the scene or on the command line. */
TEST(test_lights) {
  const struct {
    const char *what, *options, *declare;
    int lights[2];
  } cases[] = {
      {"Lights = 4 of 7x5", "", "#declare Test_Lamp_Lights = 4;\n", {4, 3}},
      {"Lights = 3 of 7x5", "", "#declare Test_Lamp_Lights = 3;\n", {2, 2}},
      {"Lights = 1 of 7x5", "", "#declare Test_Lamp_Lights = 1;\n", {1, 1}},
      {"--lights 3 of 7x5", "--lights 3", "", {3, 3}},
  };
  const int samples[4] = {7, 5, 8, 10};
  struct slab slab = chain_slab(samples, small_edges, small_window, 2, 0, 5);
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    struct slab means = chain_means(&slab, cases[k].lights[0], cases[k].lights[1]);
    struct chain_lamp lamp = chain_lamp_of(&means, 1, 1);
    struct chain_plane plane = chain_facing(&lamp, 0, 1);
    char sdl[1024];
    snprintf(sdl, sizeof sdl, "%s%s", cases[k].declare, chain_placed(&lamp, 1));
    chain_include(&slab, 1, "lamp", cases[k].options);
    compare(cases[k].what, &lamp, 1, &plane, sdl);
    slab_free(&means);
  }
  slab_free(&slab);
}

/* Views without any light have no lights, and nothing else changes. */
TEST(test_black_views) {
  struct slab slab = small_slab(INFINITY, 6);
  for (int j = 0; j < slab.samples[1]; ++j)
    for (int i = j == 1 ? 0 : 2; i < slab.samples[0]; ++i)
      for (int l = 0; l < slab.samples[3]; ++l)
        for (int k = 0; k < slab.samples[2]; ++k)
          memset(oracle_sample(&slab, i, j, k, l), 0, 3 * sizeof(float));
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 1);
  chain_include(&slab, 1, "lamp", "");
  chain_must("grep -q '4x3 *4 of 12' lamp.inc");
  compare("black views", &lamp, 1, &plane, chain_placed(&lamp, 1));
  slab_free(&slab);
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
