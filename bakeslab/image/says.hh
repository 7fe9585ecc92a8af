/* says.hh - what an image file says of itself in its own bytes and OpenImageIO 2.4 does not tell,
 * or tells wrong. Refusals are thrown as std::runtime_error, in words that follow the file's name.
 */
#ifndef SAYS_H
#define SAYS_H

#include <optional>
#include <string>

#include "image/bytes.hh"
#include "image/colours.hh"

constexpr uint64_t says_most_pixels = 1 << 27;          /* 16384 x 8192: 2 GB of memory at most */
constexpr uint64_t says_most_bytes = uint64_t(1) << 31; /* PNM are read as a whole */
constexpr char says_too_large[] =
    "is no image that can be read: it has more than 2^27 pixels; make it smaller";

struct Says {
  std::string format;                 /* OpenImageIO's name of it */
  bool has_profile = false;           /* an ICC profile */
  int orientation = 0;                /* as EXIF numbers it; 0: OpenImageIO knows */
  double pixel_aspect = 0;            /* width by height; 0: OpenImageIO knows */
  std::optional<Curve> curve;         /* from values to light; none: OpenImageIO knows */
  std::optional<Primaries> primaries; /* none: Rec. 709's, or OpenImageIO knows */
  double gain[3] = {1, 1, 1};         /* of linear light */
};

/* The format by the first bytes; only TGA, which has none, by the suffix of the file's name. */
Says says_read(const Bytes &bytes, const std::string &suffix);

#endif
