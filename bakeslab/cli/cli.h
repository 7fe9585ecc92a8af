/* cli.h - what the programs' commands share: how they are called, what they
 * say and how they fail. Code that does the work never calls this.
 *
 * A program is a cli_program, a table of commands, and a main() that returns
 * cli_main(). A command is `int cmd_NAME(int argc, char **argv)`. It parses its
 * arguments by argp with cli_options among the children, and returns the exit
 * status: 0 done, 1 failed, 2 usage (a comparing command: 0 same, 1 differ,
 * 2 trouble). Data goes to stdout, messages to stderr; an error is one line. */
#ifndef CLI_H
#define CLI_H

#include <argp.h>
#include <stdbool.h>

#include "base/result.h"

enum { CLI_OK = 0, CLI_FAILED = 1, CLI_USAGE = 2 };

struct cli_command {
  const char *name;
  int (*run)(int argc, char **argv);
  const char *help; /* one line */
};

struct cli_program {
  const char *name;
  const char *summary;                /* one sentence */
  const struct cli_command *commands; /* up to one without a name */
  const char *examples;               /* lines, indented by two blanks; NULL: none */
  const char *exit_status;            /* what the statuses mean, one line */
  const char *compares;               /* the comparing command, or NULL */
};

/* Expands @FILE arguments (arguments.h), then runs the command that argv[1] names,
 * or answers --help, --version, help and help COMMAND. Returns the exit status. A stdout
 * that cannot be written is a failure. */
int cli_main(const struct cli_program *program, int argc, char **argv);

/* "PROGRAM: MESSAGE" on stderr, as one line. */
void cli_complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same, unless -q was given: "FILE: note: ...". */
void cli_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Prints the error and returns the exit status of a failure: 1, or 2 for the comparing command. */
int cli_fail(const struct error *error);

/* Flushes stdout and says whether all that was printed got there: a full disk
 * or a closed pipe is an error. Returns an exit status. */
int cli_close_stdout(void);

/* The end of a command: prints the error of a failure, closes stdout, returns the exit status. */
int cli_end(enum result result, const struct error *error);

/* For the `children` of every command's argp: the options -q and -h, and that argp_error() and
 * unknown options make one line and exit status 2. argp_usage() would print many lines:
 * say by argp_error() what is missing. */
extern const struct argp cli_argp;
extern const struct argp_child cli_options[]; /* of that alone */

/* argp_parse with a command's arguments; ends the program where it has no memory. */
void cli_parse(const struct argp *argp, int argc, char **argv, void *input);

/* A command from its arguments, which are parsed into `input`, to cli_end. */
typedef enum result cli_work(void *input, struct error *error);
int cli_run(const struct argp *argp, int argc, char **argv, cli_work *work, void *input);

/* Prints "out of memory" and ends the program as failed. */
void cli_out_of_memory(void) __attribute__((noreturn));

/* Whether -q was given: no notes and no progress. */
bool cli_quiet(void);

/* The command line that is running, quoted for a shell, with the program's name in front
 * and @FILE arguments expanded; outputs record it. Lives as long as the program. */
const char *cli_command_line(void);

/* A word, quoted for a shell where it must be; to be freed. NULL without memory. */
char *cli_quote(const char *word);

#endif
