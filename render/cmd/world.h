/* world.h - what a command was asked for, and what it works on: lights, what its method makes of
 * them first, a mesh and what that hides. */
#ifndef WORLD_H
#define WORLD_H

#include "cmd/options.h"
#include "cmd/picture_options.h"
#include "gather/gather.h"
#include "gl/gl_sum.h"
#include "picture/shade.h"
#include "scene/scene.h"

struct world {
  struct options options;      /* for options_argp, or options_lights_argp; owned */
  struct picture_options view; /* for picture_options_argp */
  struct light *lights;        /* [light_count]; owned */
  int light_count;
  struct gather_prepared prepared; /* owned */
  struct scene scene;              /* owned */
  struct occlusion *occlusion;     /* NULL until a command creates it; owned */
};

/* Loads the lights. Then refuses, before any work, outputs that cannot be written, that are one
 * file, or that are one of the slabs or the mesh (output_check); NULL among them is skipped. All
 * but the options is zeroed before; world_free also after a failure. */
enum result world_load_lights(struct world *world, const char *const *outputs, int count,
                              struct error *error);

/* The luminance, in cd/m2, of 1 in pictures: a watt of light counts 179 lm, as in Radiance, and
 * where the lights' unit is relative, 1 is 1 cd/m2. */
double world_luminance(const struct world *world);

/* What the options' method needs for so many receivers (gather_prepare). */
enum result world_prepare(struct world *world, uint64_t receivers, struct error *error);

/* Loads the mesh, finds the camera that is named, and says in notes what was repaired and, of
 * SCENE_SURFACES, what is ignored and where a lamp's size seems to be in another unit. */
enum result world_load_scene(struct world *world, enum scene_needs needs, struct error *error);

void world_free(struct world *world);

/* Has any of the scene's materials a highlight? Returns it, or NULL. */
const struct scene_material *world_glossy(const struct world *world);

/* How the world is summed, by the CPU or by the method gl; without `shadows` light passes through
 * the mesh. */
struct gather_settings world_gather(const struct world *world, bool shadows);
struct gl_sum_settings world_gl(const struct world *world, bool shadows);

/* What the camera sees of it. */
struct shade world_shade(const struct world *world);

#endif
