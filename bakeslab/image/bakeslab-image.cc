/* bakeslab-image.cc - reads the image on standard input, which must be a file, by OpenImageIO,
 * and writes it as linear RGB: a line
 *   WIDTH HEIGHT TRANSPARENT FORMAT CHANNELS TYPE SPACE
 * (TRANSPARENT: 1 where an alpha is below 1, else 0; FORMAT, CHANNELS, TYPE: of the file; SPACE:
 * as what it was taken, linear or srgb) and then this machine's floats, rows downwards.
 * file/slab_image.h says what is read how; the argument is the suffix that it names. What is
 * wrong is one line on standard error, and the exit status 1.
 *
 * A program of its own, since OpenImageIO is 261 libraries. */
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using namespace OIIO;

static const char path[] = "/dev/stdin";

static std::runtime_error unreadable(const std::string &why) {
  return std::runtime_error("is no image that can be read: " + why);
}

/* The format that the suffix names comes first, then all others. */
static std::unique_ptr<ImageInput> open_image(const char *suffix, ImageSpec &spec) {
  ImageSpec wanted;
  wanted["oiio:UnassociatedAlpha"] = 1; /* colours as they are in the file */
  std::unique_ptr<ImageInput> named = ImageInput::create(suffix);
  if (named && named->open(path, spec, wanted)) return named;
  std::unique_ptr<ImageInput> other = ImageInput::open(path, &wanted);
  if (!other)
    throw unreadable(named ? named->geterror() : "it has no format that OpenImageIO knows");
  spec = other->spec();
  return other;
}

/* Light slabs are no pictures; LogLuv, in which most are, would be read as 8 bits, silently. */
static void check_kind(const ImageSpec &spec) {
  int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation");
  std::string text = spec.get_string_attribute("ImageDescription");
  if (photometric == 32844 || photometric == 32845 || spec.find_attribute("lightslab") ||
      text.find("\"light-slab\"") != std::string::npos)
    throw std::runtime_error("is a light slab or another LogLuv TIFF, and no picture");
  if (spec.deep || spec.depth > 1) throw std::runtime_error("is deep, and no picture");
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw unreadable("it has no pixels");
}

/* Floating-point files hold light; others are sRGB unless they say that they are linear. */
static bool is_linear(const ImageSpec &spec) {
  std::string space = spec.get_string_attribute("oiio:ColorSpace");
  return spec.format.is_floating_point() || Strutil::iequals(space, "linear") ||
         Strutil::iequals(space, "scene_linear");
}

static float decode(float value, bool linear, int column, int row) {
  if (!(value >= 0) || !std::isfinite(value))
    throw std::runtime_error(Strutil::sprintf(
        "column %d, row %d holds a value that is negative or not finite", column, row));
  double x = value;
  return linear ? value : float(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

static void copy_image(const char *suffix) {
  ImageSpec spec;
  std::unique_ptr<ImageInput> in = open_image(suffix, spec);
  check_kind(spec);
  /* the first three channels, or the first for all three */
  int alpha = spec.alpha_channel < spec.nchannels ? spec.alpha_channel : -1;
  int colours = spec.nchannels < 3 ? 1 : 3, channels = std::max(colours, alpha + 1);
  size_t width = size_t(spec.width), pixels = width * size_t(spec.height), step = size_t(channels);
  bool fits = double(pixels) * channels < 0x1p40;
  std::unique_ptr<float[]> all(fits ? new (std::nothrow) float[pixels * step] : nullptr);
  if (!all) throw unreadable("it is too large for the memory");
  if (!in->read_image(0, 0, 0, channels, TypeDesc::FLOAT, all.get()))
    throw unreadable(in->geterror());
  bool linear = is_linear(spec), transparent = false;
  for (size_t k = 0; k < pixels && alpha >= 0; ++k)
    transparent = transparent || !(all[k * step + size_t(alpha)] >= 1);
  std::printf("%d %d %d %s %d %s %s\n", spec.width, spec.height, transparent, in->format_name(),
              spec.nchannels, spec.format.c_str(), linear ? "linear" : "srgb");
  std::vector<float> rgb(3 * width);
  for (int row = 0; row < spec.height; ++row) {
    const float *from = &all[size_t(row) * width * step];
    for (size_t k = 0; k < 3 * width; ++k)
      rgb[k] = decode(from[k / 3 * step + (colours == 3 ? k % 3 : 0)], linear, int(k / 3), row);
    std::fwrite(rgb.data(), sizeof(float), rgb.size(), stdout);
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw std::runtime_error("its pixels cannot be passed on");
}

int main(int argc, char **argv) {
  int errors = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3); /* libraries talk on the other */
  if (argc != 2 || !std::freopen("/dev/null", "w", stderr)) {
    dprintf(errors, "usage: bakeslab-image SUFFIX <IMAGE >PIXELS\n");
    return 2;
  }
  try {
    copy_image(argv[1]);
    return 0;
  } catch (const std::exception &failure) {
    std::string why = failure.what();
    dprintf(errors, "%s\n", why.substr(0, why.find('\n')).c_str());
    return 1;
  }
}
