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

struct occlusion;
struct scene;

struct shade {
  const struct scene *scene;
  const struct occlusion *occlusion; /* what the camera sees, whether it casts shadows or not */
  const struct light *lights;
  int light_count;
  double background[3];
};

/* What a ray meets. */
struct shade_hit {
  bool lit;        /* by the lights, as `receiver` */
  double shows[3]; /* radiance without them */
  double diffuse[3], specular[3];
  struct receiver receiver; /* if lit */
};

/* `direction` is unit; `index` becomes the receiver's. */
void shade_ray(const struct shade *shade, const double origin[3], const double direction[3],
               uint64_t index, struct shade_hit *hit);

/* The radiance, with what the receiver gathered (NULL if it is not lit), and how far off it
 * is predicted to be, INFINITY where that is not known. */
void shade_radiance(const struct shade_hit *hit, const struct gathered *gathered, double rgb[3],
                    double error[3]);

#endif
