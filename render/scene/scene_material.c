/* scene_material.c - materials and their textures */
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_load.h"

/* assimp calls the images that are within the file *0, *1 and so on. */
static enum result find_texture(struct scene_loading *loading, const struct aiScene *from,
                                const char *name, int *number, struct error *error) {
  if (name[0] != '*')
    return scene_add_texture(loading, scene_find_beside(loading->path, name), NULL, 0, NULL, number,
                             error);
  unsigned long k = strtoul(name + 1, NULL, 10);
  if (k >= from->mNumTextures)
    return result_fail(error, RESULT_BAD, "%s: has no image %lu", loading->path, k);
  const struct aiTexture *embedded = from->mTextures[k];
  char *path;
  if (embedded->mHeight != 0 || !embedded->pcData)
    return result_fail(error, RESULT_BAD,
                       "%s: embeds an image as bare pixels, which is not supported; embed a PNG or "
                       "JPEG file",
                       loading->path);
  if (asprintf(&path, "%s: image %lu", loading->path, k) < 0) path = NULL;
  return scene_add_texture(loading, path, embedded->pcData, embedded->mWidth,
                           embedded->achFormatHint, number, error);
}

static const char *mesh_of(const struct aiScene *from, unsigned material) {
  for (unsigned k = 0; k < from->mNumMeshes; ++k)
    if (from->mMeshes[k]->mMaterialIndex == material) return from->mMeshes[k]->mName.data;
  return "";
}

static void make_white(struct scene_material *material) {
  for (int c = 0; c < 3; ++c) material->diffuse[c] = 1;
}

static enum result no_material(struct scene_loading *loading, const struct aiScene *from,
                               unsigned number, struct scene_material *material,
                               struct error *error) {
  ++loading->white;
  make_white(material);
  if (loading->repair) return RESULT_OK;
  const char *mesh = mesh_of(from, number);
  return result_fail(error, RESULT_BAD, "%s: mesh '%s' has no material; --repair makes it white",
                     loading->path, mesh);
}

static enum result ignore(struct scene_loading *loading, enum scene_ignored kind, bool there,
                          const char *name, struct error *error) {
  if (!there || scene_ignore(loading, kind, name)) return RESULT_OK;
  return result_fail(error, RESULT_MEMORY, "%s: out of memory", loading->path);
}

/* With alphaMode OPAQUE alpha means nothing. */
static bool is_transparent(const struct aiMaterial *source, double alpha) {
  struct aiString mode = {0};
  ai_real through = 0;
  aiGetMaterialString(source, AI_MATKEY_GLTF_ALPHAMODE, &mode);
  aiGetMaterialFloatArray(source, AI_MATKEY_TRANSMISSION_FACTOR, &through, NULL);
  bool texture = aiGetMaterialTextureCount(source, aiTextureType_BASE_COLOR) > 0;
  bool blends = strcmp(mode.data, "BLEND") == 0 || strcmp(mode.data, "MASK") == 0;
  return through > 0 || (blends && (alpha < 1 || texture));
}

static enum result check_gltf(struct scene_loading *loading, const struct aiMaterial *source,
                              const struct scene_material *material, double metallic,
                              struct error *error) {
  static const struct {
    enum aiTextureType type;
    const char *name;
  } unread[] = {{aiTextureType_METALNESS, "metallic-roughness"},
                {aiTextureType_EMISSIVE, "emissive"}};
  enum result result = RESULT_OK;
  for (size_t k = 0; k < sizeof unread / sizeof *unread && result == RESULT_OK; ++k)
    if (aiGetMaterialTextureCount(source, unread[k].type) > 0)
      result = scene_unread(loading, error, "%s: material '%s' has a texture that is %s",
                            loading->path, material->name, unread[k].name);
  if (result == RESULT_OK && metallic > 0 && material->texture >= 0)
    result = scene_unread(loading, error,
                          "%s: material '%s' is metallic and has a texture, also for its highlight",
                          loading->path, material->name);
  return result;
}

/* glTF's highlight is a microfacet one with GGX's alpha = roughness^2; (N.H)^Ns with
 * Ns = 2/alpha^2 - 2 is Beckmann's like it. Ks makes the whole highlight, seen along the
 * normal under an even sky, no more than the Fresnel reflectance F0 = 0.04 for dielectrics:
 * integral of Ks/pi (N.H)^Ns d omega = 8 Ks/(Ns + 2) (1 - 2^-(Ns/2 + 1)). */
static void set_highlight(struct scene_material *material, const double base[3], double metallic,
                          double roughness) {
  double alpha = roughness * roughness;
  double shininess = fmin(fmax(2 / (alpha * alpha) - 2, 1), 1e4);
  material->shininess = shininess;
  for (int c = 0; c < 3; ++c)
    material->specular[c] = (0.04 * (1 - metallic) + base[c] * metallic) * (shininess + 2) / 8;
}

