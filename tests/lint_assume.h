/* lint_assume.h - what `make lint` tells static analysers, which see one file
 * at a time: that slab_fail returns the result it is given. Without it each
 * `return slab_fail(...)` looks like a way to succeed with nothing done. */
#include "slab_error.h"

static inline enum slab_result lint_given(enum slab_result given, enum slab_result returned) {
  (void)returned;
  return given;
}
#define slab_fail(error, result, ...) lint_given(result, slab_fail(error, result, __VA_ARGS__))
