/* world.h - what a command works on: lights, what its method makes of them first, a mesh and
 * what that hides. */
#ifndef WORLD_H
#define WORLD_H

#include "cmd/options.h"
#include "cmd/picture_options.h"
#include "gather/gather.h"
#include "gl/gl_sum.h"
#include "picture/shade.h"
#include "scene/scene.h"

struct world {
  struct light *lights; /* [light_count]; owned */
  int light_count;
  struct gather_prepared prepared; /* owned */
  struct scene scene;              /* owned */
  struct occlusion *occlusion;     /* NULL until a command creates it; owned */
};

/* Loads the lights. Then refuses, before any work, outputs that cannot be written, that are one
 * file, or that are one of the slabs or `mesh` (output_check); NULL among them is skipped. The
 * world is zeroed before; world_free also after a failure. */
enum result world_load_lights(struct world *world, const struct options *options, const char *mesh,
                              const char *const *outputs, int count, struct error *error);

/* Loads the mesh, and says in a note what was repaired. */
enum result world_load_scene(struct world *world, const struct options *options, const char *mesh,
                             enum scene_needs needs, struct error *error);

void world_free(struct world *world);

/* Has any of the scene's materials a highlight? Returns it, or NULL. */
const struct scene_material *world_glossy(const struct world *world);

/* How the world is summed, by the CPU or by the method gl; without `shadows` light passes through
 * the mesh. */
struct gather_settings world_gather(const struct world *world, const struct options *options,
                                    bool shadows);
struct gl_sum_settings world_gl(const struct world *world, const struct options *options,
                                bool shadows);

/* What the camera sees of it. */
struct shade world_shade(const struct world *world, const struct picture_options *view);

#endif
