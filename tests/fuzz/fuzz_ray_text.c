/* fuzz_ray_text.c - rays as text. */
#include "fuzz_rays.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  ray_format_text.is((const char *)data, size);
  fuzz_rays(data, size, &ray_format_text);
  return 0;
}
