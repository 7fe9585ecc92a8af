/* test_scene.c - lamps of each kind of include among what scenes hold: no_shadow, light groups,
 * photons, radiosity, other lights, every assumed_gamma. Each picture is the one that the lamp
 * alone makes, which other tests hold against sums, or what the include's Limits say. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "chain.h"

static const char *const kinds[] = {"", "--mode cluster --lights 2", "--mode point"};
enum { SHEET, CLUSTER, POINT, KINDS };
static const double exact = 5e-4;

/* The lamp before a plane, and what the plane shows without anything else. */
struct stage {
  struct slab slab;
  struct chain_lamp lamp;
  struct chain_plane plane;
  struct picture alone;
  double mean;
};

static double mean_of(const struct picture *picture) {
  double sum = 0;
  for (int k = 0; k < 3 * CHAIN_PIXELS; ++k) sum += (double)picture->rgb[k];
  return sum / (3 * CHAIN_PIXELS);
}

/* The picture that a scene makes of the plane. */
static struct picture show(const struct stage *stage, const char *sdl) {
  struct picture picture;
  chain_scene(&stage->plane, 1, sdl);
  chain_render(&picture);
  return picture;
}

static void begin(int kind, struct stage *stage) {
  static const int samples[4] = {5, 4, 8, 8}; /* more than 16 lights */
  static const double edges[2] = {1, 0.8}, window[4] = {-1, 1.2, -1.1, 0.9};
  stage->slab = chain_slab(samples, edges, window, INFINITY, 0, 3);
  stage->lamp = chain_lamp_of(&stage->slab, 1, 1);
  stage->plane = chain_facing(&stage->lamp, 0, 3);
  chain_include(&stage->slab, 1, "lamp", kinds[kind]);
  stage->alone = show(stage, CHAIN_LIT("1, 1"));
  stage->mean = mean_of(&stage->alone);
}

static void end(struct stage *stage) {
  picture_free(&stage->alone);
  slab_free(&stage->slab);
}

/* Relative RMS difference of two pictures. */
static double difference(const struct picture *one, const struct picture *other) {
  double sum = 0, size = 0;
  for (int k = 0; k < 3 * CHAIN_PIXELS; ++k) {
    double off = (double)one->rgb[k] - (double)other->rgb[k];
    sum += off * off;
    size += (double)other->rgb[k] * (double)other->rgb[k];
  }
  return sqrt(sum / size);
}

/* The scene shows what the lamp alone does. */
static void expect_same(const struct stage *stage, const char *sdl) {
  struct picture picture = show(stage, sdl);
  double off = difference(&picture, &stage->alone);
  if (!(off <= exact)) fail_msg("%s: %g", sdl, off);
  picture_free(&picture);
}

#define INCLUDE "#include \"lamp.inc\"\n"
#define LAMP "object { Test_Lamp_Canned(1, 1) }"

/* In unions, and light groups with global_lights; with radiosity, and beside other lights. */
TEST(test_held) {
  static const char *const right[] = {
      INCLUDE "union { union { " LAMP " sphere { 50, 1 } } sphere { 50, 2 } pigment { rgb 1 } }",
      INCLUDE "light_group { " LAMP " sphere { 50, 1 } global_lights on }",
      INCLUDE LAMP "\nlight_source { 50 rgb 1e-6 area_light x, y, 4, 4 adaptive 1 jitter }",
      INCLUDE LAMP "\nglobal_settings { radiosity { count 20 recursion_limit 1 } }",
  };
  for (int kind = 0; kind < KINDS; ++kind) {
    struct stage stage;
    begin(kind, &stage);
    for (size_t k = (size_t)kind; k < sizeof right / sizeof *right; k += kind == SHEET ? 1 : KINDS)
      expect_same(&stage, right[k]);
    end(&stage);
  }
}

/* Without shadows a cluster is as bright as ever; the others, of random radiance, would be seven
 * times as bright, and are dark, as their headers say. */
