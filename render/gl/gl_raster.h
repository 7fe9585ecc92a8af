/* gl_raster.h - what a camera sees of a scene, rasterised: receivers as gl_sum.h takes them, and
 * the rest of a struct shade_hit for each pixel. The surfaces and their normals are those of rays
 * through the middles of the pixels, but for edges: corners are rounded to 1/256 pixel. */
#ifndef GL_RASTER_H
#define GL_RASTER_H

#include <stdbool.h>

#include "gl/gl_sum.h"
#include "scene/camera.h"
#include "scene/scene.h"

/* Triangles of one material. */
struct gl_raster_part {
  int first, count; /* corners */
  unsigned texture; /* 0: none; owned by textures[] */
};

struct gl_raster {
  const struct scene *scene;
  double origin[3]; /* of the corners */
  unsigned mesh, corners, program;
  struct gl_raster_part *parts; /* [materials]; owned */
  unsigned *textures;           /* [textures]; owned */
  bool glossy;                  /* some material has a highlight */
};

/* The scene outlives the raster. */
enum result gl_raster_create(const struct scene *scene, const struct gl_limits *limits,
                             struct gl_raster *raster, struct error *error);
void gl_raster_free(struct gl_raster *raster); /* zeroed raster allowed */

/* The reflectances and the radiance of pixels; owned textures of the receivers' size. */
struct gl_surfaces {
  unsigned diffuse, specular;
  unsigned shows; /* radiance without lights; w: 1 where there is a surface, else 0 */
  unsigned depth, target;
};

/* The target draws into the receivers' textures too; they outlive the surfaces. */
enum result gl_surfaces_create(const struct gl_receivers *receivers, struct gl_surfaces *surfaces,
                               struct error *error);
void gl_surfaces_free(struct gl_surfaces *surfaces); /* zeroed surfaces allowed */

/* Row 0 is the bottom one. Positions become relative to `origin`. */
void gl_raster_draw(const struct gl_raster *raster, const struct camera *camera,
                    const double origin[3], const double background[3],
                    const struct gl_receivers *receivers, const struct gl_surfaces *surfaces);

#endif