static enum result from_gltf(struct scene_loading *loading, const struct aiScene *from,
                             unsigned number, struct scene_material *material,
                             struct error *error) {
  const struct aiMaterial *source = from->mMaterials[number];
  struct aiColor4D base = {1, 1, 1, 1}, glow = {0, 0, 0, 1};
  ai_real metallic = 1, roughness = 1; /* glTF's defaults */
  struct aiString name;
  /* assimp puts a material of its own last, for those that have none */
  if (number + 1 == from->mNumMaterials) return no_material(loading, from, number, material, error);
  aiGetMaterialColor(source, AI_MATKEY_BASE_COLOR, &base);
  aiGetMaterialColor(source, AI_MATKEY_COLOR_EMISSIVE, &glow);
  aiGetMaterialFloatArray(source, AI_MATKEY_METALLIC_FACTOR, &metallic, NULL);
  aiGetMaterialFloatArray(source, AI_MATKEY_ROUGHNESS_FACTOR, &roughness, NULL);
  const double colour[3] = {(double)base.r, (double)base.g, (double)base.b};
  const double light[3] = {(double)glow.r, (double)glow.g, (double)glow.b};
  double factors[2] = {(double)metallic, (double)roughness};
  if (aiGetMaterialTextureCount(source, aiTextureType_METALNESS) > 0)
    factors[0] = 0; /* only with --repair: without the texture, better paint than metal */
  for (int c = 0; c < 3; ++c) {
    material->diffuse[c] = colour[c] * (1 - factors[0]);
    material->emission[c] =
        aiGetMaterialTextureCount(source, aiTextureType_EMISSIVE) > 0 ? 0 : light[c];
  }
  set_highlight(material, colour, factors[0], factors[1]);
  enum result result = RESULT_OK;
  if (aiGetMaterialTexture(source, aiTextureType_BASE_COLOR, 0, &name, NULL, NULL, NULL, NULL, NULL,
                           NULL) == aiReturn_SUCCESS)
    result = find_texture(loading, from, name.data, &material->texture, error);
  if (result == RESULT_OK)
    result = ignore(loading, SCENE_TRANSPARENCY, is_transparent(source, (double)base.a),
                    material->name, error);
  if (result == RESULT_OK)
    result =
        ignore(loading, SCENE_BUMPS, aiGetMaterialTextureCount(source, aiTextureType_NORMALS) > 0,
               material->name, error);
  return result != RESULT_OK ? result : check_gltf(loading, source, material, factors[0], error);
}

static enum result check(const struct scene_loading *loading, const struct scene_material *material,
                         struct error *error) {
  for (int c = 0; c < 3; ++c) {
    double colours[3] = {material->diffuse[c], material->specular[c], material->emission[c]};
    for (int k = 0; k < 3; ++k)
      if (!(colours[k] >= 0) || !isfinite(colours[k]))
        return result_fail(error, RESULT_BAD,
                           "%s: material '%s' has a colour that is negative or not finite",
                           loading->path, material->name);
  }
  return RESULT_OK;
}

/* What belongs to the mesh rather than to its material. */
static enum result check_mesh(struct scene_loading *loading, const struct aiMesh *mesh,
                              struct error *error) {
  const struct scene_material *material = &loading->scene->materials[mesh->mMaterialIndex];
  bool has_uv = false;
  for (int k = 0; k < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++k)
    has_uv |= mesh->mTextureCoords[k] != NULL;
  if (material->texture >= 0 && !has_uv)
    return scene_unread(loading, error, "%s: mesh '%s' has a texture without texture coordinates",
                        loading->path, mesh->mName.data);
  if (mesh->mColors[0])
    return scene_unread(loading, error, "%s: mesh '%s' has colours at its vertices", loading->path,
                        mesh->mName.data);
  return RESULT_OK;
}

enum result scene_import_materials(struct scene_loading *loading, const struct aiScene *from,
                                   const bool *used, struct error *error) {
  struct scene *scene = loading->scene;
  enum result result = RESULT_OK;
  scene->materials = calloc((size_t)from->mNumMaterials + 1, sizeof *scene->materials);
  if (!scene->materials)
    return result_fail(error, RESULT_MEMORY, "%s: out of memory", loading->path);
  scene->material_count = (int)from->mNumMaterials;
  for (unsigned k = 0; k < from->mNumMaterials && result == RESULT_OK; ++k) {
    struct scene_material *material = &scene->materials[k];
    struct aiString name = {0};
    aiGetMaterialString(from->mMaterials[k], AI_MATKEY_NAME, &name);
    snprintf(material->name, sizeof material->name, "%.127s", name.data);
    material->texture = -1;
    if (!used[k]) continue;
    result = from_gltf(loading, from, k, material, error);
    if (result == RESULT_OK) result = check(loading, material, error);
    const double *glow = material->emission;
    if (result == RESULT_OK)
      result = ignore(loading, SCENE_EMISSION, glow[0] > 0 || glow[1] > 0 || glow[2] > 0,
                      material->name, error);
  }
  for (unsigned k = 0; k < from->mNumMeshes && result == RESULT_OK; ++k)
    result = check_mesh(loading, from->mMeshes[k], error);
  for (unsigned k = 0; k < from->mNumLights && result == RESULT_OK; ++k)
    result = ignore(loading, SCENE_LIGHTS, true, from->mLights[k]->mName.data, error);
  return result;
}
