/* fuzz_mtl.c - MTL files. No texture is read. */
#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "fuzz.h"
#include "scene/scene_mtl.h"

static void read_as(const char *name, bool repair) {
  struct scene scene = {0};
  struct error error;
  struct scene_loading loading = {.path = "/proc/self/fd/x", .repair = repair, .scene = &scene};
  struct scene_mtls mtls = {.loading = &loading};
  if (scene_mtl_read(&mtls, name, &error) == RESULT_OK)
    for (int k = 0; k < mtls.count; ++k) {
      const struct scene_material *material = &mtls.mtl[k].material;
      fuzz_check(scene_mtl_find(&mtls, material->name) == &mtls.mtl[k]);
      for (int c = 0; c < 3; ++c)
        fuzz_check(material->diffuse[c] >= 0 && isfinite(material->specular[c]));
      fuzz_check(!mtls.mtl[k].has_texture || mtls.mtl[k].texture[0]);
    }
  scene_mtl_free(&mtls);
  scene_free(&scene);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  char name[32];
  int file = fuzz_file(data, size);
  snprintf(name, sizeof name, "%d", file);
  read_as(name, false);
  read_as(name, true);
  close(file);
  return 0;
}
