/* slab_logluv.h - our RGB to the XYZ that LogLuv TIFFs hold, and back. Linear
 * Rec. 709 primaries, white D65 at (0.3127, 0.3290). */
#ifndef SLAB_LOGLUV_H
#define SLAB_LOGLUV_H

static inline void slab_logluv_from_rgb(const float rgb[3], double xyz[3]) {
  static const double matrix[3][3] = {
      {0.41239079926595934, 0.357584339383878, 0.1804807884018343},
      {0.21263900587151027, 0.715168678767756, 0.07219231536073371},
      {0.01933081871559182, 0.11919477979462598, 0.9505321522496607}};
  for (int row = 0; row < 3; ++row) {
    xyz[row] = 0;
    for (int c = 0; c < 3; ++c) xyz[row] += matrix[row][c] * (double)rgb[c];
  }
}

static inline void slab_logluv_to_rgb(const double xyz[3], float rgb[3]) {
  static const double matrix[3][3] = {
      {3.2409699419045226, -1.537383177570094, -0.4986107602930034},
      {-0.9692436362808796, 1.8759675015077202, 0.04155505740717559},
      {0.05563007969699366, -0.20397695888897652, 1.0569715142428786}};
  for (int row = 0; row < 3; ++row)
    rgb[row] = (float)(matrix[row][0] * xyz[0] + matrix[row][1] * xyz[1] + matrix[row][2] * xyz[2]);
}

#endif
