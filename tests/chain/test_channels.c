/* test_channels.c - groups of bulbs with gains of their own, through POV-Ray's includes: pages that
 * share an aperture against direct sums, and how linear gains are. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "chain.h"

/* The picture's own half floats cost 2e-4. */
static const double tolerance = 5e-4;

enum { PAGES = 4 };
static const char *const names[PAGES] = {"warm", "cold", "warm", ""};

/* Warm and cold through one aperture; warm, and light of no channel, through another beside it. */
static void make_pages(int most, struct slab *pages) {
  static const int samples[4] = {3, 2, 8, 9};
  static const double edges[2] = {1, 1}, window[4] = {-1.5, 1.2, -1.4, 1.5};
  for (int n = 0; n < most; ++n) {
    pages[n] = chain_slab(samples, edges, window, INFINITY, 0, 7);
    uint64_t seed = 40 + (uint64_t)n;
    chain_fill(&pages[n], &seed);
    for (int c = 0; c < 3 && n >= 2; ++c) pages[n].center[c] += 1.5 * pages[0].u[c];
    strcpy(pages[n].channel, names[n]);
  }
}

static void multiply(struct slab *page, double gain) {
  for (size_t k = 0; k < 3 * slab_sample_count(page); ++k) page->rgb[k] *= (float)gain;
}

/* What the include of all pages shows with these gains is the sum over pages so much brighter. */
static void compare(const char *options, const double gains[2], bool before) {
  struct slab pages[PAGES], means[PAGES];
  int side = *options ? 2 : 0;
  char sdl[512];
  make_pages(PAGES, pages);
  chain_include(pages, PAGES, "lamp", options);
  for (int n = 0; n < PAGES; ++n) {
    means[n] = chain_means(&pages[n], side ? side : 3, side ? side : 2);
    multiply(&means[n], n == 3 ? 1 : gains[n == 1]);
  }
  struct chain_lamp lamp = chain_lamp_of(means, PAGES, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 2);
  snprintf(sdl, sizeof sdl,
           before ? "#declare Test_Lamp_Gain_Warm = %g;\n"
                    "#declare Test_Lamp_Gain_Cold = %g;\n%s"
                  : "#include \"lamp.inc\"\n"
                    "Test_Lamp_Canned_Channel(\"warm\", %g)\n"
                    "Test_Lamp_Canned_Channel(\"cold\", %g)\n%s",
           gains[0], gains[1], CHAIN_LIT("1, 1"));
  double error = chain_error(&lamp, 1, &plane, 1, sdl);
  print_message("%g, %g %s: %.2g\n", gains[0], gains[1], options, error);
  if (!(error <= tolerance)) fail_msg("gains %g, %g: relative RMSE %g", gains[0], gains[1], error);
  for (int n = 0; n < PAGES; ++n) slab_free(&pages[n]), slab_free(&means[n]);
}

TEST(test_sheets) {
  compare("", (const double[]){0.25, 3}, true);
  compare("--lights 2", (const double[]){2, 0}, false);
}

/* ---- Linear ---- */

static void render(const struct chain_plane *plane, double warm, double cold,
                   struct picture *picture) {
  char sdl[512];
  snprintf(sdl, sizeof sdl,
           "#declare Test_Lamp_Gain_Warm = %.17g;\n#declare Test_Lamp_Gain_Cold = %.17g;\n%s", warm,
           cold, CHAIN_LIT("1, 0.02"));
  chain_scene(plane, 1, sdl);
  chain_render(picture);
}

/* Half floats round each value by 1e-4, the mean of all by 2e-6: what is left of a picture is its
 * gains times the pictures of each channel. */
static void expect_linear(const char *options) {
  static const double gains[2] = {0.3, 1.7};
  struct slab pages[2];
  struct picture pictures[3];
  double sums[2] = {0, 0}, worst = 0;
  make_pages(2, pages);
  chain_include(pages, 2, "lamp", options);
  struct chain_lamp lamp = chain_lamp_of(pages, 2, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 2);
  render(&plane, 1, 0, &pictures[0]);
  render(&plane, 0, 1, &pictures[1]);
  render(&plane, gains[0], gains[1], &pictures[2]);
  for (int k = 0; k < 3 * CHAIN_PIXELS; ++k) {
    double both = (double)pictures[2].rgb[k], parts = 0;
    for (int n = 0; n < 2; ++n) parts += gains[n] * (double)pictures[n].rgb[k];
    sums[0] += both;
    sums[1] += parts;
    worst = fmax(worst, fabs(both - parts) / fmax(parts, 1e-2));
  }
  print_message("%s: mean %.2g, worst %.2g\n", options, sums[0] / sums[1] - 1, worst);
  assert_true(fabs(sums[0] / sums[1] - 1) <= 1e-5);
  assert_true(worst <= 1e-3);
  for (int n = 0; n < 3; ++n) picture_free(&pictures[n]);
  for (int n = 0; n < 2; ++n) slab_free(&pages[n]);
}

TEST(test_gains_are_linear) {
  expect_linear("--mode sheet");
  expect_linear("--mode cluster --lights 2");
  expect_linear("--mode point");
}

/* ---- The far field of channels, and of one slab that holds their sum ---- */

TEST(test_far_field) {
  static const double gains[2] = {0.3, 1.7};
  struct slab pages[2];
  struct picture parts, whole;
  make_pages(2, pages);
  chain_include(pages, 2, "lamp", "--mode point");
  struct chain_lamp lamp = chain_lamp_of(pages, 2, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 2);
  render(&plane, gains[0], gains[1], &parts);
  for (size_t k = 0; k < 3 * slab_sample_count(&pages[0]); ++k)
    pages[0].rgb[k] =
        (float)(gains[0] * (double)pages[0].rgb[k] + gains[1] * (double)pages[1].rgb[k]);
  *pages[0].channel = '\0';
  chain_include(pages, 1, "lamp", "--mode point");
  render(&plane, 1, 1, &whole);
  double worst = 0;
  for (int k = 0; k < 3 * CHAIN_PIXELS; ++k) {
    double wanted = (double)whole.rgb[k];
    worst = fmax(worst, fabs((double)parts.rgb[k] - wanted) / fmax(wanted, 1e-2));
  }
  print_message("far field, parts and whole: worst %.2g\n", worst);
  assert_true(worst <= 2e-3); /* three roundings to half floats */
  picture_free(&parts), picture_free(&whole);
  for (int n = 0; n < 2; ++n) slab_free(&pages[n]);
}

/* ---- Refused ---- */

TEST(test_refusals) {
  static const struct {
    const char *options, *before, *says;
  } cases[] = {{"", "Test_Lamp_Canned_Channel(\"wram\", 1)",
                "Test_Lamp_Canned_Channel: it has no channel \"wram\", but warm, cold"},
               {"", "#declare Test_Lamp_Gain_Cold = -1;",
                "Test_Lamp_Canned: the gain of a channel is -1.0000, must be 0 or more"},
               {"--mode point", "Test_Lamp_Canned_Channel(\"wram\", 1)",
                "Test_Lamp_Canned_Channel: it has no channel \"wram\", but warm, cold"}};
  struct slab pages[2];
  char sdl[512];
  make_pages(2, pages);
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    if (k != 1) chain_include(pages, 2, "lamp", cases[k].options); /* else it is there */
    snprintf(sdl, sizeof sdl, "#include \"lamp.inc\"\n%s\n%s", cases[k].before, CHAIN_LIT("1, 1"));
    chain_says(pages, sdl, 1, cases[k].says);
  }
  for (int n = 0; n < 2; ++n) slab_free(&pages[n]);
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
