#include "image/says.hh"

#include <strings.h>
#include <tiffio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

[[noreturn]] static void refuse(const std::string &why) {
  throw std::runtime_error(why);
}

/* ---- PNG, 3rd edition: section 4.3 says which of its chunks counts ---- */

/* A type is four letters. Without that, 4 GB of zeros would be as many chunks. */
static bool is_chunk(const std::string &type) {
  return type.size() == 4 && std::all_of(type.begin(), type.end(),
                                         [](unsigned char letter) { return std::isalpha(letter); });
}

static void read_png(const Bytes &file, Says &says) {
  bool srgb = false, coded = false;
  double gamma = 0;
  std::optional<Primaries> primaries;
  for (uint64_t at = 8, end = file.size(); at < end; at += 12 + file.big(at, 4)) {
    std::string type = file.text(at + 4, 4);
    uint64_t data = at + 8;
    if (type == "IDAT" || !is_chunk(type)) break;
    if (type == "iCCP") says.has_profile = true;
    if (type == "sRGB") srgb = true;
    if (type == "gAMA") gamma = double(file.big(data, 4)) / 1e5;
    if (type == "cHRM") {
      const size_t order[8] = {6, 7, 0, 1, 2, 3, 4, 5}; /* white comes first */
      primaries.emplace();
      for (size_t k = 0; k < 8; ++k)
        (*primaries)[order[k]] = double(file.big(data + 4 * k, 4)) / 1e5;
    }
    if (type != "cICP") continue;
    uint64_t space = file.big(data, 4); /* primaries, transfer, matrix, range: H.273 */
    if (space != 0x01080001 && space != 0x010d0001)
      refuse("says by cICP that its colours are not Rec. 709's; convert it to sRGB first");
    says.curve = space == 0x01080001 ? nullptr : colours_srgb();
    coded = true;
  }
  if (coded) says.has_profile = false;
  if (coded || says.has_profile || srgb) return;
  if (gamma > 0) says.curve = colours_power(1 / gamma);
  says.primaries = primaries;
}

/* ---- JPEG: markers ---- */

/* libjpeg makes grey of what is missing at the end, but its marker is missing too. */
static void find_end(const Bytes &file, uint64_t at) {
  const size_t block = 1 << 16;
  for (uint64_t end = file.size(); at + 1 < end; at += block - 1)
    if (file.text(at, block).find("\xff\xd9") != std::string::npos) return;
  refuse("is no image that can be read: it is truncated");
}

static void read_jpeg(const Bytes &file, Says &says) {
  uint64_t at = 2;
  for (uint64_t end = file.size(); at < end;) {
    uint64_t marker = file.big(at, 2), data = at + 4;
    if (marker == 0xffff) {
      ++at; /* padding */
      continue;
    }
    if (marker == 0xffda || marker < 0xff01) break;
    if (marker == 0xffe2 && file.text(data, 11) == "ICC_PROFILE") says.has_profile = true;
    bool frame = marker >= 0xffc0 && marker <= 0xffcf && marker != 0xffc4 && marker != 0xffc8 &&
                 marker != 0xffcc;
    if (frame && file.big(data + 5, 1) == 4)
      refuse("is CMYK, for a printer; convert it to sRGB first");
    at += 2 + file.big(at + 2, 2);
  }
  find_end(file, at);
}

/* ---- TIFF ---- */

static void read_tiff(const Bytes &file, Says &says) {
  lseek(file.fd, 0, SEEK_SET); /* libtiff reads from where it stands */
  TIFF *tiff = TIFFFdOpen(dup(file.fd), "", "r");
  if (!tiff) return; /* OpenImageIO says why */
  uint16_t photometric = PHOTOMETRIC_RGB;
  float *white = nullptr, *others = nullptr;
  uint16_t *transfer[3] = {};
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  if (TIFFGetField(tiff, TIFFTAG_PRIMARYCHROMATICITIES, &others)) {
    says.primaries = Primaries{0, 0, 0, 0, 0, 0, 0.3127, 0.3290};
    bool named = TIFFGetField(tiff, TIFFTAG_WHITEPOINT, &white) != 0;
    for (size_t k = 0; k < 6; ++k) (*says.primaries)[k] = double(others[k]);
    for (size_t k = 0; named && k < 2; ++k) (*says.primaries)[6 + k] = double(white[k]);
  }
  bool curved =
      TIFFGetField(tiff, TIFFTAG_TRANSFERFUNCTION, &transfer[0], &transfer[1], &transfer[2]) != 0;
  uint32_t size = 0;
  void *profile = nullptr;
  says.has_profile = TIFFGetField(tiff, TIFFTAG_ICCPROFILE, &size, &profile) != 0;
  TIFFClose(tiff);
  if (photometric == PHOTOMETRIC_SEPARATED)
    refuse("is CMYK, for a printer; convert it to sRGB first");
  if (photometric == PHOTOMETRIC_CIELAB || photometric == PHOTOMETRIC_ICCLAB ||
      photometric == PHOTOMETRIC_ITULAB)
    refuse("has Lab colours; convert it to sRGB first");
  if (curved && !says.has_profile)
    refuse("has a transfer function of its own; convert it to sRGB first");
}

/* ---- GIF, WebP, BMP ---- */

static void read_gif(const Bytes &file) {
  if (file.little(6, 2) * file.little(8, 2) > says_most_pixels) refuse(says_too_large);
}

static void read_webp(const Bytes &file) {
  uint64_t flags = file.text(12, 4) == "VP8X" ? file.little(20, 1) : 0;
  if (flags & 0x20) refuse("is a WebP with a colour profile; convert it to sRGB or to PNG first");
  if (flags & 0x08) refuse("is a WebP with EXIF, which may turn it; convert it to PNG first");
  if (flags & 0x02) refuse("is an animation; give one picture");
}

