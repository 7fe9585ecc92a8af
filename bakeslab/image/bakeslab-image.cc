/* bakeslab-image.cc - reads images by OpenImageIO, one after the other. Standard input is a socket
 * of messages, each with an open file, the image, and a line
 *   own|srgb SUFFIX
 * (file/slab_image.h says what is read how, and what these name). For each it writes linear Rec.
 * 709: a line WIDTH HEIGHT TRANSPARENT SEVERAL INTEGERS ASPECT (TRANSPARENT: 1 where an alpha is
 * below 1, else 0; SEVERAL: 1 where the file has other pictures, which are not read, else 0;
 * INTEGERS: 1 where it holds integers, else 0; ASPECT: a pixel's width by its height) and then this
 * machine's floats, rows downwards. What is wrong is one line on standard error, and the exit
 * status 1: no image is read after one that is refused.
 *
 * A program of its own, since OpenImageIO is 261 libraries. */
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/place.hh"
#include "image/says.hh"

using namespace OIIO;

static const char path[] = "/dev/stdin";

static std::runtime_error unreadable(const std::string &why) {
  return std::runtime_error("is no image that can be read: " +
                            (why.empty() ? "it is damaged or truncated" : why));
}

static std::unique_ptr<ImageInput> open_image(const std::string &format, ImageSpec &spec) {
  ImageSpec wanted;
  wanted["oiio:UnassociatedAlpha"] = 1; /* colours as they are in the file */
  std::unique_ptr<ImageInput> in = ImageInput::create(format);
  if (!in) throw unreadable("OpenImageIO is here without " + format);
  if (!in->open(path, spec, wanted)) throw unreadable(in->geterror());
  return in;
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

/* ---- Where: channels and pixels ---- */

struct Channels {
  std::array<int, 3> colours; /* of red, green and blue; grey is all of them */
  int alpha, count;           /* -1: none; so many are read */
};

static Channels find_channels(const ImageSpec &spec, const std::string &format) {
  Channels found = {{0, 1, 2}, spec.alpha_channel, 0};
  /* OpenImageIO 2.4 calls a channel that is not there the alpha of GIF */
  if (found.alpha >= spec.nchannels) found.alpha = spec.channelindex("A");
  if (spec.nchannels < 3) found.colours = {0, 0, 0};
  if (format == "openexr") {
    found.colours = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
    bool whole = *std::min_element(found.colours.begin(), found.colours.end()) >= 0;
    if (!whole && spec.nchannels - (found.alpha >= 0) != 1)
      throw std::runtime_error("has the channels " + Strutil::join(spec.channelnames, ", ") +
                               "; R, G and B, or one for grey, are what is read");
    if (!whole) found.colours.fill(found.alpha == 0 ? 1 : 0);
  }
  found.count = 1 + std::max({found.colours[0], found.colours[1], found.colours[2], found.alpha});
  return found;
}

static Place find_place(const ImageSpec &spec, const Says &says) {
  Place place = {spec.width, spec.height, spec.width, spec.height, 0, 0, says.orientation};
  if (says.orientation == 0) place.orientation = spec.get_int_attribute("Orientation", 1);
  if (place.orientation < 1 || place.orientation > 8) place.orientation = 1;
  /* other formats have places on a page */
  if (says.format == "openexr") {
    place.full_width = spec.full_width;
    place.full_height = spec.full_height;
    place.left = spec.x - spec.full_x;
    place.top = spec.y - spec.full_y;
  }
  double most = double(says_most_pixels);
  if (double(place.width) * place.height > most ||
      double(place.full_width) * place.full_height > most)
    throw std::runtime_error(says_too_large);
  return place;
}

/* ---- What colours ---- */

static Colours find_own_colours(const ImageSpec &spec, const Says &says) {
  Colours colours;
  const ParamValue *profile = spec.find_attribute("ICCProfile");
  if (says.has_profile && !profile)
    throw std::runtime_error("has a colour profile that is damaged; convert it to sRGB first");
  if (profile)
    return colours_of_profile(
        std::string(static_cast<const char *>(profile->data()), size_t(profile->datasize())),
        spec.get_string_attribute("ICCProfile:profile_description"));
  std::string space = spec.get_string_attribute("oiio:ColorSpace");
  float gamma = spec.get_float_attribute("oiio:Gamma");
  bool linear = spec.format.is_floating_point() || Strutil::iequals(space, "linear") ||
                Strutil::iequals(space, "scene_linear");
  if (spec.get_int_attribute("Exif:ColorSpace") == 2)
    throw std::runtime_error("is Adobe RGB; convert it to sRGB first");
  if (says.curve)
    colours.curves.fill(*says.curve);
  else if (!linear)
    colours.curves.fill(gamma > 0 ? colours_power(double(gamma)) : colours_srgb());
  float xy[8];
  std::optional<Primaries> primaries = says.primaries;
  if (spec.get_int_attribute("acesImageContainerFlag") == 1) /* SMPTE ST 2065-4 */
    primaries = {0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767};
  if (spec.getattribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), xy)) {
    primaries.emplace();
    std::copy(xy, xy + 8, primaries->begin());
  }
  if (primaries) colours_of_primaries(*primaries, colours);
  return colours;
}

static Colours find_colours(const ImageSpec &spec, const Says &says, bool own) {
  Colours colours;
  if (own) return find_own_colours(spec, says);
  if (!spec.format.is_floating_point()) colours.curves.fill(colours_srgb());
  return colours;
}

