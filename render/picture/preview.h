/* preview.h - a picture for the screen: 8-bit sRGB in a PNG, by libpng. */
#ifndef PREVIEW_H
#define PREVIEW_H

#include "base/output.h"
#include "base/picture.h"
#include "base/result.h"

/* The radiance that becomes white by default: 99 % of the pixels, by their brightest channel, are
 * at most 0.9 times as bright. 1 where the picture is black. Fails without memory. */
enum result preview_exposure(const struct picture *picture, double *white, struct error *error);

/* The same into an output that was begun, up to the commit. */
enum result preview_put(struct output *output, const struct picture *picture, double white,
                        const char *comment, struct error *error);

/* Writes the picture, radiance `white` as white, whole or not at all; what is darker than
 * black or brighter than white is clipped. Text chunks "Comment" and "Exposure" keep the
 * comment and `white`. */
enum result preview_write(const char *path, const struct picture *picture, double white,
                          const char *comment, struct error *error);

#endif
