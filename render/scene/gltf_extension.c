/* gltf_extension.c - extensions of glTF, see gltf.h: what is read, what is told, what is refused.
 */
#include <string.h>

#include "scene/gltf.h"

static const char *const read_here[] = {"KHR_mesh_quantization",
                                        "KHR_texture_transform",
                                        "KHR_materials_emissive_strength",
                                        "KHR_materials_pbrSpecularGlossiness",
                                        "EXT_texture_webp",
                                        "MSFT_texture_dds",
                                        "KHR_materials_variants",
                                        NULL};

/* These change nothing, or are told otherwise, or a file that does not require them has the same
 * without them. */
static const char *const silent[] = {"KHR_lights_punctual",
                                     "KHR_materials_transmission",
                                     "KHR_materials_volume",
                                     "KHR_animation_pointer",
                                     "KHR_texture_basisu",
                                     "EXT_texture_avif",
                                     "KHR_draco_mesh_compression",
                                     "KHR_materials_volume_scatter",
                                     "EXT_meshopt_compression",
                                     "KHR_meshopt_compression",
                                     "KHR_xmp",
                                     "KHR_xmp_json_ld",
                                     "FB_ngon_encoding",
                                     NULL};

/* What only surfaces and lights have; shapes are the same without. */
static const char *const of_surfaces[] = {
    "KHR_materials_", "KHR_texture_", "EXT_texture_",     "MSFT_texture_",
    "KHR_lights_",    "EXT_lights_",  "ADOBE_materials_", NULL};

static bool is_among(const char *name, const char *const *names) {
  for (; *names; ++names)
    if (strcmp(name, *names) == 0) return true;
  return false;
}

static bool begins_with(const char *name, const char *const *starts) {
  for (; *starts; ++starts)
    if (strncmp(name, *starts, strlen(*starts)) == 0) return true;
  return false;
}

static enum result note(struct gltf *gltf, const char *name, struct error *error) {
  if (is_among(name, read_here) || is_among(name, silent)) return RESULT_OK;
  return scene_ignore(gltf->loading, SCENE_EXTENSIONS, name) ? RESULT_OK : result_no_memory(error);
}

enum result gltf_extensions(struct gltf *gltf, struct error *error) {
  bool surfaces = gltf->loading->needs == SCENE_SURFACES;
  const json_t *one;
  enum result result = RESULT_OK;
  size_t k;
  json_array_foreach(json_object_get(gltf->root, "extensionsRequired"), k, one) {
    const char *name = json_string_value(one);
    if (!name || is_among(name, read_here) || (!surfaces && begins_with(name, of_surfaces)))
      continue;
    if (result == RESULT_OK) result = scene_unread(gltf->loading, error, "requires %s", name);
  }
  json_array_foreach(json_object_get(gltf->root, "extensionsUsed"), k, one) {
    const char *name = json_string_value(one);
    if (result == RESULT_OK && name && surfaces) result = note(gltf, name, error);
  }
  return result;
}

enum result gltf_extensions_of(struct gltf *gltf, const json_t *material, struct error *error) {
  void *at = json_object_iter(json_object_get(material, "extensions"));
  enum result result = RESULT_OK;
  for (json_t *all = json_object_get(material, "extensions"); at && result == RESULT_OK;
       at = json_object_iter_next(all, at))
    result = note(gltf, json_object_iter_key(at), error);
  return result;
}