/* ---- The picture ---- */

struct Picture {
  Place place;
  Channels channels;
  Colours colours;
  double gain[3], step; /* step: of what integers round, as light; 0: no integers */
  std::unique_ptr<float[]> stored;
};

static void write_row(const Picture &picture, int row, std::vector<float> &rgb) {
  for (int column = 0; column < picture.place.shown_width(); ++column) {
    long pixel = picture.place.find(column, row);
    double light[3] = {0, 0, 0};
    const float *from =
        pixel < 0 ? nullptr : &picture.stored[size_t(pixel * picture.channels.count)];
    for (size_t k = 0; from && k < 3; ++k) light[k] = double(from[picture.channels.colours[k]]);
    if (from) picture.colours.decode(light, picture.step);
    for (size_t k = 0; k < 3; ++k) {
      float value = float(light[k] * picture.gain[k]);
      if (!(value >= 0) || !std::isfinite(value))
        throw std::runtime_error(
            Strutil::sprintf("column %d, row %d holds %s", column, row,
                             picture.colours.mixes && std::isfinite(value)
                                 ? "a colour outside Rec. 709's; bring it into sRGB first"
                                 : "a value that is negative or not finite"));
      rgb[3 * size_t(column) + k] = value;
    }
  }
  std::fwrite(rgb.data(), sizeof(float), rgb.size(), stdout);
}

static void copy_image(const std::string &suffix, bool own) {
  ImageSpec spec;
  Says says = says_read({STDIN_FILENO}, suffix);
  std::unique_ptr<ImageInput> in = open_image(says.format, spec);
  check_kind(spec);
  Picture picture = {find_place(spec, says),
                     find_channels(spec, says.format),
                     find_colours(spec, says, own),
                     {},
                     0,
                     {}};
  std::copy(says.gain, says.gain + 3, picture.gain);
  if (!spec.format.is_floating_point()) picture.step = 0.004;
  int alpha = picture.channels.alpha;
  size_t pixels = size_t(spec.width) * size_t(spec.height), step = size_t(picture.channels.count);
  picture.stored.reset(new (std::nothrow) float[pixels * step]);
  if (!picture.stored) throw unreadable("it is too large for the memory");
  if (!in->read_image(0, 0, 0, picture.channels.count, TypeDesc::FLOAT, picture.stored.get()))
    throw unreadable(in->geterror());
  bool transparent = false;
  for (size_t k = 0; k < pixels && alpha >= 0; ++k)
    transparent = transparent || !(picture.stored[k * step + size_t(alpha)] >= 1);
  const bool several = in->seek_subimage(1, 0);
  double aspect = double(spec.get_float_attribute("PixelAspectRatio", 1));
  if (picture.place.turned()) aspect = 1 / aspect;
  if (says.pixel_aspect > 0) aspect = says.pixel_aspect;
  std::printf("%d %d %d %d %d %.9g\n", picture.place.shown_width(), picture.place.shown_height(),
              transparent, several, !spec.format.is_floating_point(), aspect);
  std::vector<float> rgb(3 * size_t(picture.place.shown_width()));
  for (int row = 0; row < picture.place.shown_height(); ++row) write_row(picture, row, rgb);
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    throw std::runtime_error("its pixels cannot be passed on");
}

/* ---- Requests ---- */

struct Request {
  bool own;
  std::string suffix;
};

/* The next one, whose image becomes standard input; none: there are no more. */
static std::optional<Request> next_request(int requests) {
  char line[64];
  union {
    char bytes[CMSG_SPACE(sizeof(int))];
    cmsghdr header;
  } control = {};
  iovec text = {line, sizeof line};
  msghdr message = {};
  message.msg_iov = &text;
  message.msg_iovlen = 1;
  message.msg_control = control.bytes;
  message.msg_controllen = sizeof control.bytes;
  ssize_t got = recvmsg(requests, &message, MSG_CMSG_CLOEXEC);
  if (got <= 0 || message.msg_controllen < sizeof control.header) return std::nullopt;
  int image;
  std::memcpy(&image, CMSG_DATA(&control.header), sizeof image);
  bool put = dup2(image, STDIN_FILENO) >= 0;
  close(image);
  std::string words(line, size_t(got));
  size_t blank = words.find(' ');
  if (!put || blank == std::string::npos) return std::nullopt;
  return Request{words.substr(0, blank) == "own", words.substr(blank + 1)};
}

int main(int argc, char **) {
  /* libraries talk on the standard one */
  int errors = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  int requests = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3), kind = 0;
  socklen_t size = sizeof kind;
  if (argc != 1 || getsockopt(requests, SOL_SOCKET, SO_TYPE, &kind, &size) != 0 ||
      kind != SOCK_SEQPACKET || !std::freopen("/dev/null", "w", stderr)) {
    dprintf(errors, "bakeslab and renderslab run this to read images\n");
    return 2;
  }
  try {
    while (std::optional<Request> request = next_request(requests))
      copy_image(request->suffix, request->own);
    return 0;
  } catch (const std::bad_alloc &) {
    dprintf(errors, "is too large for the memory\n");
  } catch (const std::exception &failure) {
    std::string why = failure.what();
    dprintf(errors, "%s\n", why.substr(0, why.find('\n')).c_str());
  }
  return 1;
}
