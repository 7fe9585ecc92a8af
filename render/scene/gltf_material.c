/* gltf_material.c - materials of a glTF file, see gltf.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "scene/gltf.h"

enum { MOST_MATERIALS = 1 << 20 };

/* A surface as glTF describes it, by either of its models. */
struct paint {
  double base[4];    /* colour and alpha */
  double diffuse[3]; /* reflectance */
  double fresnel[3]; /* reflectance along the normal */
  double roughness;
  double metallic;
  const json_t *texture; /* textureInfo of the base colour; NULL: none */
  const json_t *unread;  /* that of what else it has */
  const char *unread_name;
};

static enum result ignore(struct gltf *gltf, enum scene_ignored kind, bool there, const char *name,
                          struct error *error) {
  if (!there || scene_ignore(gltf->loading, kind, name)) return RESULT_OK;
  return result_no_memory(error);
}

/* Without the texture that says what is metal, better paint than metal: only with --repair. */
static struct paint read_metallic(const json_t *json) {
  const json_t *model = json_object_get(json, "pbrMetallicRoughness");
  struct paint paint = {.base = {1, 1, 1, 1},
                        .roughness = gltf_number(model, "roughnessFactor", 1),
                        .metallic = gltf_number(model, "metallicFactor", 1),
                        .texture = json_object_get(model, "baseColorTexture"),
                        .unread = json_object_get(model, "metallicRoughnessTexture"),
                        .unread_name = "metallic-roughness"};
  gltf_array(model, "baseColorFactor", 4, paint.base);
  if (paint.unread) paint.metallic = 0;
  for (int c = 0; c < 3; ++c) {
    paint.diffuse[c] = paint.base[c] * (1 - paint.metallic);
    paint.fresnel[c] = 0.04 * (1 - paint.metallic) + paint.base[c] * paint.metallic;
  }
  return paint;
}

/* KHR_materials_pbrSpecularGlossiness: what its highlight takes is lacking to the diffuse light. */
static struct paint read_specular(const json_t *model) {
  struct paint paint = {.base = {1, 1, 1, 1},
                        .fresnel = {1, 1, 1},
                        .roughness = 1 - gltf_number(model, "glossinessFactor", 1),
                        .texture = json_object_get(model, "diffuseTexture"),
                        .unread = json_object_get(model, "specularGlossinessTexture"),
                        .unread_name = "specular-glossiness"};
  gltf_array(model, "diffuseFactor", 4, paint.base);
  gltf_array(model, "specularFactor", 3, paint.fresnel);
  double most = fmax(paint.fresnel[0], fmax(paint.fresnel[1], paint.fresnel[2]));
  for (int c = 0; c < 3; ++c) {
    if (paint.unread) paint.fresnel[c] = most = 0.04;
    paint.diffuse[c] = paint.base[c] * (1 - most);
  }
  return paint;
}

/* glTF's highlight is a microfacet one with GGX's alpha = roughness^2; (N.H)^Ns with
 * Ns = 2/alpha^2 - 2 is Beckmann's like it. Ks makes the whole highlight, seen along the
 * normal under an even sky, no more than the Fresnel reflectance F0 = 0.04 for dielectrics:
 * integral of Ks/pi (N.H)^Ns d omega = 8 Ks/(Ns + 2) (1 - 2^-(Ns/2 + 1)). */
static void set_highlight(struct scene_material *material, const struct paint *paint) {
  double alpha = paint->roughness * paint->roughness;
  double shininess = fmin(fmax(2 / (alpha * alpha) - 2, 1), 1e4);
  material->shininess = shininess;
  for (int c = 0; c < 3; ++c) material->specular[c] = paint->fresnel[c] * (shininess + 2) / 8;
}

static void set_emission(struct scene_material *material, const json_t *json) {
  double glow[3] = {0, 0, 0};
  double strength =
      gltf_number(gltf_extension(json, "KHR_materials_emissive_strength"), "emissiveStrength", 1);
  gltf_array(json, "emissiveFactor", 3, glow);
  for (int c = 0; c < 3; ++c)
    material->emission[c] = json_object_get(json, "emissiveTexture") ? 0 : glow[c] * strength;
}

/* With alphaMode OPAQUE alpha means nothing. */
static bool is_transparent(const json_t *json, const struct paint *paint,
                           const struct scene_texture *texture) {
  const char *mode = json_string_value(json_object_get(json, "alphaMode"));
  const json_t *transmission = gltf_extension(json, "KHR_materials_transmission");
  bool blends = mode && (strcmp(mode, "BLEND") == 0 || strcmp(mode, "MASK") == 0);
  return gltf_number(transmission, "transmissionFactor", 0) > 0 ||
         (blends && (paint->base[3] < 1 || (texture && texture->transparent)));
}

/* KHR_materials_volume: a medium that absorbs, where it has a thickness and a colour;
 * KHR_materials_volume_scatter: one that scatters. */
static bool has_medium(const json_t *json) {
  const json_t *volume = gltf_extension(json, "KHR_materials_volume");
  return gltf_number(volume, "thicknessFactor", 0) > 0 ||
         gltf_extension(json, "KHR_materials_volume_scatter");
}

