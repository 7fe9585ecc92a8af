/* fuzz_receivers.c - the receivers that `renderslab irradiance` reads. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cmd/receiver_text.h"
#include "fuzz.h"

enum { AT_A_TIME = 16 };

static void check_some(const struct receivers *receivers) {
  bool seen[AT_A_TIME] = {false};
  for (int k = 0; k < receivers->count; ++k) {
    const double *n = receivers->receiver[k].normal, *p = receivers->receiver[k].position;
    fuzz_check(fabs(hypot(hypot(n[0], n[1]), n[2]) - 1) < 1e-12);
    fuzz_check(isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]));
    size_t place = (size_t)receivers->order[k];
    fuzz_check(place < (size_t)receivers->count && !seen[place]);
    seen[place] = true;
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct receivers receivers = {0};
  struct error error;
  FILE *in = fdopen(fuzz_file(data, size), "r");
  fuzz_check(in);
  while (receiver_text_read(in, AT_A_TIME, &receivers, &error) == RESULT_OK && receivers.count > 0)
    check_some(&receivers);
  receiver_text_free(&receivers);
  fclose(in);
  return 0;
}
