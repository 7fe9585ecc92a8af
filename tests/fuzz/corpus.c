/* corpus.c - runs files through a fuzzer, in place of libFuzzer: a TAP line each. A crash
 * leaves lines out, which tests/run.sh counts as failures. */
#include <stdio.h>
#include <stdlib.h>

#include "fuzz.h"

enum { LARGEST = 1 << 20 };

int main(int argc, char **argv) {
  uint8_t *data = malloc(LARGEST);
  if (!data) return 1;
  printf("1..%d\n", argc - 1);
  for (int k = 1; k < argc; ++k) {
    printf("# %s\n", argv[k]);
    fflush(stdout);
    FILE *file = fopen(argv[k], "rbe");
    size_t size = file ? fread(data, 1, LARGEST, file) : 0;
    if (file) fclose(file);
    if (size) LLVMFuzzerTestOneInput(data, size);
    printf("%s %d - %s\n", size ? "ok" : "not ok", k, argv[k]);
  }
  free(data);
  return 0;
}
