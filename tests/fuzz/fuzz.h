/* fuzz.h - what the fuzzers share. Each gives any bytes to one reader; the reader may refuse
 * them or take them, and what it took must hold what its header promises. `make test` runs the
 * seeds through them, `make fuzz` lets libFuzzer change them. */
#ifndef FUZZ_H
#define FUZZ_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Ends the process, which the fuzzer reports with the input, unless `holds`. */
#define fuzz_check(holds)                                                                          \
  do                                                                                               \
    if (!(holds)) fuzz_failed(#holds, __FILE__, __LINE__);                                         \
  while (0)
void fuzz_failed(const char *what, const char *file, int line) __attribute__((noreturn));

/* The input with a 0 at its end; the caller frees it. */
char *fuzz_text(const uint8_t *data, size_t size);

/* An unnamed file in memory that holds the input; the caller, or who takes it over, closes it. */
int fuzz_file(const uint8_t *data, size_t size);

#endif
