/* fuzz_ply.c - PLY files. */
#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz_mesh(data, size, SCENE_PLY, scene_ply_read);
  return 0;
}
