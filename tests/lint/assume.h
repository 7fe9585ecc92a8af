/* assume.h - what `make lint` tells static analysers, which see one file at a time: that
 * result_fail and its like return the result they are given. Without it each
 * `return result_fail(...)` looks like a way to succeed with nothing done. */
#include "base/result.h"

static inline enum result lint_given(enum result given, enum result returned) {
  (void)returned;
  return given;
}
#define result_fail(error, result, ...) lint_given(result, result_fail(error, result, __VA_ARGS__))
#define result_no_memory(error) lint_given(RESULT_MEMORY, result_no_memory(error))
#define result_at(result, error, ...) lint_given(result, result_at(result, error, __VA_ARGS__))
