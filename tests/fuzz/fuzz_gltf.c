/* fuzz_gltf.c - glTF files, as text and as .glb. */
#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz_mesh(data, size, SCENE_GLTF, gltf_load);
  return 0;
}