static void read_bmp(const Bytes &file) {
  uint64_t header = file.little(14, 4), space = file.little(14 + 56, 4);
  if (header >= 108 && space != 0x73524742 && space != 0x57696e20 && space != 0)
    refuse("is a BMP with a colour profile; convert it to sRGB or to PNG first");
}

/* ---- Radiance: Greg Ward, "The RADIANCE Picture File Format" ---- */

/* The eight orders of rows and columns, as EXIF numbers them. */
static bool parse_size(const char *line, Says &says, unsigned long size[2]) {
  static const char orders[8][6] = {"-Y +X", "-Y -X", "+Y -X", "+Y +X",
                                    "+X -Y", "-X -Y", "-X +Y", "+X +Y"};
  char first[3], second[3];
  if (std::sscanf(line, "%2s %lu %2s %lu", first, &size[0], second, &size[1]) != 4) return false;
  for (int k = 0; k < 8; ++k)
    if (std::string(orders[k]) == std::string(first) + " " + second) says.orientation = k + 1;
  return says.orientation > 0;
}

static void parse_variable(const std::string &line, Says &says) {
  double x[3];
  if (std::sscanf(line.c_str(), "EXPOSURE=%lf", &x[0]) == 1) {
    x[1] = x[2] = x[0];
  } else if (std::sscanf(line.c_str(), "COLORCORR=%lf %lf %lf", &x[0], &x[1], &x[2]) != 3) {
    if (std::sscanf(line.c_str(), "PIXASPECT=%lf", &x[0]) == 1) /* height by width */
      says.pixel_aspect /= x[0];
    if (line.compare(0, 10, "PRIMARIES=") == 0) {
      says.primaries.emplace();
      double *p = says.primaries->data();
      if (std::sscanf(line.c_str() + 10, "%lf %lf %lf %lf %lf %lf %lf %lf", p, p + 1, p + 2, p + 3,
                      p + 4, p + 5, p + 6, p + 7) != 8)
        refuse("has a line PRIMARIES= without eight numbers");
      Colours colours;
      colours_of_primaries(*says.primaries, colours);
      if (colours.mixes)
        refuse("has PRIMARIES other than Rec. 709's; convert it by ra_xyze -r first");
    }
    return;
  }
  for (int k = 0; k < 3; ++k) {
    if (!(x[k] > 0) || !std::isfinite(x[k])) refuse("has an exposure that is not positive");
    says.gain[k] /= x[k];
  }
}

static void read_radiance(const Bytes &file, Says &says) {
  std::string header = file.text(0, 1 << 16);
  unsigned long size[2] = {0, 0};
  says.pixel_aspect = 1;
  size_t at = 0;
  for (size_t end; (end = header.find('\n', at)) != std::string::npos; at = end + 1) {
    std::string line = header.substr(at, end - at);
    if (line.find("FORMAT=32-bit_rle_xyze") == 0)
      refuse("is XYZE, not RGBE; convert it by ra_xyze first");
    parse_variable(line, says);
    if (!line.empty()) continue;
    at = end + 1;
    break;
  }
  if (!parse_size(header.c_str() + at, says, size))
    refuse("is no image that can be read: its size is in none of Radiance's forms");
  uint64_t pixels = header.find('\n', at) + 1;
  bool packed = file.big(pixels, 2) == 0x0202 && file.big(pixels + 2, 2) == size[1];
  if (!packed && file.size() > pixels && file.size() - pixels < 4 * uint64_t(size[0]) * size[1])
    refuse("is no image that can be read: it is truncated, or in Radiance's old run-length code");
}

/* ---- The formats ---- */

static std::string format_of(const Bytes &file, const std::string &suffix) {
  static const struct {
    const char *name;
    size_t at;
    std::string magic;
  } formats[] = {{"png", 0, "\x89PNG\r\n\x1a\n"},
                 {"jpeg", 0, "\xff\xd8\xff"},
                 {"tiff", 0, std::string("II*\0", 4)},
                 {"tiff", 0, std::string("MM\0*", 4)},
                 {"tiff", 0, std::string("II+\0", 4)},
                 {"tiff", 0, std::string("MM\0+", 4)},
                 {"openexr", 0, "v/1\x01"},
                 {"hdr", 0, "#?"},
                 {"gif", 0, "GIF8"},
                 {"bmp", 0, "BM"},
                 {"webp", 8, "WEBP"}};
  std::string head = file.text(0, 16);
  for (const auto &format : formats)
    if (head.compare(format.at < head.size() ? format.at : head.size(), format.magic.size(),
                     format.magic) == 0)
      return format.name;
  if (head.size() > 2 && head[0] == 'P' && std::strchr("123456fF", head[1])) return "pnm";
  if (strcasecmp(suffix.c_str(), "tga") == 0 && head.size() == 16) return "targa";
  refuse("is no image that can be read: it is none of PNG, JPEG, TIFF, EXR, Radiance's, GIF, BMP, "
         "WebP, PNM, PFM and TGA");
}

Says says_read(const Bytes &file, const std::string &suffix) {
  Says says;
  if (file.size() > says_most_bytes)
    refuse("is no image that can be read: it has more than 2 GiB; make it smaller");
  says.format = format_of(file, suffix);
  if (says.format == "png") read_png(file, says);
  if (says.format == "jpeg") read_jpeg(file, says);
  if (says.format == "tiff") read_tiff(file, says);
  if (says.format == "gif") read_gif(file);
  if (says.format == "webp") read_webp(file);
  if (says.format == "bmp") read_bmp(file);
  if (says.format == "hdr") read_radiance(file, says);
  return says;
}
