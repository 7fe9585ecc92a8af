/* gl_maps.h - shadow maps: the depth of the nearest surface as seen from a point of an aperture,
 * in all directions of the window. They are the layers of one texture, which has room for some at
 * a time.
 *
 * A shadow's edge is off by at most a texel of the map, and occluders nearer than a texel to the
 * surface that they stand on cast no shadow there. A map that several views share is seen from
 * the middle of them: in the penumbra it takes the group's light as whole or none. */
#ifndef GL_MAPS_H
#define GL_MAPS_H

#include <stdint.h>

#include "gl/gl_slides.h"
#include "scene/scene.h"

struct gl_maps {
  unsigned texture, target;
  unsigned mesh, corners, triangles; /* vertex array and its buffers */
  int indices;
  unsigned program;
  int size; /* texels a side */
  int room; /* layers */
  uint64_t drawn;
};

/* How many maps of size x size texels there is room for. */
int gl_maps_most(int size, const struct gl_limits *limits);

/* The scene's triangles are copied, relative to `origin`. */
enum result gl_maps_create(const struct scene *scene, const double origin[3], int size, int room,
                           const struct gl_limits *limits, struct gl_maps *maps,
                           struct error *error);
void gl_maps_free(struct gl_maps *maps); /* zeroed maps allowed */

/* Draws the maps of `count` groups from `first` on into layers from `layer` on. */
void gl_maps_draw(struct gl_maps *maps, const struct gl_slides *slides, int first, int count,
                  int layer);

/* Sets the uniforms of a program that reads the maps; `first` is the group whose map is, or would
 * be, in layer 0, and `unit` the first of two texture units. */
void gl_maps_set(const struct gl_maps *maps, const struct gl_slides *slides, int first,
                 unsigned program, int unit);

#endif
