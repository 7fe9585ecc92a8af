/* image_error.h - the error of a finished picture against the lamps themselves, as the sum of its
 * parts: what the program knows of each, told together. */
#ifndef IMAGE_ERROR_H
#define IMAGE_ERROR_H

#include "picture/image.h"

/* RMS of the error of what the lamps light over the mean of what they light, over the pixels that
 * show a surface; of all channels. NAN: not known. */
struct image_error {
  double noise;      /* of the slabs' samples, as their bakes recorded it */
  double resolution; /* of the slabs: what finer positions and directions would change */
  double logluv;     /* rounding of the slabs' samples to LogLuv */
  double sum;        /* by the method and its tolerance, and by pixels that share rays */
  double shadows;    /* their edges, by the size to which they are looked at */
  double all;        /* what is known of these, in quadrature; NAN where the lamps light nothing */
};

/* Estimates it for a picture by the settings. Takes a few hundred receivers' light some ten times
 * over; the same for any number of threads. */
enum result image_error_estimate(const struct image_settings *settings,
                                 const struct picture *picture, struct image_error *told,
                                 struct error *error);

/* One line: "noise 1.2 %, ...". */
enum { IMAGE_ERROR_TEXT = 256 };
void image_error_text(const struct image_error *told, char text[IMAGE_ERROR_TEXT]);

#endif
