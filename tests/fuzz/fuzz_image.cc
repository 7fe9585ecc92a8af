/* fuzz_image.cc - what an image file says of itself in its bytes, and, of the same bytes, an ICC
 * profile: either is understood, or refused in words. */
#include <tiffio.h>

#include <cmath>
#include <stdexcept>

#include "image/says.hh"

extern "C" {
#include "fuzz.h"
}

static void check(const Colours &colours) {
  for (int k = 0; k <= 8; ++k) {
    double rgb[3] = {k / 8.0, 1 - k / 8.0, 0.5};
    colours.decode(rgb, 0.004);
  }
  for (const auto &row : colours.matrix)
    for (const double x : row) fuzz_check(std::isfinite(x));
}

static void read_file(int file) {
  const Says says = says_read({file}, "tga");
  fuzz_check(!says.format.empty() && says.orientation >= 0 && says.orientation <= 8);
  for (const double gain : says.gain) fuzz_check(gain > 0 && std::isfinite(gain));
  Colours colours;
  if (says.curve) colours.curves.fill(*says.curve);
  if (says.primaries) colours_of_primaries(*says.primaries, colours);
  check(colours);
}

template <typename Reading> static void attempt(Reading reading) {
  try {
    reading();
  } catch (const std::runtime_error &why) {
    fuzz_check(why.what()[0]);
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
  const int file = fuzz_file(data, size);
  const std::string bytes(reinterpret_cast<const char *>(data), size);
  attempt([&] { read_file(file); });
  attempt([&] { check(colours_of_profile(bytes, "")); });
  close(file);
  return 0;
}
