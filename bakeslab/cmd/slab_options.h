/* slab_options.h - what bakeslab's commands share beyond cli/cli.h. A command is a
 * function in cmd_NAME.c, listed in main.c's table. */
#ifndef SLAB_OPTIONS_H
#define SLAB_OPTIONS_H

#include <argp.h>

#include "cli/cli.h"
#include "cli/values.h"
#include "file/slab_file.h"

int cmd_bake(int argc, char **argv);
int cmd_check(int argc, char **argv);
int cmd_convert(int argc, char **argv);
int cmd_diff(int argc, char **argv);
int cmd_export(int argc, char **argv);
int cmd_gather(int argc, char **argv);
int cmd_import(int argc, char **argv);
int cmd_include(int argc, char **argv);
int cmd_info(int argc, char **argv);
int cmd_lookup(int argc, char **argv);
int cmd_projector(int argc, char **argv);
int cmd_status(int argc, char **argv);

/* The names of precisions, in their order, for an option's words (values.h). */
#define CLI_PRECISIONS "logluv|float|half"
const char *cli_precision_name(enum slab_precision precision);

/* For argp: takes exactly one argument, of a kind such as "slab", into *path, and complains about
 * none or more. Call it for keys that are no option of the command. */
error_t cli_parse_file(int key, char *argument, struct argp_state *state, const char *kind,
                       const char **path);

#endif