TEST(test_no_shadow) {
  static const char *const bare[] = {
      INCLUDE "union { " LAMP " sphere { 50, 1 } no_shadow }",
      INCLUDE "light_source { 0 rgb 0 looks_like { union { " LAMP " sphere { 50, 1 } } } }",
  };
  for (int kind = 0; kind < KINDS; ++kind) {
    struct stage stage;
    begin(kind, &stage);
    for (size_t k = 0; k < sizeof bare / sizeof *bare; ++k) {
      if (kind == CLUSTER && k > 0) continue;
      if (kind == CLUSTER) {
        expect_same(&stage, bare[k]);
        continue;
      }
      struct picture picture = show(&stage, bare[k]);
      double light = mean_of(&picture) / stage.mean;
      print_message("%-28s %.2g of its light\n", kinds[kind], light);
      if (!(light < 0.05 && light > -2)) fail_msg("%s: %g of its light", bare[k], light);
      picture_free(&picture);
    }
    assert_int_equal(chain_run("grep -q 'no_shadow' lamp.inc") == 0, kind != CLUSTER);
    end(&stage);
  }
}

/* A glass ball before the plane: digit for digit the same with and without the scene's photons,
 * also where one union with their flags holds both ball and lamp.
 * A cluster that takes part makes a caustic, of as much light as POV-Ray's photons keep. */
TEST(test_photons) {
  char ball[400], sdl[600];
  for (int kind = 0; kind < KINDS; ++kind) {
    struct stage stage;
    begin(kind, &stage);
    double at[3];
    for (int c = 0; c < 3; ++c)
      at[c] = stage.slab.center[c] + 1.6 * stage.slab.normal[c] + 0.1 * stage.slab.u[c];
    snprintf(ball, sizeof ball,
             "sphere { <%.9g, %.9g, %.9g>, 0.6 pigment { rgbf 1 } interior { ior 1.5 }\n"
             "  finish { ambient 0 diffuse 0 } photons { target refraction on reflection on } }\n",
             at[0], at[1], at[2]);
    for (int part = 0; part < (kind == CLUSTER ? 2 : 1); ++part) {
      struct picture pictures[2];
      for (int photons = 0; photons < 2; ++photons) {
        snprintf(sdl, sizeof sdl, "#declare Test_Lamp_Photons = %d;\n" INCLUDE "%s %s %s %s %s",
                 part, kind == CLUSTER ? "" : "union {", LAMP, ball,
                 kind == CLUSTER ? "" : "photons { target refraction on reflection on } }",
                 photons ? "global_settings { photons { spacing 0.03 } }" : "");
        pictures[photons] = show(&stage, sdl);
      }
      double gain = mean_of(&pictures[1]) / mean_of(&pictures[0]) - 1;
      double off = difference(&pictures[1], &pictures[0]);
      print_message("%-28s mean %+.2g, RMS %.2g\n", kinds[kind], gain, off);
      if (part ? !(fabs(gain) < 0.15 && off > 0.1) : off > 0)
        fail_msg("%s: mean %+g, RMS %g", kinds[kind], gain, off);
      for (int photons = 0; photons < 2; ++photons) picture_free(&pictures[photons]);
    }
    end(&stage);
  }
}

/* What POV-Ray computed with, from a picture, which it decodes by the scene's assumed_gamma. */
static double encoded(double value, double gamma) {
  if (gamma > 0) return pow(value, 1 / gamma);
  return value < 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1 / 2.4) - 0.055; /* srgb */
}

/* The lamp keeps its radiance in those numbers, wherever the scene sets assumed_gamma. */
TEST(test_gamma) {
  static const struct {
    const char *text;
    double gamma;
  } cases[] = {{"1.8", 1.8}, {"2.2", 2.2}, {"srgb", 0}};
  char sdl[300];
  for (int kind = 0; kind < KINDS; ++kind) {
    struct stage stage;
    begin(kind, &stage);
    for (size_t k = kind == CLUSTER ? 2 : 0; k < sizeof cases / sizeof *cases; ++k)
      for (int after = 0; after < 2; ++after) {
        snprintf(sdl, sizeof sdl, "%s\n" LAMP, after ? "" : INCLUDE);
        chain_scene(&stage.plane, 1, sdl);
        chain_must("sed -i 's/assumed_gamma 1.0/assumed_gamma %s/; "
                   "2s/^/%s/' scene.pov",
                   cases[k].text, after ? "#include \"lamp.inc\"\\n" : "");
        struct picture picture;
        chain_render(&picture);
        for (int n = 0; n < 3 * CHAIN_PIXELS; ++n)
          picture.rgb[n] = (float)encoded((double)picture.rgb[n], cases[k].gamma);
        double off = difference(&picture, &stage.alone);
        if (!(off <= 1e-3))
          fail_msg("%s: gamma %s, %d: %g", kinds[kind], cases[k].text, after, off);
        picture_free(&picture);
      }
    end(&stage);
  }
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
