/* gl_maps.h - shadow maps: what stands next to a point of an aperture, in all directions of the
 * window. A few are kept at a time, as the layers of one texture.
 *
 * A shadow's edge is off by at most a texel of the map, and things nearer than a texel to what
 * they stand on throw none there. A map that several views share stands in the middle of
 * them: in the rim of shadows it takes the group's light as whole or none. */
#ifndef GL_MAPS_H
#define GL_MAPS_H

#include <stdint.h>

#include "gl_slides.h"
#include "scene.h"

struct gl_maps {
  unsigned texture, target;
  unsigned mesh, corners, triangles; /* vertex array and its buffers */
  int indices;
  unsigned program;
  int size; /* texels a side */
  int room; /* layers */
  uint64_t drawn;
};

/* The scene's triangles are copied, relative to `origin`. */
enum slab_result gl_maps_create(const struct scene *scene, const double origin[3], int size,
                                const struct gl_limits *limits, struct gl_maps *maps,
                                struct slab_error *error);
void gl_maps_free(struct gl_maps *maps); /* zeroed maps allowed */

/* Draws the maps of groups first to first + count - 1, count <= room, into layers from 0. */
void gl_maps_draw(struct gl_maps *maps, const struct gl_slides *slides, int first, int count);

/* What a program that reads the maps has to know; `unit` is the first of two texture units. */
void gl_maps_set(const struct gl_maps *maps, const struct gl_slides *slides, int first,
                 unsigned program, int unit);

#endif
