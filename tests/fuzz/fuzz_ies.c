/* fuzz_ies.c - IES LM-63 files. */
#include "import/photometric/ies.h"

#include "fuzz_photometry.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct photometry lamp = {0};
  struct warnings notes = {0};
  struct error error = {{0}};
  ies_is((const char *)data, size);
  if (ies_read((const char *)data, size, NULL, &lamp, &notes, &error) == RESULT_OK)
    fuzz_photometry(&lamp);
  else
    fuzz_check(*error.text);
  photometry_free(&lamp);
  return 0;
}
