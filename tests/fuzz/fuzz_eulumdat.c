/* fuzz_eulumdat.c - EULUMDAT files. */
#include "import/photometric/eulumdat.h"

#include "fuzz_photometry.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct photometry lamp = {0};
  struct warnings notes = {0};
  struct error error = {{0}};
  eulumdat_is((const char *)data, size);
  if (eulumdat_read((const char *)data, size, &lamp, &notes, &error) == RESULT_OK)
    fuzz_photometry(&lamp);
  else
    fuzz_check(*error.text);
  photometry_free(&lamp);
  return 0;
}
