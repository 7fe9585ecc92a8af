/* shade.h - the radiance that comes along a camera ray: of a surface, of a lamp that the
 * camera looks into, or of the background.
 *
 * A surface shows emission + diffuse E/pi + specular G/pi (scene.h, gather.h). It is seen and
 * lit from both sides, as POV-Ray does: normals are turned towards the eye. With interpolated
 * normals the tangent plane that clips the light is that of the interpolated normal, and
 * shadow rays start above the triangle. */
#ifndef SHADE_H
#define SHADE_H

#include <stdbool.h>
#include <stdint.h>

#include "gather/gather.h"
#include "scene/camera.h"

struct occlusion;
struct scene;

/* What is looked at, and from where. */
struct shade {
  const struct scene *scene;
  const struct occlusion *occlusion; /* what the camera sees, whether it casts shadows or not */
  const struct light *lights;
  int light_count;
  double background[3];
  struct camera camera;
  int width, height; /* of the picture, in pixels */
};

/* What a ray meets. */
struct shade_hit {
  bool lit;        /* by the lights, as `receiver` */
  double shows[3]; /* radiance without them */
  double diffuse[3], specular[3];
  struct receiver receiver; /* if lit */
};

/* The ray through (x, y), in pixels from the picture's top left corner; `index` becomes the
 * receiver's. */
void shade_ray(const struct shade *shade, double x, double y, uint64_t index,
               struct shade_hit *hit);

/* The radiance, with what the receiver gathered (NULL if it is not lit), and its predicted
 * absolute error, INFINITY where that is not known. */
void shade_radiance(const struct shade_hit *hit, const struct gathered *gathered, double rgb[3],
                    double error[3]);

#endif
