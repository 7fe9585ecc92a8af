/* fuzz_obj.c - OBJ files. Those that name files are left out: they would be this machine's. */
#include <stdlib.h>
#include <string.h>

#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  char *text = fuzz_text(data, size);
  bool names = strcasestr(text, "mtllib") != NULL;
  free(text);
  if (!names) fuzz_mesh(data, size, SCENE_OBJ, scene_obj_read);
  return 0;
}
