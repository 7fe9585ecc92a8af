/* fuzz_zemax.c - binary source files of Zemax. What their identifier is was looked at before. */
#include "fuzz_rays.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz_rays(data, size, &ray_format_zemax);
  return 0;
}