static enum result check_textures(struct gltf *gltf, const json_t *json, const struct paint *paint,
                                  const struct scene_material *material, struct error *error) {
  static const char has[] = "material '%s' has a texture that is %s";
  enum result result = RESULT_OK;
  if (paint->unread)
    result = scene_unread(gltf->loading, error, has, material->name, paint->unread_name);
  if (result == RESULT_OK && json_object_get(json, "emissiveTexture"))
    result = scene_unread(gltf->loading, error, has, material->name, "emissive");
  if (result == RESULT_OK && paint->metallic > 0 && paint->texture)
    result = scene_unread(gltf->loading, error,
                          "material '%s' is metallic and has a texture, also for its highlight",
                          material->name);
  return result;
}

static enum result check_colours(const struct scene_material *material, struct error *error) {
  for (int c = 0; c < 3; ++c) {
    const double colours[] = {material->diffuse[c], material->specular[c], material->emission[c]};
    for (int k = 0; k < 3; ++k)
      if (!(colours[k] >= 0) || !isfinite(colours[k]))
        return result_fail(error, RESULT_BAD,
                           "material '%s' has a colour that is negative or not finite",
                           material->name);
  }
  return RESULT_OK;
}

static enum result read_material(struct gltf *gltf, const json_t *json,
                                 struct scene_material *material, struct gltf_look *look,
                                 struct error *error) {
  const json_t *other = gltf_extension(json, "KHR_materials_pbrSpecularGlossiness");
  struct paint paint = other ? read_specular(other) : read_metallic(json);
  memcpy(material->diffuse, paint.diffuse, sizeof material->diffuse);
  set_highlight(material, &paint);
  set_emission(material, json);
  enum result result = check_colours(material, error);
  if (result == RESULT_OK) result = check_textures(gltf, json, &paint, material, error);
  if (result == RESULT_OK && paint.texture)
    result = result_at(gltf_texture(gltf, paint.texture, &material->texture, look, error), error,
                       "material '%s'", material->name);
  int number = material->texture;
  const struct scene_texture *texture = number < 0 ? NULL : &gltf->loading->scene->textures[number];
  if (result == RESULT_OK)
    result = ignore(gltf, SCENE_TRANSPARENCY, is_transparent(json, &paint, texture), material->name,
                    error);
  if (result == RESULT_OK)
    result = ignore(gltf, SCENE_MEDIA, has_medium(json), material->name, error);
  if (result == RESULT_OK)
    result = ignore(gltf, SCENE_BUMPS, json_object_get(json, "normalTexture") != NULL,
                    material->name, error);
  if (result == RESULT_OK)
    result =
        ignore(gltf, SCENE_EMISSION, !vector_is_zero(material->emission), material->name, error);
  return result == RESULT_OK ? gltf_extensions_of(gltf, json, error) : result;
}

enum result gltf_materials(struct gltf *gltf, struct error *error) {
  struct scene *scene = gltf->loading->scene;
  size_t count = json_array_size(json_object_get(gltf->root, "materials")) + 1;
  if (count > MOST_MATERIALS)
    return result_fail(error, RESULT_BAD, "has %zu materials, and less than %d are read", count - 1,
                       MOST_MATERIALS);
  scene->materials = calloc(count, sizeof *scene->materials);
  gltf->looks = calloc(count, sizeof *gltf->looks);
  if (!scene->materials || !gltf->looks) return result_no_memory(error);
  scene->material_count = (int)count;
  for (size_t k = 0; k < count; ++k) scene->materials[k].texture = -1;
  return RESULT_OK;
}

/* The last material is that of meshes without one. */
static enum result no_material(struct gltf *gltf, const char *mesh, int *number,
                               struct error *error) {
  struct scene *scene = gltf->loading->scene;
  *number = scene->material_count - 1;
  if (!gltf->looks[*number].read) ++gltf->loading->white;
  gltf->looks[*number].read = true;
  for (int c = 0; c < 3; ++c) scene->materials[*number].diffuse[c] = 1;
  if (gltf->loading->repair) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "mesh '%s' has no material; --repair makes it white", mesh);
}

enum result gltf_material(struct gltf *gltf, const json_t *number, const char *mesh, int *material,
                          const struct gltf_look **look, struct error *error) {
  const json_t *json;
  *look = NULL;
  if (!number) return no_material(gltf, mesh, material, error);
  enum result result = gltf_item(gltf, "materials", number, &json, error);
  if (result != RESULT_OK) return result_at(result, error, "mesh '%s'", mesh);
  *material = (int)json_integer_value(number);
  struct scene_material *made = &gltf->loading->scene->materials[*material];
  struct gltf_look *how = &gltf->looks[*material];
  const char *name = json_string_value(json_object_get(json, "name"));
  if (!how->read) {
    if (name)
      snprintf(made->name, sizeof made->name, "%.127s", name);
    else
      snprintf(made->name, sizeof made->name, "%d", *material);
    result = read_material(gltf, json, made, how, error);
    how->read = true;
  }
  if (made->texture >= 0) *look = how;
  return result;
}
