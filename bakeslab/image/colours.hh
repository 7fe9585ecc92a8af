/* colours.hh - how the numbers of an image become linear Rec. 709: a curve for each channel, then a
 * matrix. What cannot be is thrown as std::runtime_error, in words that follow the file's name. */
#ifndef COLOURS_H
#define COLOURS_H

#include <array>
#include <functional>
#include <string>

using Curve = std::function<double(double)>; /* light of a value; none: the value itself */
using Matrix = std::array<std::array<double, 3>, 3>;
using Primaries = std::array<double, 8>; /* x and y of red, green, blue and white */

struct Colours {
  std::array<Curve, 3> curves;
  bool mixes = false; /* is there a matrix? */
  Matrix matrix{};    /* rows of red, green and blue */

  /* Of red, green and blue in the file. Where there is a matrix, what rounding takes out of Rec.
   * 709's triangle is brought back: a hundredth of the largest, or `step`. */
  void decode(double rgb[3], double step) const;
};

Curve colours_srgb();
Curve colours_power(double exponent);

/* The same light, without adaptation of white: what has the XYZ of Rec. 709's red becomes 1 0 0. */
void colours_of_primaries(const Primaries &primaries, Colours &colours);

/* From an ICC profile (ICC.1:2010) of three curves and a matrix, or of one curve for grey; white
 * becomes white. `name` is what the refusal of other profiles calls it. */
Colours colours_of_profile(const std::string &icc, const std::string &name);

#endif
