#include "cmd/slab_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const precision_names[] = {[SLAB_PRECISION_LOGLUV] = "logluv",
                                              [SLAB_PRECISION_FLOAT] = "float",
                                              [SLAB_PRECISION_HALF] = "half"};
enum { PRECISIONS = sizeof precision_names / sizeof *precision_names };

bool cli_parse_precision(const char *text, enum slab_precision *precision) {
  for (int k = 0; k < PRECISIONS; ++k)
    if (precision_names[k] && !strcmp(text, precision_names[k])) {
      *precision = (enum slab_precision)k;
      return true;
    }
  return false;
}

const char *cli_precision_name(enum slab_precision precision) {
  return precision_names[precision] ? precision_names[precision] : "default";
}

void cli_parse_samples(struct argp_state *state, const char *option, const char *text,
                       int samples[2]) {
  if (!cli_parse_size(text, samples))
    argp_error(state, "%s %s: must be NxM, each from 1 to 65536", option, text);
}

double cli_parse_positive(struct argp_state *state, const char *option, const char *text) {
  char *end;
  double number = strtod(text, &end);
  if (end == text || *end || !(number > 0) || !isfinite(number))
    argp_error(state, "%s %s: must be a positive number", option, text);
  return number;
}

error_t cli_parse_slab(int key, char *argument, struct argp_state *state, const char **path) {
  switch (key) {
  case ARGP_KEY_ARG:
    if (*path) argp_error(state, "%s: one slab at a time", argument);
    *path = argument;
    return 0;
  case ARGP_KEY_END:
    if (!*path) argp_error(state, "no slab given");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}
