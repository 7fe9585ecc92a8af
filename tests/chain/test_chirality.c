/* test_chirality.c - a lamp that shines the letter F shows an F the right way
 * round on a wall, as someone sees it who looks the way the lamp shines. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "chain.h"

enum { STROKES = 7 };

static const char *const letter[STROKES] = {
    ".......", //
    ".#####.", //
    ".#.....", //
    ".####..", //
    ".#.....", //
    ".#.....", //
    ".......",
};

/* The letter on the square -1..1, x to the right, y up. */
static double ink(double x, double y) {
  int column = (int)floor((x + 1) / 2 * STROKES), row = (int)floor((1 - y) / 2 * STROKES);
  if (column < 0 || column >= STROKES || row < 0 || row >= STROKES) return 0;
  return letter[row][column] == '#';
}

/* A small lamp at the origin that shines along +z with the letter in its
 * directions: x/z to the right, y/z up. */
static struct slab letter_lamp(const double u[3], const double v[3], double st_distance) {
  struct slab slab = slab_default();
  const int samples[4] = {2, 2, 28, 28};
  memcpy(slab.samples, samples, sizeof samples);
  memcpy(slab.u, u, sizeof slab.u);
  memcpy(slab.v, v, sizeof slab.v);
  slab.normal[1] = 0;
  slab.normal[2] = 1;
  slab.st_distance = st_distance;
  snprintf(slab.name, sizeof slab.name, "letter");
  assert_int_equal(slab_alloc(&slab, NULL), SLAB_OK);
  double edge = chain_length(u);
  for (int t = 0; t < samples[3]; ++t)
    for (int s = 0; s < samples[2]; ++s) {
      /* Far from the small aperture, the same direction for either st plane. */
      double x = -1 + (s + 0.5) * 2 / samples[2], y = -1 + (t + 0.5) * 2 / samples[3];
      double value = ink((x * u[0] + y * v[0]) / edge, (x * u[1] + y * v[1]) / edge);
      for (int view = 0; view < 4; ++view)
        for (int c = 0; c < 3; ++c) chain_sample(&slab, view % 2, view / 2, s, t)[c] = (float)value;
    }
  return slab;
}

/* Correlation of the picture with the letter; flips mirror the letter. */
static double correlation(const struct slab_picture *picture, int flip_x, int flip_y) {
  double sums[5] = {0}, n = CHAIN_PIXELS;
  for (int row = 0; row < CHAIN_SIZE; ++row)
    for (int column = 0; column < CHAIN_SIZE; ++column) {
      double x = (column + 0.5) / CHAIN_SIZE * 2 - 1, y = 1 - (row + 0.5) / CHAIN_SIZE * 2;
      double a = ink(flip_x ? -x : x, flip_y ? -y : y);
      /* Even light over the square, whatever the cosines. */
      double b = picture->rgb[3 * (row * CHAIN_SIZE + column)] * pow(1 + x * x + y * y, 2);
      const double terms[5] = {a, b, a * a, b * b, a * b};
      for (int k = 0; k < 5; ++k) sums[k] += terms[k];
    }
  double covariance = sums[4] / n - sums[0] * sums[1] / n / n;
  double variances =
      (sums[2] / n - sums[0] * sums[0] / n / n) * (sums[3] / n - sums[1] * sums[1] / n / n);
  return variances > 0 ? covariance / sqrt(variances) : 0;
}

/* The wall z = 1 as POV-Ray's plainest camera sees it: x to the right, y up. */
static const char scene[] =
    "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#include \"lamp.inc\"\n"
    "camera { orthographic location -3*z direction z right 2*x up 2*y }\n"
    "plane { -z, -1 pigment { rgb 1 } finish { diffuse 1 ambient 0 } }\n"
    "object { Letter_Canned(1, 1) }\n";

static void shine(const double u[3], const double v[3], double st_distance) {
  struct slab slab = letter_lamp(u, v, st_distance);
  struct slab_picture picture;
  chain_include(&slab, 1, "lamp", "");
  FILE *file = fopen(chain_path("scene.pov"), "w");
  assert_non_null(file);
  fputs(scene, file);
  assert_int_equal(fclose(file), 0);
  chain_render(&picture);
  double right = correlation(&picture, 0, 0), left = correlation(&picture, 1, 0),
         down = correlation(&picture, 0, 1), turned = correlation(&picture, 1, 1);
  print_message("correlation with F %.3f, mirrored %.3f, upside down %.3f, turned %.3f\n", right,
                left, down, turned);
  /* An F and its mirror images correlate by a half themselves. */
  assert_true(right > 0.95);
  assert_true(left < 0.6 && down < 0.6 && turned < 0.6);
  slab_picture_free(&picture);
  slab_free(&slab);
}

/* All frames around +z whose axes are x and y: half of them have u x v = -n. */
static void test_letter(void **state) {
  (void)state;
  const double edge = 0.04;
  for (int k = 0; k < 8; ++k) {
    double u[3] = {0, 0, 0}, v[3] = {0, 0, 0};
    int swap = k & 1;
    u[swap] = k & 2 ? -edge : edge;
    v[!swap] = k & 4 ? -edge : edge;
    shine(u, v, k % 3 ? INFINITY : 5);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_letter)};
  return cmocka_run_group_tests(tests, chain_setup, chain_teardown);
}
