/* shaft.h - may anything stand between a group of receivers and an aperture? If not, no shadow
 * rays are traced.
 *
 * The answer is conservative: `false` is certain. Nothing blocks a segment that does not lie
 * within the convex hull of its ends (shaft culling: Haines and Wallace, "Shaft culling for
 * efficient ray-traced radiosity", 1991), and a triangle does not block what lies wholly on
 * one side of its plane, so that the floor does not shadow what stands on it. */
#ifndef SHAFT_H
#define SHAFT_H

#include <stdbool.h>

#include "base/result.h"

struct scene;
struct shaft_tree; /* owned by whoever made it; thread-safe once made */

/* Keeps no reference to the scene. */
enum result shaft_tree_create(const struct scene *scene, struct shaft_tree **tree,
                              struct error *error);
void shaft_tree_free(struct shaft_tree *tree); /* NULL allowed */

/* `receivers` are lifted off their surfaces (occlusion.h); `corners` are the aperture's. */
bool shaft_may_block(const struct shaft_tree *tree, const double (*receivers)[3], int count,
                     const double corners[4][3]);

#endif
