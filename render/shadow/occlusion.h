/* occlusion.h - rays against the scene: the nearest surface, and shadow rays. One implementation,
 * by Embree (occlusion_embree.c); another ray tracer would be another file.
 *
 * Scene space, double at this interface; Embree computes in single precision.
 * Queries are thread-safe once it is created. */
#ifndef OCCLUSION_H
#define OCCLUSION_H

#include <stdbool.h>
#include <stddef.h>

#include "base/result.h"

struct scene;
struct occlusion; /* owned by whoever created it */

struct occlusion_hit {
  size_t triangle;
  double distance; /* in lengths of the direction */
  double share[2]; /* barycentric: the point is (1-a-b) v0 + a v1 + b v2 */
};

/* Keeps no reference to the scene's arrays. A scene without triangles hides nothing. */
enum result occlusion_create(const struct scene *scene, struct occlusion **occlusion,
                             struct error *error);
void occlusion_free(struct occlusion *occlusion); /* NULL allowed */

/* The nearest triangle, seen from either side. The origin is not lifted off its surface. */
bool occlusion_nearest(const struct occlusion *occlusion, const double origin[3],
                       const double direction[3], struct occlusion_hit *hit);

/* Where shadow rays of a receiver start: above the surface along the unit normal (geometric,
 * on the light's side), by more than the error of single precision: 1e-6 to 2e-6 of half the
 * scene's diagonal. Surfaces nearer to each other than that cast no shadows on each other. */
void occlusion_lift(const struct occlusion *occlusion, const double position[3],
                    const double normal[3], double lifted[3]);

/* May anything block any segment between a group of lifted receivers and the rectangle with
 * these corners? `false` is certain (shaft.h). */
bool occlusion_between(const struct occlusion *occlusion, const double (*lifted)[3], int count,
                       const double corners[4][3]);

/* Is the open segment between a lifted receiver and each of the points blocked? It ends four
 * lifts before the point, so that a surface in which the point lies (a ceiling around an
 * aperture) does not hide it. */
void occlusion_blocked(const struct occlusion *occlusion, const double lifted[3],
                       const double (*points)[3], int count, bool *blocked);

#endif
