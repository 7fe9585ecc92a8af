/* letter.c - see letter.h. */
#include "letter.h"

#include <math.h>
#include <stdio.h>

#include "chain.h"

static const char *const rows[LETTER_STROKES] = {
    ".......", //
    ".#####.", //
    ".#.....", //
    ".####..", //
    ".#.....", //
    ".#.....", //
    ".......",
};

int letter_cell(int column, int row) {
  if (column < 0 || column >= LETTER_STROKES || row < 0 || row >= LETTER_STROKES) return 0;
  return rows[row][column] == '#';
}

double letter_ink(double x, double y) {
  return letter_cell((int)floor((x + 1) / 2 * LETTER_STROKES),
                     (int)floor((1 - y) / 2 * LETTER_STROKES));
}

/* Correlation of the picture with the letter; flips mirror the letter. */
static double correlation(const struct picture *picture, int flip_x, int flip_y) {
  double sums[5] = {0}, n = CHAIN_PIXELS;
  for (int row = 0; row < CHAIN_SIZE; ++row)
    for (int column = 0; column < CHAIN_SIZE; ++column) {
      double x = (column + 0.5) / CHAIN_SIZE * 2 - 1, y = 1 - (row + 0.5) / CHAIN_SIZE * 2;
      double a = letter_ink(flip_x ? -x : x, flip_y ? -y : y);
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

void letter_render(const char *lights, struct picture *picture) {
  chain_text("scene.pov", "w",
             "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n"
             "camera { orthographic location -3*z direction z right 2*x up 2*y }\n"
             "plane { -z, -1 pigment { rgb 1 } finish { diffuse 1 ambient 0 } }\n%s\n",
             lights);
  chain_render(picture);
}

void letter_expect(const struct picture *picture) {
  double right = correlation(picture, 0, 0), left = correlation(picture, 1, 0),
         down = correlation(picture, 0, 1), turned = correlation(picture, 1, 1);
  print_message("# correlation with F %.3f, mirrored %.3f, upside down %.3f, turned %.3f\n", right,
                left, down, turned);
  /* An F and its mirror images correlate by a half themselves. */
  assert_true(right > 0.95);
  assert_true(left < 0.6 && down < 0.6 && turned < 0.6);
}
