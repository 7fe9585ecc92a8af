/* fuzz_housing.c - the visible housing, lifted out of a script or come with a slab. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "lamp/housing.h"

/* Where neither strings nor comments can hide a directive, anyone sees those that are not
 * harmless. */
static void check_plain(const char *text) {
  static const char *const bad[] = {"#declare", "#macro", "#fopen", "#include", "#write", "#debug"};
  if (strpbrk(text, "\"/")) return;
  for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) fuzz_check(!strstr(text, bad[k]));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  char *text = fuzz_text(data, size);
  char *housing = housing_find(text);
  if (housing && housing_is_harmless(housing)) check_plain(housing);
  if (housing_is_harmless(text)) check_plain(text);
  free(housing);
  free(text);
  return 0;
}
