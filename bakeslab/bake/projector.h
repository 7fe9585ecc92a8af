/* projector.h - a light made without tracing: a slide projector that throws an image (Heidrich et
 * al. 1998, section 5). A ray has the colour of the picture where it passes the
 * focus plane. On that plane the picture is sharp. At the distance d, focus and aperture alone
 * spread each point over a rectangle: the aperture times |d - focus|/focus. */
#ifndef PROJECTOR_H
#define PROJECTOR_H

#include "base/picture.h"
#include "slab/slab.h"

enum { PROJECTOR_ST = 256 }; /* at most, along the picture's longer side, unless given */

struct projector {
  double aperture[2]; /* width and height; all lengths in lamp units */
  double focus;       /* distance of the focus plane */
  double width;       /* of the picture there; pixels are square */
  double white;       /* radiance where the image is 1; 0: as flux says */
  double flux;        /* of a white picture, with lengths in metres */
  double metres_per_unit;
  const char *unit; /* of radiance */
  int uv[2];        /* all positions have the same samples */
  int st[2];        /* 0: the image's pixels, but at most PROJECTOR_ST */
};

/* Refuses what makes no slab whatever the image. Says what is wrong without naming a file. */
enum result projector_check(const struct projector *projector, struct error *error);

/* The projector at the origin, shining along z, the picture upright as seen from behind it: u is
 * x, v is y. Samples are the image's means over their cells; more than it has pixels are
 * interpolated. The caller frees the slab. */
enum result projector_slab(const struct projector *projector, const struct picture *image,
                           struct slab *slab, struct error *error);

#endif
