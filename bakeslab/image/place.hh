/* place.hh - where the stored pixels of an image lie in the picture that it shows: the display
 * window of OpenEXR, then the orientation of EXIF (2.3, tag 274). */
#ifndef PLACE_H
#define PLACE_H

#include <utility>

struct Place {
  int width, height;           /* of what is stored */
  int full_width, full_height; /* of the display window */
  int left, top;               /* of what is stored, in the display window */
  int orientation;             /* 1 to 8 */

  bool turned() const {
    return orientation >= 5;
  }
  int shown_width() const {
    return turned() ? full_height : full_width;
  }
  int shown_height() const {
    return turned() ? full_width : full_height;
  }

  /* The stored pixel, by its number from the top left, that is shown at x, y; -1 for none. */
  long find(int x, int y) const {
    if (turned()) std::swap(x, y);
    bool flops = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    bool flips = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    int column = (flops ? full_width - 1 - x : x) - left;
    int row = (flips ? full_height - 1 - y : y) - top;
    bool there = column >= 0 && column < width && row >= 0 && row < height;
    return there ? long(row) * width + column : -1;
  }
};

#endif
