/* gl_show.h - the picture: from the receivers' light to radiance, and on to a screen. */
#ifndef GL_SHOW_H
#define GL_SHOW_H

#include "base/picture.h"
#include "base/result.h"
#include "gl/gl_raster.h"

struct gl_show {
  int width, height;
  unsigned radiance, target;     /* the picture; row 0 is the bottom one */
  unsigned before, full;         /* earlier ones */
  unsigned lamps;                /* radiance of lamps that are seen, and their distance; 0: none */
  unsigned words;                /* text on the screen: one byte a pixel, row 0 at the top */
  unsigned samples, few;         /* pixels of which the change is measured; their frame buffer */
  unsigned draw, compare, shown; /* programs */
  unsigned empty;                /* vertex array without attributes */
};

enum result gl_show_create(struct gl_show *show, struct error *error);
void gl_show_free(struct gl_show *show); /* zeroed show allowed */

/* Makes the textures for pictures of the receivers' size. */
enum result gl_show_resize(struct gl_show *show, const struct gl_receivers *receivers,
                           struct error *error);

/* Sets the lamps that are seen (viewer_lamps.h): four floats a pixel, row 0 at the top. */
void gl_show_set_lamps(struct gl_show *show, const float *pixels);

/* Draws the picture: shows + (diffuse E + specular G) unit/pi, where E and G are what the
 * receivers hold, or a nearer lamp. `from` is the camera, relative to the positions' origin. */
void gl_show_draw(const struct gl_show *show, const struct gl_receivers *receivers,
                  const struct gl_surfaces *surfaces, double unit, const double from[3]);

/* Copies the picture to `before` or `full`; relative RMS of its difference from one of these, by
 * 64 x 64 of the pixels, 0 where that is black. */
void gl_show_keep(const struct gl_show *show, unsigned earlier);
double gl_show_change(const struct gl_show *show, unsigned earlier);

/* The picture, row 0 at the top, without errors; to be freed with picture_free. */
enum result gl_show_read(const struct gl_show *show, struct picture *picture, struct error *error);

/* Puts the picture on a frame buffer (0: the window's): radiance `white` as white, by the curve
 * of sRGB, with words over it: width x height bytes, 0 nothing, 1 dim, 255 a letter. */
void gl_show_screen(const struct gl_show *show, double white, const unsigned char *words,
                    unsigned target);

#endif
