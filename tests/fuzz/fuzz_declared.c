/* fuzz_declared.c - what canned.inc tells the bake of a lamp. */
#include <stdlib.h>

#include "fuzz.h"
#include "lamp/lamp.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct lamp lamp = {0};
  struct error error;
  struct effects effects;
  char *text = fuzz_text(data, size);
  if (lamp_declarations(text, "fuzz.pov", &lamp, &error) == RESULT_OK) {
    fuzz_check(lamp.slab_count > 0 && lamp.slabs[0].name[0]);
    for (int n = 0; n < lamp.slab_count; ++n)
      fuzz_check(slab_check(&lamp.slabs[n], &error) == RESULT_OK);
    effects_parse(lamp.needs, "Canned_Needs", &effects, &error);
  }
  lamp_free(&lamp);
  free(text);
  return 0;
}
