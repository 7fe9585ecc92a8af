/* between.h - may anything stand between a group of receivers and an aperture? Where not, no
 * shadow ray is traced.
 *
 * The answer is conservative: `false` is certain. Nothing blocks a segment that does not lie
 * within the convex hull of its ends (shaft culling: Haines and Wallace, "Shaft culling for
 * efficient ray-traced radiosity", 1991), and a triangle does not block what lies wholly on
 * one side of its plane, so that the floor does not shadow what stands on it. */
#ifndef BETWEEN_H
#define BETWEEN_H

#include <stdbool.h>

#include "slab_error.h"

struct scene;
struct between; /* owned by whoever made it; thread-safe once made */

/* Keeps no reference to the scene. */
enum slab_result between_create(const struct scene *scene, struct between **between,
                                struct slab_error *error);
void between_free(struct between *between); /* NULL allowed */

/* `receivers` are lifted off their surfaces (occlusion.h); `corners` are the aperture's. */
bool between_any(const struct between *between, const double (*receivers)[3], int count,
                 const double corners[4][3]);

#endif
