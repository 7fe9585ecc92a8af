/* cli.h - what all subcommands share: how they are called and how they fail.
 *
 * A subcommand is a function in cmd_NAME.c, listed in main.c's table. It
 * returns the exit status: 0 done, 1 failed, 2 usage (a comparing command:
 * 0 same, 1 differ, 2 trouble). Data goes to stdout, talk to stderr. */
#ifndef CLI_H
#define CLI_H

#include <argp.h>
#include <stdbool.h>

#include "slab_file.h"

#define BAKESLAB_VERSION "0.1.0"

enum { CLI_OK = 0, CLI_FAILED = 1, CLI_USAGE = 2 };

int cmd_bake(int argc, char **argv);
int cmd_check(int argc, char **argv);
int cmd_convert(int argc, char **argv);
int cmd_diff(int argc, char **argv);
int cmd_include(int argc, char **argv);
int cmd_info(int argc, char **argv);
int cmd_lookup(int argc, char **argv);

/* "bakeslab: MESSAGE" on stderr, as one line. */
void cli_complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Prints the error and returns CLI_FAILED. */
int cli_fail(const struct slab_error *error);

/* Parses "NxM" (or "N" for NxN), both at least 1 and at most 65536. */
bool cli_parse_size(const char *text, int size[2]);

/* "logluv", "float" or "half", and back. */
bool cli_parse_precision(const char *text, enum slab_precision *precision);
const char *cli_precision_name(enum slab_precision precision);

/* For argp: takes exactly one argument, a slab, into *path, and complains about none or
 * more. Call it for keys that are no option of the command. */
error_t cli_parse_slab(int key, char *argument, struct argp_state *state, const char **path);

/* Options that every command takes: -q. For the `children` of a command's argp. */
extern const struct argp_child cli_options[];

/* "bakeslab: FILE: note: ..." on stderr, unless -q was given. */
void cli_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The command line that is running, quoted for a shell; outputs record it.
 * Set by main, lives as long as the program. */
const char *cli_command_line(void);
void cli_set_command_line(int argc, char **argv);

/* Flushes stdout and says whether all that was printed got there: a full disk
 * or a closed pipe is an error. Returns an exit status. */
int cli_close_stdout(void);

/* For atexit: does the same for those who did not (argp's --help), and makes
 * the exit status 1 where it fails. */
void cli_check_stdout_at_exit(void);

#endif
