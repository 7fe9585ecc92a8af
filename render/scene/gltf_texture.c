/* gltf_texture.c - textures of glTF materials and their images, see gltf.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "scene/gltf.h"

enum { REPEAT = 10497 };

/* The bytes of an image that is within the file. */
static enum result read_bytes(struct gltf *gltf, const json_t *image, struct gltf_bytes *bytes,
                              struct error *error) {
  const json_t *number = json_object_get(image, "bufferView");
  struct gltf_view view;
  if (!number)
    return gltf_uri_bytes(json_string_value(json_object_get(image, "uri")), bytes, error);
  enum result result = gltf_view(gltf, number, &view, error);
  return result == RESULT_OK ? gltf_view_read(gltf, &view, 0, view.size, bytes, error) : result;
}

/* Adds the image to the scene's textures, unless it is among them. */
static enum result add_image(struct gltf *gltf, const json_t *number, int *texture,
                             struct error *error) {
  struct scene_loading *loading = gltf->loading;
  const json_t *image;
  struct gltf_bytes bytes = {0};
  char *path = NULL;
  enum result result = gltf_item(gltf, "images", number, &image, error);
  if (result != RESULT_OK) return result;
  const char *uri = json_string_value(json_object_get(image, "uri"));
  long long k = json_integer_value(number);
  if (json_object_get(image, "bufferView") || (uri && gltf_uri_is_data(uri))) {
    result = read_bytes(gltf, image, &bytes, error);
    if (result == RESULT_OK && asprintf(&path, "%s: image %lld", loading->path, k) < 0) path = NULL;
  } else if (uri) {
    result = gltf_uri_path(loading->path, uri, &path, error);
  } else {
    result = result_fail(error, RESULT_BAD, "has neither a uri nor a bufferView");
  }
  if (result != RESULT_OK) return result_at(result, error, "image %lld", k);
  result =
      scene_add_texture(loading, path, bytes.at, bytes.size, bytes.at ? "" : NULL, texture, error);
  free(bytes.at);
  return result;
}

/* The image of a texture; one that only an extension gives is read where OpenImageIO can. */
static enum result find_image(const json_t *texture, const json_t **number, struct error *error) {
  static const char *const formats[] = {"EXT_texture_webp", "MSFT_texture_dds"};
  *number = json_object_get(texture, "source");
  for (size_t k = 0; k < sizeof formats / sizeof *formats && !*number; ++k)
    *number = json_object_get(gltf_extension(texture, formats[k]), "source");
  if (*number) return RESULT_OK;
  const char *extension =
      json_object_iter_key(json_object_iter(json_object_get(texture, "extensions")));
  if (!extension) return result_fail(error, RESULT_BAD, "a texture has no image");
  return result_fail(error, RESULT_BAD, "a texture is there only by %s, which is not supported",
                     extension);
}

static enum result read_sampler(struct gltf *gltf, const json_t *texture, struct gltf_look *look,
                                struct error *error) {
  const json_t *number = json_object_get(texture, "sampler"), *sampler = NULL;
  enum result result = number ? gltf_item(gltf, "samplers", number, &sampler, error) : RESULT_OK;
  look->repeats = gltf_number(sampler, "wrapS", REPEAT) == REPEAT &&
                  gltf_number(sampler, "wrapT", REPEAT) == REPEAT;
  return result;
}

/* KHR_texture_transform: scaled, turned counter-clockwise as seen with v down, moved. */
static enum result read_place(const json_t *info, struct gltf_look *look, struct error *error) {
  const json_t *transform = gltf_extension(info, "KHR_texture_transform");
  double scale[2] = {1, 1}, move[2] = {0, 0}, angle = gltf_number(transform, "rotation", 0);
  gltf_array(transform, "scale", 2, scale);
  gltf_array(transform, "offset", 2, move);
  const double turn[2][2] = {{cos(angle), sin(angle)}, {-sin(angle), cos(angle)}};
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < 2; ++c) look->place[r][c] = turn[r][c] * scale[c];
    look->place[r][2] = move[r];
  }
  size_t set;
  const json_t *owner = json_object_get(transform, "texCoord") ? transform : info;
  enum result result = gltf_size(owner, "texCoord", &set, error);
  look->set = set < INT_MAX ? (int)set : INT_MAX;
  return result;
}

enum result gltf_texture(struct gltf *gltf, const json_t *info, int *texture,
                         struct gltf_look *look, struct error *error) {
  const json_t *json, *image;
  enum result result = gltf_item(gltf, "textures", json_object_get(info, "index"), &json, error);
  if (result == RESULT_OK) result = read_place(info, look, error);
  if (result == RESULT_OK) result = read_sampler(gltf, json, look, error);
  if (result == RESULT_OK) result = find_image(json, &image, error);
  if (result == RESULT_OK) result = add_image(gltf, image, texture, error);
  if (result == RESULT_OK || result == RESULT_MEMORY) return result;
  *texture = -1;
  ++gltf->loading->textureless;
  if (gltf->loading->repair) return RESULT_OK;
  return result_fail(error, result, "%s; --repair does without it", error ? error->text : "");
}
