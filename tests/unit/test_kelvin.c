/* test_kelvin.c - the colour of a black body against Planck's law and the CIE 1931 observer, by
 * the fit of Wyman, Sloan and Shirley, "Simple Analytic Approximations to the CIE XYZ Color
 * Matching Functions" (JCGT 2, 2013). */
#include <math.h>

#include "base/kelvin.h"
#include "testing.h"

static double lobe(double nm, double at, double below, double above) {
  double t = (nm - at) * (nm < at ? below : above);
  return exp(-0.5 * t * t);
}

/* u', v' of Planck's radiator. */
static void planck(double kelvin, double uv[2]) {
  double x = 0, y = 0, z = 0;
  for (int wave = 360; wave <= 830; ++wave) {
    double nm = wave;
    double power = pow(nm * 1e-3, -5) / expm1(1.438776877e7 / (nm * kelvin));
    x += power * (0.362 * lobe(nm, 442, 0.0624, 0.0374) + 1.056 * lobe(nm, 599.8, 0.0264, 0.0323) -
                  0.065 * lobe(nm, 501.1, 0.0490, 0.0382));
    y +=
        power * (0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322));
    z += power * (1.217 * lobe(nm, 437, 0.0845, 0.0278) + 0.681 * lobe(nm, 459, 0.0385, 0.0725));
  }
  uv[0] = 4 * x / (x + 15 * y + 3 * z);
  uv[1] = 9 * y / (x + 15 * y + 3 * z);
}

static void chromaticity(const double rgb[3], double uv[2]) {
  double x = 0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2];
  double y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  double z = 0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2];
  uv[0] = 4 * x / (x + 15 * y + 3 * z);
  uv[1] = 9 * y / (x + 15 * y + 3 * z);
}

TEST(test_planck) {
  static const double kelvins[] = {1900, 2700, 4000, 6500, 10000, 15000, 25000, KELVIN_MOST};
  double worst = 0;
  for (size_t k = 0; k < sizeof kelvins / sizeof *kelvins; ++k) {
    double rgb[3], is[2], right[2];
    kelvin_colour(kelvins[k], rgb);
    chromaticity(rgb, is);
    planck(kelvins[k], right);
    double off = hypot(is[0] - right[0], is[1] - right[1]);
    print_message("# %g K: %.4f off in u'v'\n", kelvins[k], off);
    worst = fmax(worst, off);
    assert_near(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2], 1, 1e-12);
  }
  assert_true(worst < 0.006);
}

/* Below 1900 K it leaves the primaries' gamut: as red as they are, never negative. */
TEST(test_ember) {
  double rgb[3];
  kelvin_colour(KELVIN_LEAST, rgb);
  assert_true(rgb[0] > 2 && rgb[1] > 0 && rgb[2] == 0);
}

int main(void) {
  return testing_run(NULL, NULL);
}
