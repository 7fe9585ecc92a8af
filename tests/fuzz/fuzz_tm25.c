/* fuzz_tm25.c - TM-25 ray files. The input is the file without the 36000 bytes of its texts. */
#include <stdlib.h>
#include <string.h>

#include "fuzz_rays.h"

enum { BEFORE = 288, TEXTS = 36000 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  uint8_t *whole = calloc(size + TEXTS, 1);
  size_t before = size < BEFORE ? size : BEFORE;
  fuzz_check(whole);
  if (size) memcpy(whole, data, before);
  if (size > before) memcpy(whole + BEFORE + TEXTS, data + before, size - before);
  fuzz_rays(whole, size < BEFORE ? size : size + TEXTS, &ray_format_tm25);
  free(whole);
  return 0;
}
