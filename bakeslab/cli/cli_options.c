/* cli_options.c - what every command's argp shares: -q, and usage errors of
 * one line. argp follows each message by "Try `...' for more information.", and
 * prints that alone where getopt has already told what is wrong. So argp writes
 * into memory, and what comes before "Try" is printed when it exits. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

static bool quiet;

static FILE *usage_stream;
static char *usage_text;
static size_t usage_size;

static void tell_usage_error(void) {
  static const char hint[] = "\nTry `";
  bool said = ftell(usage_stream) > 0;
  if (fclose(usage_stream) != 0 || !usage_text) {
    if (said) cli_complain("out of memory");
    free(usage_text);
    return;
  }
  /* File names in a message may have line ends, so the last one that matches. */
  char *end = NULL;
  for (char *at = usage_text; (at = strstr(at, hint)); ++at) end = at;
  if (end) *end = 0;
  if (*usage_text && strncmp(usage_text, hint + 1, strlen(hint + 1))) {
    result_one_line(usage_text);
    fprintf(stderr, "%s\n", usage_text);
  }
  free(usage_text);
}

static error_t parse_common(int key, char *argument, struct argp_state *state) {
  (void)argument;
  switch (key) {
  case 'q':
    quiet = true;
    return 0;
  case ARGP_KEY_INIT:
    if (!usage_stream) {
      usage_stream = open_memstream(&usage_text, &usage_size);
      if (usage_stream) atexit(tell_usage_error);
    }
    if (usage_stream) state->err_stream = usage_stream;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option common_options[] = {
    {"quiet", 'q', NULL, 0, "No notes and no progress on stderr; errors are still told", 0}, {0}};
static const struct argp common = {.options = common_options, .parser = parse_common};
const struct argp_child cli_options[] = {{&common, 0, NULL, 0}, {0}};

void cli_parse(const struct argp *argp, int argc, char **argv, void *input) {
  if (argp_parse(argp, argc, argv, 0, NULL, input) != 0) cli_out_of_memory();
}

bool cli_quiet(void) {
  return quiet;
}
