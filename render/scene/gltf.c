/* gltf.c - reads a glTF file from end to end, see gltf.h. */
#include "scene/gltf.h"

#include <stdio.h>
#include <string.h>

/* Notes by the name of an object, or by its number. */
static enum result note(struct gltf *gltf, enum scene_ignored kind, const json_t *object,
                        size_t number, struct error *error) {
  char digits[32];
  const char *name = json_string_value(json_object_get(object, "name"));
  snprintf(digits, sizeof digits, "%zu", number);
  return scene_ignore(gltf->loading, kind, name && *name ? name : digits) ? RESULT_OK
                                                                          : result_no_memory(error);
}

/* A still picture of one scene has none of these. */
static enum result note_others(struct gltf *gltf, struct error *error) {
  const json_t *scenes = json_object_get(gltf->root, "scenes"), *one;
  json_int_t shown = json_integer_value(json_object_get(gltf->root, "scene"));
  enum result result = RESULT_OK;
  size_t k;
  json_array_foreach(scenes, k, one) {
    if (result == RESULT_OK && (json_int_t)k != shown)
      result = note(gltf, SCENE_OTHERS, one, k, error);
  }
  json_array_foreach(json_object_get(gltf->root, "animations"), k, one) {
    if (result == RESULT_OK) result = note(gltf, SCENE_ANIMATIONS, one, k, error);
  }
  return result;
}

static enum result read_node(struct gltf *gltf, size_t number, struct error *error) {
  const json_t *node = json_array_get(json_object_get(gltf->root, "nodes"), number);
  enum result result = RESULT_OK;
  if (json_object_get(node, "mesh")) result = gltf_mesh(gltf, node, &gltf->places[number], error);
  if (result == RESULT_OK && gltf->loading->needs == SCENE_SURFACES &&
      gltf_extension(node, "KHR_lights_punctual"))
    result = note(gltf, SCENE_LIGHTS, node, number, error);
  return result;
}

static enum result read_scene(struct gltf *gltf, struct error *error) {
  const struct scene_loading *loading = gltf->loading;
  enum result result = gltf_open(gltf, error);
  if (result == RESULT_OK) result = gltf_extensions(gltf, error);
  if (result == RESULT_OK) result = gltf_nodes(gltf, error);
  if (result == RESULT_OK && loading->needs == SCENE_SURFACES) {
    result = gltf_materials(gltf, error);
    if (result == RESULT_OK) result = gltf_cameras(gltf, error);
    if (result == RESULT_OK) result = note_others(gltf, error);
  }
  for (size_t k = 0; k < gltf->shown && result == RESULT_OK; ++k)
    result = read_node(gltf, gltf->order[k], error);
  return result;
}

enum result gltf_load(struct scene_loading *loading, struct error *error) {
  struct gltf gltf = {.loading = loading};
  unsigned long mark = json_mark();
  enum result result = read_scene(&gltf, error);
  if (result == RESULT_OK) result = json_whole(mark, error);
  gltf_close(&gltf);
  return result_at(result, error, "%s", loading->path);
}
