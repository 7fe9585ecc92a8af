#include "base/kelvin.h"

#include <math.h>

void kelvin_colour(double kelvin, double rgb[3]) {
  static const double from_xyz[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                        {-0.9692660, 1.8760108, 0.0415560},
                                        {0.0556434, -0.2040259, 1.0572252}};
  double t = kelvin;
  double u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
             (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
  double v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
             (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
  double x = 3 * u, y = 2 * v, whole = 2 * u - 8 * v + 4;
  double xyz[3] = {x / y, 1, (whole - x - y) / y};
  for (int c = 0; c < 3; ++c) {
    rgb[c] = 0;
    for (int k = 0; k < 3; ++k) rgb[c] += from_xyz[c][k] * xyz[k];
    rgb[c] = fmax(rgb[c], 0); /* below 1900 K blue is outside of the gamut */
  }
  double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  for (int c = 0; c < 3; ++c) rgb[c] /= luminance;
}
