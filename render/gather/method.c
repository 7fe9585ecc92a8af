/* method.c - see method.h. */
#include "gather/method.h"

#include <string.h>

static const char *const method_names[GATHER_METHODS + 1] = {
    [GATHER_AUTO] = "auto",
    [GATHER_REFERENCE] = "reference",
    [GATHER_PAPER] = "paper",
    [GATHER_MIDPOINT] = "midpoint",
    [GATHER_PI] = "pi",
    [GATHER_CLOSED] = "closed",
    [GATHER_VIEWS] = "views",
    [GATHER_LEVELS] = "levels",
    [GATHER_PAPER_LEVELS] = "paper-levels",
    [GATHER_CUT] = "cut",
    [GATHER_GL] = "gl",
};

const char *gather_method_name(enum gather_method method) {
  return method_names[method];
}

bool gather_method_parse(const char *name, enum gather_method *method) {
  for (int k = 0; k < GATHER_METHODS; ++k)
    if (!strcmp(name, method_names[k])) {
      *method = (enum gather_method)k;
      return true;
    }
  return false;
}
