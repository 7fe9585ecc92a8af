/* cmd_missing.c - stands in for commands that are not there yet; goes away. */
#include "cli.h"

static int missing(char **argv) {
  cli_complain("%s: not built yet", argv[0]);
  return CLI_FAILED;
}

#define STUB(name)                                                                                 \
  __attribute__((weak)) int name(int argc, char **argv) {                                          \
    (void)argc;                                                                                    \
    return missing(argv);                                                                          \
  }
STUB(cmd_bake)
STUB(cmd_check)
STUB(cmd_convert)
STUB(cmd_diff)
STUB(cmd_include)
STUB(cmd_info)
STUB(cmd_lookup)
