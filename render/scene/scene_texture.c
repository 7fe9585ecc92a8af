/* scene_texture.c - the textures of a scene, see scene_load.h. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/array.h"
#include "file/slab_image.h"
#include "scene/scene_load.h"

char *scene_find_beside(const char *path, const char *name) {
  char *found = scene_beside(path, name);
  if (!found || access(found, F_OK) == 0 || !strchr(name, '\\')) return found;
  char *turned = strdup(found);
  for (char *at = turned; at && *at; ++at)
    if (*at == '\\') *at = '/';
  if (turned && access(turned, F_OK) == 0) {
    free(found);
    return turned;
  }
  free(turned);
  return found;
}

enum result scene_add_texture(struct scene_loading *loading, char *path, const void *bytes,
                              size_t size, const char *suffix, int *number, struct error *error) {
  struct scene *scene = loading->scene;
  struct picture picture;
  struct slab_image_says says;
  enum result result = RESULT_OK;
  int count = scene->texture_count, room = count;
  for (int k = 0; path && k < count; ++k)
    if (strcmp(scene->textures[k].path, path) == 0) {
      *number = k;
      goto out;
    }
  if (!path || !array_reserve(&scene->textures, &room, count + 1, sizeof *scene->textures)) {
    result = result_fail(error, RESULT_MEMORY, "%s: out of memory", loading->path);
    goto out;
  }
  /* glTF's are sRGB whatever they say of themselves. */
  enum slab_image_colours colours =
      loading->format == SCENE_GLTF ? SLAB_IMAGE_SRGB : SLAB_IMAGE_OWN;
  result = slab_image_read(path, bytes, size, suffix, colours, &picture, &says, error);
  if (result != RESULT_OK) goto out;
  scene->textures[count] =
      (struct scene_texture){.path = path, .picture = picture, .transparent = says.transparent};
  *number = scene->texture_count++;
  if (says.several && !scene_ignore(loading, SCENE_PICTURES, path))
    result = result_fail(error, RESULT_MEMORY, "%s: out of memory", loading->path);
  path = NULL;
out:
  free(path);
  return result;
}
