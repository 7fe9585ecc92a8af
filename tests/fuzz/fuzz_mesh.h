/* fuzz_mesh.h - what the fuzzers of mesh files share. */
#ifndef FUZZ_MESH_H
#define FUZZ_MESH_H

#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "base/vector.h"
#include "fuzz.h"
#include "scene/scene_load.h"

typedef enum result mesh_reader(struct scene_loading *loading, struct error *error);

/* What was read must be a scene: corners that are vertices, finite, with an area. */
static inline void fuzz_scene(const struct scene *scene, const struct scene_loading *loading) {
  for (size_t t = 0; t < scene->triangles; ++t) {
    double normal[3], unit = 0;
    for (int k = 0; k < 3; ++k) {
      int corner = scene->corners[t][k];
      fuzz_check(corner >= 0 && (size_t)corner < scene->vertices);
      for (int c = 0; c < 3; ++c) fuzz_check(isfinite(scene->position[corner][c]));
      if (scene->normal) unit = vector_length(scene->normal[corner]);
      fuzz_check(!scene->normal || fabs(unit - 1) < 1e-9);
    }
    scene_geometric(scene, t, normal);
    fuzz_check(fabs(vector_length(normal) - 1) < 1e-9);
    if (loading->needs == SCENE_SURFACES)
      fuzz_check(scene->material[t] >= 0 && scene->material[t] < scene->material_count);
  }
}

/* Reads the input as shape and as surfaces, mended and not. */
static inline void fuzz_mesh(const uint8_t *data, size_t size, enum scene_format format,
                             mesh_reader *reader) {
  char path[64];
  int file = fuzz_file(data, size);
  snprintf(path, sizeof path, "/proc/self/fd/%d", file);
  for (int way = 0; way < 4; ++way) {
    struct scene scene = {0};
    struct error error = {""};
    struct scene_loading loading = {.path = path,
                                    .format = format,
                                    .needs = way % 2 ? SCENE_SURFACES : SCENE_SHAPE,
                                    .repair = way / 2,
                                    .scene = &scene};
    if (reader(&loading, &error) == RESULT_OK)
      fuzz_scene(&scene, &loading);
    else
      fuzz_check(error.text[0]);
    scene_free(&scene);
  }
  close(file);
}

#endif
