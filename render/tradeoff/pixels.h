/* pixels.h - the pixels of a picture by which ways are compared: those that show a surface of the
 * mesh. Lamps that the camera looks into, and the background, are left out: POV-Ray shows other
 * things there. */
#ifndef PIXELS_H
#define PIXELS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/picture.h"
#include "picture/shade.h"

struct pixels {
  int width, height;
  size_t count;     /* of those that are compared */
  bool *compared;   /* [width * height]; owned */
  float *shows;     /* [3 * width * height]: radiance without the lamp; owned */
  double *distance; /* [width * height]: along the normal of the nearest page that the surface is
                       before, in lamp units; 0: it is before none; owned */
};

/* From the rays through the middles of pixels. Free with pixels_free, also after a failure. */
enum result pixels_find(const struct shade *shade, struct pixels *pixels, struct error *error);
void pixels_free(struct pixels *pixels); /* zeroed allowed */

/* Reads a picture of that size, in OpenEXR; refuses one that is not finite. */
enum result pixels_read(const struct pixels *pixels, const char *path, struct picture *picture,
                        struct error *error);

/* Leaves out the pixels that do not show the mesh in `marked` (pov.h). */
void pixels_keep_marked(struct pixels *pixels, const struct picture *marked);

/* RMS of the difference over the mean of the truth; colours as vectors. */
double pixels_error(const struct pixels *pixels, const struct picture *picture,
                    const struct picture *truth);

/* Mean of the lamp's light, and its mean distance from the pages, weighted by the light. */
double pixels_light(const struct pixels *pixels, const struct picture *picture, double *distance);

#endif
