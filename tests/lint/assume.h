/* lint_assume.h - what `make lint` tells static analysers, which see one file
 * at a time: that result_fail returns the result it is given. Without it each
 * `return result_fail(...)` looks like a way to succeed with nothing done. */
#include "base/result.h"

static inline enum result lint_given(enum result given, enum result returned) {
  (void)returned;
  return given;
}
#define result_fail(error, result, ...) lint_given(result, result_fail(error, result, __VA_ARGS__))
