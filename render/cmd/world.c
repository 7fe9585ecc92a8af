#include "cmd/world.h"

#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "cli/cli.h"
#include "shadow/occlusion.h"

enum result world_load_lights(struct world *world, const char *const *outputs, int count,
                              struct error *error) {
  const struct options *options = &world->options;
  size_t lights = (size_t)options->light_count;
  const char **inputs = calloc(lights + 1, sizeof *inputs);
  enum result result = RESULT_OK;
  world->lights = calloc(lights, sizeof *world->lights);
  if (!world->lights || !inputs) result = result_no_memory(error);
  while (result == RESULT_OK && world->light_count < options->light_count) {
    int k = world->light_count++;
    result = light_load(options->lights[k], &world->lights[k], error);
    inputs[k] = world->lights[k].path;
  }
  if (result == RESULT_OK) {
    inputs[lights] = world->view.mesh;
    result = output_check(outputs, count, inputs, options->light_count + 1, error);
  }
  free(inputs);
  return result;
}

enum result world_prepare(struct world *world, uint64_t receivers, struct error *error) {
  return gather_prepare(world->lights, world->light_count, world->options.method, receivers,
                        world->options.threads, &world->prepared, error);
}

enum result world_load_scene(struct world *world, enum scene_needs needs, struct error *error) {
  const char *mesh = world->view.mesh;
  char note[256] = "";
  enum result result = scene_load(mesh, needs, world->options.repair, &world->scene, note, error);
  if (result == RESULT_OK && *note) cli_note("%s: note: %s", mesh, note);
  return result;
}

void world_free(struct world *world) {
  occlusion_free(world->occlusion);
  scene_free(&world->scene);
  gather_prepared_free(&world->prepared);
  for (int k = 0; k < world->light_count; ++k) light_free(&world->lights[k]);
  free(world->lights);
  options_free(&world->options);
  *world = (struct world){0};
}

const struct scene_material *world_glossy(const struct world *world) {
  for (int k = 0; k < world->scene.material_count; ++k)
    if (scene_glossy(&world->scene.materials[k])) return &world->scene.materials[k];
  return NULL;
}

struct gather_settings world_gather(const struct world *world, bool shadows) {
  const struct options *options = &world->options;
  return (struct gather_settings){.lights = world->lights,
                                  .light_count = world->light_count,
                                  .prepared = &world->prepared,
                                  .method = options->method,
                                  .tolerance = options->tolerance,
                                  .level = options->level,
                                  .seed = options->seed,
                                  .occlusion = shadows ? world->occlusion : NULL,
                                  .shadow_grid = options->shadow_grid,
                                  .shadow_edge = options->shadow_edge,
                                  .all_effects = options->all_effects};
}

struct gl_sum_settings world_gl(const struct world *world, bool shadows) {
  return (struct gl_sum_settings){.lights = world->lights,
                                  .light_count = world->light_count,
                                  .levels = world->prepared.levels,
                                  .level = world->options.level,
                                  .occluders = shadows ? &world->scene : NULL,
                                  .map_size = world->options.shadow_map,
                                  .groups = world->options.shadow_groups,
                                  .separate = world->options.gl_separate};
}

struct shade world_shade(const struct world *world) {
  const struct picture_options *view = &world->view;
  struct shade shade = {.scene = &world->scene,
                        .occlusion = world->occlusion,
                        .lights = world->lights,
                        .light_count = world->light_count,
                        .camera = view->camera,
                        .width = view->size[0],
                        .height = view->size[1]};
  memcpy(shade.background, view->background, sizeof shade.background);
  return shade;
}
