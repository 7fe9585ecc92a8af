/* fuzz_scene.c - what we read of meshes ourselves: the text of OBJ and MTL files, and whether a
 * PLY file is whole. Meshes that name files are left out: they would be this machine's. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "scene/scene_load.h"

static void read_as(enum scene_format format, const char *path) {
  struct scene_loading loading = {.path = path, .format = format, .needs = SCENE_SURFACES};
  struct error error;
  if (scene_text_read(&loading, &error) == RESULT_OK)
    for (int k = 0; k < loading.mtl_count; ++k) {
      const struct scene_material *material = &loading.mtl[k].material;
      fuzz_check(scene_text_material(&loading, material->name) == &loading.mtl[k]);
      for (int c = 0; c < 3; ++c)
        fuzz_check(material->diffuse[c] >= 0 && isfinite(material->specular[c]));
    }
  free(loading.mtl);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  char path[64], library[64];
  int file = fuzz_file(data, size);
  snprintf(path, sizeof path, "/proc/self/fd/%d", file);
  if (!memmem(data, size, "mtllib", 6)) read_as(SCENE_OBJ, path);
  read_as(SCENE_PLY, path);
  /* A library's name is taken from the mesh's folder: the file beside it. */
  int length = snprintf(library, sizeof library, "mtllib %d\n", file);
  int mesh = fuzz_file((const uint8_t *)library, (size_t)length);
  snprintf(path, sizeof path, "/proc/self/fd/%d", mesh);
  read_as(SCENE_OBJ, path);
  close(mesh);
  close(file);
  return 0;
}
