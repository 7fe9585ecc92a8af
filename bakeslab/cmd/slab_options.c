#include "cmd/slab_options.h"

static const char *const precision_names[] = {[SLAB_PRECISION_LOGLUV] = "logluv",
                                              [SLAB_PRECISION_FLOAT] = "float",
                                              [SLAB_PRECISION_HALF] = "half"};

const char *cli_precision_name(enum slab_precision precision) {
  return precision_names[precision] ? precision_names[precision] : "default";
}

error_t cli_parse_file(int key, char *argument, struct argp_state *state, const char *kind,
                       const char **path) {
  switch (key) {
  case ARGP_KEY_ARG:
    if (*path) argp_error(state, "%s: one %s at a time", argument, kind);
    *path = argument;
    return 0;
  case ARGP_KEY_END:
    if (!*path) argp_error(state, "no %s given", kind);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}
