/* test_lamp.c - the whole chain: a lamp script, baked, included and rendered by POV-Ray,
 * against where its light must go and against the lamp itself. */
#include <math.h>
#include <stdio.h>

#include "chain.h"
#include "letter.h"

/* lamp.pov to lamp.inc and lamp.exr. */
static void bake(const char *options) {
  chain_must("\"$BAKESLAB\" bake lamp.pov -o slab.exr -q %s", options);
  chain_must("\"$BAKESLAB\" include slab.exr -o lamp.inc");
}

/* ---- Chirality: what a small opening projects ---- */

/* Cells of the letter that glow 100 units behind an opening of 2 x 2, turned as a slide in
 * a projector is: the opening turns them back. The wall is 50 units in front of it. */
static void project(const char *u, const char *v, double st_distance) {
  struct picture picture;
  chain_text("lamp.pov", "w",
             "#version 3.7;\n#include \"canned.inc\"\nCanned_Lamp(\"letter\")\nCanned_Needs(\"\")\n"
             "Canned_Slab(<0, 0, 0>, %s, %s, <0, 0, 1>, <-1, 1, -1, 1>, %g)\nunion {\n",
             u, v, st_distance);
  for (int row = 0; row < LETTER_STROKES; ++row)
    for (int column = 0; column < LETTER_STROKES; ++column)
      if (letter_cell(column, row))
        chain_text("lamp.pov", "a", "  box { <%d, %d, 0>, <%d, %d, 1> }\n", column,
                   LETTER_STROKES - row, column + 1, LETTER_STROKES - row - 1);
  chain_text("lamp.pov", "a",
             "  translate <-%d/2, -%d/2, 0> scale <200/%d, 200/%d, 1> rotate 180*z translate "
             "-101*z\n  pigment { rgb 1 } finish { emission 1 diffuse 0 }\n}\n",
             LETTER_STROKES, LETTER_STROKES, LETTER_STROKES, LETTER_STROKES);
  bake("--uv 2x2 --st 28x28 --rays 4 --uniform --jobs 1");
  letter_render("#include \"lamp.inc\"\nobject { Letter_Canned(1/50, 1) }", &picture);
  letter_expect(&picture);
  picture_free(&picture);
}

TEST(test_letter) {
  project("2*x", "2*y", 0);
  project("-2*x", "2*y", 0);
  project("2*y", "2*x", 250);
  project("2*y", "-2*x", 250);
}

/* ---- The canned lamp against the lamp ---- */

/* A bulb in a black box over a few black bars, with no symmetry: all that leaves comes
 * straight from the bulb, which POV-Ray does without radiosity. */
static const char barred_lamp[] =
    "#version 3.7;\n#include \"canned.inc\"\nCanned_Lamp(\"barred\")\n"
    "Canned_Needs(\"extended_source\")\n"
    "Canned_Slab(<0, 0, 0>, <20, 0, 0>, <0, 0, 16>, <0, -1, 0>, <-1.5, 1.5, -1.2, 1.2>, 0)\n"
    "Canned_Bulb(<3, 11, -2>, 1.5, 100)\n"
    "union {\n"
    "  difference { box { <-11, 0.1, -9>, <11, 15, 9> } box { <-10, 0, -8>, <10, 14, 8> } }\n"
    "  box { <-4.5, 0.1, -8>, <-3.5, 3, 8> }\n"
    "  box { <4, 0.1, -8>, <6, 2, 8> }\n"
    "  box { <-10, 0.1, 3>, <10, 2.5, 4> }\n"
    "  pigment { rgb 0 } finish { diffuse 0 }\n}\n";

/* The floor 30 units below it, as far as any of its light gets; the camera is in between. */
static void render_floor(const char *lights, struct picture *picture) {
  chain_text("scene.pov", "w",
             "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n%s\n"
             "plane { y, -30 pigment { rgb 1 } finish { diffuse 1 ambient 0 } }\n"
             "camera { orthographic location <-8, -10, 5> direction -y right 100*x up 80*z }\n",
             lights);
  chain_render(picture);
}

static double value(const struct picture *picture, int x, int y) {
  if (x < 0 || x >= CHAIN_SIZE || y < 0 || y >= CHAIN_SIZE) return 0;
  return (double)picture->rgb[3 * (y * CHAIN_SIZE + x)];
}

/* RMS difference over RMS, where `wrong` may be mirrored and shifted. */
static double difference(const struct picture *right, const struct picture *wrong, int flip_x,
                         int flip_y, int shift) {
  double error = 0, size = 0;
  for (int y = 0; y < CHAIN_SIZE; ++y)
    for (int x = 0; x < CHAIN_SIZE; ++x) {
      double there =
          value(wrong, (flip_x ? CHAIN_SIZE - 1 - x : x) + shift, flip_y ? CHAIN_SIZE - 1 - y : y);
      error += pow(there - value(right, x, y), 2);
      size += pow(value(right, x, y), 2);
    }
  return sqrt(error / size);
}

static double mean(const struct picture *picture) {
  double sum = 0;
  for (int k = 0; k < CHAIN_PIXELS; ++k) sum += (double)picture->rgb[3 * k];
  return sum / CHAIN_PIXELS;
}

TEST(test_canned) {
  struct picture lamp, canned;
  chain_text("lamp.pov", "w", "%s", barred_lamp);
  bake("--uv 10x8 --st 40x32 --rays 64");
  render_floor("#include \"lamp.inc\"\nobject { Barred_Canned(1, 1) }", &canned);
  chain_must("cp \"$CANNED_INCLUDE\"/canned.inc .");
  render_floor("#include \"lamp.pov\"", &lamp);
  /* Nothing of the light misses the picture. */
  for (int k = 0; k < CHAIN_SIZE; ++k) {
    assert_true(value(&lamp, k, 0) == 0 && value(&lamp, k, CHAIN_SIZE - 1) == 0);
    assert_true(value(&lamp, 0, k) == 0 && value(&lamp, CHAIN_SIZE - 1, k) == 0);
  }
  double ratio = mean(&canned) / mean(&lamp), error = difference(&lamp, &canned, 0, 0, 0);
  print_message("# mean %+.2f %%, RMSE %.2f %%\n", 100 * (ratio - 1), 100 * error);
  /* Of the mean, +1.4 % are the lamp's: POV-Ray's round area light lets that much more through
   * this grid than a sphere does. The rest of the RMSE is the blur of 10 x 8 positions. */
  assert_true(fabs(ratio - 1) < 0.02);
  assert_true(error < 0.1);
  /* A lamp that is mirrored, turned or off by a pixel (2 of 100 units) would be farther off. */
  static const int wrong[][3] = {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int k = 0; k < 5; ++k) {
    double off = difference(&lamp, &canned, wrong[k][0], wrong[k][1], wrong[k][2]);
    assert_true(off > 0.2);
  }
  picture_free(&lamp);
  picture_free(&canned);
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
