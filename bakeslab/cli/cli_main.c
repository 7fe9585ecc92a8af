/* cli_main.c - from a program's arguments to one of its commands. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/version.h"
#include "cli/arguments.h"
#include "cli/cli.h"

static int failed = CLI_FAILED; /* exit status of the command where it fails */

void cli_out_of_memory(void) {
  cli_complain("out of memory");
  exit(failed);
}

static void print_help(const struct cli_program *program) {
  printf("Usage: %s COMMAND [OPTION...] ARGUMENT...\n%s\n\n", program->name, program->summary);
  for (const struct cli_command *command = program->commands; command->name; ++command)
    printf("  %-12s%s\n", command->name, command->help);
  printf("  help        this text, or `%s help COMMAND` for one command\n"
         "\n"
         "  --help, --version\n"
         "  @FILE       further arguments, read from FILE: words as in a shell\n"
         "\n",
         program->name);
  if (program->examples) printf("Examples:\n%s\n", program->examples);
  printf("Exit status: %s.\n", program->exit_status);
}

static const struct cli_command *find_command(const struct cli_program *program, const char *name) {
  for (const struct cli_command *command = program->commands; command->name; ++command)
    if (!strcmp(command->name, name)) return command;
  return NULL;
}

static void set_failed(const struct cli_program *program, const char *command) {
  if (program->compares && !strcmp(command, program->compares)) failed = 2;
}

static int unknown(const struct cli_program *program, const char *name) {
  cli_complain("%s: no such command; see %s --help", name, program->name);
  return CLI_USAGE;
}

/* argp names the program by argv[0], so that usage lines say "bakeslab info". */
static int run_command(const struct cli_program *program, const struct cli_command *command,
                       int argc, char **argv) {
  char name[64], *called = argv[0];
  snprintf(name, sizeof name, "%s %s", program->name, command->name);
  argv[0] = name;
  set_failed(program, command->name);
  int status = command->run(argc, argv);
  argv[0] = called;
  return status;
}

static int run_help(const struct cli_program *program, int argc, char **argv) {
  if (argc < 3) {
    print_help(program);
    return cli_close_stdout();
  }
  const struct cli_command *command = find_command(program, argv[2]);
  if (!command) return unknown(program, argv[2]);
  char option[] = "--help";
  char *help_argv[] = {argv[0], option, NULL};
  return run_command(program, command, 2, help_argv);
}

static int dispatch(const struct cli_program *program, int argc, char **argv) {
  if (argc < 2) {
    cli_complain("no command given; see %s --help", program->name);
    return CLI_USAGE;
  }
  const char *name = argv[1];
  if (!strcmp(name, "help") || !strcmp(name, "--help") || !strcmp(name, "-?"))
    return run_help(program, name[0] == '-' ? 1 : argc, argv);
  if (!strcmp(name, "--version") || !strcmp(name, "-V")) {
    puts(argp_program_version);
    return cli_close_stdout();
  }
  const struct cli_command *command = find_command(program, name);
  if (!command) return unknown(program, name);
  return run_command(program, command, argc - 1, argv + 1);
}

int cli_main(const struct cli_program *program, int argc, char **argv) {
  static char version[64]; /* argp looks at it until the program ends */
  struct argument_words arguments = {0};
  struct error error = {{0}};
  int status;
  signal(SIGCHLD, SIG_DFL); /* were it ignored, as some parents leave it, no program that we run
                               could be waited for */
  atexit(cli_check_stdout_at_exit);
  signal(SIGPIPE, SIG_IGN); /* a closed pipe is an error like a full disk */
  argp_err_exit_status = CLI_USAGE;
  snprintf(version, sizeof version, "%s " CANNED_VERSION, program->name);
  argp_program_version = version;
  cli_set_command_line(program->name, argc, argv);
  enum result result = arguments_expand(argc, argv, &arguments, &error);
  if (result == RESULT_OK && !cli_set_command_line(program->name, arguments.count, arguments.words))
    result = RESULT_MEMORY;
  if (result == RESULT_MEMORY) {
    const char *command = arguments.count > 1 ? arguments.words[1] : argc > 1 ? argv[1] : "";
    set_failed(program, command);
    cli_out_of_memory();
  }
  if (result != RESULT_OK) {
    cli_complain("%s", error.text);
    status = CLI_USAGE;
  } else {
    status = dispatch(program, arguments.count, arguments.words);
  }
  arguments_free(&arguments);
  return status;
}
