/* gl_slides.h - a page's views as slides, which are projected onto receivers (section 4.3).
 *
 * A slide is a layer of a texture array; where there are more views than an array has layers,
 * there are several arrays. Black views are left out. The others are ordered so that the first n
 * of them are spread over the aperture, for any n: a sum can stop anywhere, and go on.
 *
 * The views of a group share a shadow map. There are `groups` x `groups` groups, or one for each
 * view. */
#ifndef GL_SLIDES_H
#define GL_SLIDES_H

#include "gl/gl_context.h"
#include "light/light.h"

struct gl_slides_array {
  unsigned texture;
  int first, count; /* of the order */
};

struct gl_slides {
  const struct light_page *page;
  double gain[3];   /* of the page */
  double scale;     /* radiance = scale x what the slides hold */
  double center[3]; /* of the page, relative to the origin */
  int count;        /* views that are not black */
  double (*at)[4];  /* [count]: a and b; layer within its array; group */
  int arrays;
  struct gl_slides_array *array;
  int groups;                       /* that have views; in order of their first */
  double (*middle)[2];              /* [groups]: a and b of their middles */
  double group_half[2];             /* sides of a group, halved */
  unsigned views, views_buffer;     /* `at` as a texture */
  unsigned middles, middles_buffer; /* `middle` as a texture */
  bool behind; /* nothing is in front of the page: gl_sum.h skips it; false at first */
  bool *drawn; /* [groups]: is the map drawn, where maps are kept; false at first */
};

/* `page`, which outlives the slides, and `gain` are set beforehand, all else is zeroed. `origin` is
 * subtracted from positions, so that they keep their digits in single precision; sides of apertures
 * and distances from the origin beyond 1e-15 and 1e15 are refused. groups: 0: each view. together:
 * the views of a group follow each other. */
enum result gl_slides_create(struct gl_slides *slides, const double origin[3], int groups,
                             bool together, const struct gl_limits *limits, struct error *error);
void gl_slides_free(struct gl_slides *slides); /* zeroed slides allowed */

#endif
