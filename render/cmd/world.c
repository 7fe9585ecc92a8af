#include "cmd/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "cli/cli.h"
#include "shadow/occlusion.h"

/* Lights of several units add up to none, and a Scale of lumens may be meant otherwise. */
static void tell_brightness(const struct world *world) {
  const char *unit = light_unit(&world->lights[0]);
  for (int k = 0; k < world->light_count; ++k) {
    const struct light *light = &world->lights[k];
    if (light->resized)
      cli_note("%s: note: lumens= with scale=%g makes it a lamp of another size; where scale "
               "converts units, add metres=M, of the scene's unit",
               light->path, light->scale);
    if (strcmp(light_unit(light), unit) != 0)
      cli_note("%s: note: its radiance is in \"%s\", that of %s in \"%s\"; with lumens= all "
               "are in cd/m2",
               light->path, light_unit(light), world->lights[0].path, unit);
  }
}

double world_luminance(const struct world *world) {
  return strcmp(light_unit(&world->lights[0]), "W/(sr m2)") ? 1 : SLAB_WATT_LUMENS;
}

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
  if (result == RESULT_OK) tell_brightness(world);
  return result;
}

enum result world_prepare(struct world *world, uint64_t receivers, struct error *error) {
  return gather_prepare(world->lights, world->light_count, world->options.method, receivers,
                        world->options.threads, &world->prepared, error);
}

static void tell_ignored(const struct scene *scene, const struct picture_options *view) {
  char names[400];
  for (int k = 0; k < SCENE_IGNORED; ++k)
    if (scene->ignored[k]) cli_note("%s: note: %s", view->mesh, scene->ignored[k]);
  if (scene->camera_count > 0 && !view->camera_name)
    cli_note("%s: note: cameras of the file are ignored, unless --camera names one: %s", view->mesh,
             scene_camera_names(scene, sizeof names, names));
}

/* The longest side of an aperture, in scene units. */
static double width_of(const struct light *light) {
  double width = 0;
  for (int page = 0; page < light->count; ++page)
    for (int k = 0; k < 2; ++k) width = fmax(width, 2 * light->pages[page].axes[k].half);
  return width;
}

/* Lamps as large as the whole scene, or a mere point in it, are rare. */
static bool fits(double width, double size) {
  return width < size && width > size / 3000;
}

/* A scale= that was forgotten: the slab knows its unit, and the scene's is known or must be
 * another. */
static void tell_units(const struct world *world, const char *mesh) {
  double low[3], high[3], size = 0;
  scene_box(&world->scene, low, high);
  for (int c = 0; c < 3; ++c) size = fmax(size, high[c] - low[c]);
  for (int k = 0; k < world->light_count; ++k) {
    const struct light *light = &world->lights[k];
    double unit = light->pages[0].slab.metres_per_unit, width = width_of(light);
    bool told = unit == 1 || light->scale != 1;
    for (int before = 0; before < k; ++before)
      told |= !strcmp(world->lights[before].path, light->path);
    if (told) continue;
    if (world->scene.metres)
      cli_note("%s: note: its unit is %g m, and %s is in metres: scale=%g makes it as large as it "
               "is",
               light->path, unit, mesh, unit);
    else if (!fits(width, size) && fits(width * unit, size))
      cli_note("%s: note: it is %.3g wide, and all of %s %.3g: its unit is %g m; scale=%g if the "
               "mesh is in metres",
               light->path, width, mesh, size, unit, unit);
  }
}

enum result world_load_scene(struct world *world, enum scene_needs needs, struct error *error) {
  struct picture_options *view = &world->view;
  const char *mesh = view->mesh;
  char note[256] = "";
  enum result result = scene_load(mesh, needs, world->options.repair, &world->scene, note, error);
  if (result == RESULT_OK && *note) cli_note("%s: note: %s", mesh, note);
  if (result == RESULT_OK && view->camera_name)
    result = scene_find_camera(&world->scene, mesh, view->camera_name,
                               (double)view->size[0] / view->size[1], &view->camera, error);
  if (result != RESULT_OK || needs != SCENE_SURFACES) return result;
  tell_ignored(&world->scene, view);
  tell_units(world, mesh);
  return RESULT_OK;
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
