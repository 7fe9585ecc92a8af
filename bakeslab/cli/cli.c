#include "cli/cli.h"

#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdio_ext.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/temporary.h"
#include "base/version.h"
#include "cli/arguments.h"

static const char *name_of_program;
static char *command_line;
static bool quiet;
static int failed = CLI_FAILED; /* exit status of the command where it fails */
static int stdout_status = -1;  /* not closed yet */

/* ---- Messages ---- */

/* A test may call a command's parts without cli_main. */
static const char *program_name(void) {
  return name_of_program ? name_of_program : program_invocation_short_name;
}

static void complain(const char *format, va_list arguments) {
  char text[4096];
  vsnprintf(text, sizeof text, format, arguments);
  result_one_line(text);
  fprintf(stderr, "%s: %s\n", program_name(), text);
}

void cli_complain(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  complain(format, arguments);
  va_end(arguments);
}

void cli_note(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  if (!quiet) complain(format, arguments);
  va_end(arguments);
}

int cli_fail(const struct error *error) {
  cli_complain("%s", error->text);
  return failed;
}

void cli_out_of_memory(void) {
  cli_complain("out of memory");
  exit(failed);
}

bool cli_quiet(void) {
  return quiet;
}

/* ---- The recorded command line ---- */

/* Appends the word quoted for a shell; `out` has room for 4 bytes a byte. */
static char *append_word(char *out, const char *word) {
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                              "0123456789_-+=./,:@%^";
  if (*word && !word[strspn(word, plain)]) return stpcpy(out, word);
  *out++ = '\'';
  for (; *word; ++word) {
    if (*word == '\'')
      out = stpcpy(out, "'\\''");
    else
      *out++ = *word;
  }
  *out++ = '\'';
  *out = 0;
  return out;
}

char *cli_quote(const char *word) {
  char *quoted = malloc(4 * strlen(word) + 3);
  if (quoted) append_word(quoted, word);
  return quoted;
}

/* False without memory. The program's name stands for argv[0], wherever it was called from. */
static bool set_command_line(int argc, char **argv) {
  size_t room = strlen(program_name()) + 1;
  for (int k = 1; k < argc; ++k) room += 4 * strlen(argv[k]) + 3;
  command_line = malloc(room);
  if (!command_line) return false;
  char *out = stpcpy(command_line, program_name());
  for (int k = 1; k < argc; ++k) {
    *out++ = ' ';
    out = append_word(out, argv[k]);
  }
  return true;
}

const char *cli_command_line(void) {
  return command_line ? command_line : program_name();
}

/* ---- The end of stdout ---- */

int cli_close_stdout(void) {
  if (stdout_status >= 0) return stdout_status;
  bool lost = ferror(stdout) != 0, pending = __fpending(stdout) > 0;
  errno = 0;
  /* A stdout that was closed from the start (EBADF) matters only to those who write. */
  if (fclose(stdout) != 0 && (pending || errno != EBADF)) lost = true;
  stdout_status = lost ? failed : CLI_OK;
  if (lost) cli_complain("stdout: %s", errno ? strerror(errno) : "could not be written");
  return stdout_status;
}

/* For commands that end without it, as argp's --help does. */
static void close_stdout_at_exit(void) {
  if (stdout_status < 0 && cli_close_stdout() != CLI_OK) _exit(failed);
}

int cli_end(enum result result, const struct error *error) {
  int status = result == RESULT_OK ? CLI_OK : cli_fail(error);
  return cli_close_stdout() == CLI_OK ? status : failed;
}

/* ---- What every command's argp shares ---- */

/* argp follows each message by "Try `...' for more information.", and prints that alone after a
 * message of getopt's. So argp writes into memory, and what comes before "Try" is printed at exit:
 * one line. */
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
  case 'h':
    argp_state_help(state, stdout, ARGP_HELP_STD_HELP);
    return 0;
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
    {"quiet", 'q', NULL, 0, "No notes and no progress on stderr; errors are still told", 0},
    {NULL, 'h', NULL, 0, "The same as --help", -1},
    {0}};
const struct argp cli_argp = {.options = common_options, .parser = parse_common};
const struct argp_child cli_options[] = {{&cli_argp, 0, NULL, 0}, {0}};

void cli_parse(const struct argp *argp, int argc, char **argv, void *input) {
  if (argp_parse(argp, argc, argv, 0, NULL, input) != 0) cli_out_of_memory();
}

int cli_run(const struct argp *argp, int argc, char **argv, cli_work *work, void *input) {
  struct error error = {{0}};
  cli_parse(argp, argc, argv, input);
  return cli_end(work(input, &error), &error);
}

/* ---- From a program's arguments to one of its commands ---- */

static void print_help(const struct cli_program *program) {
  printf("Usage: %s COMMAND [OPTION...] ARGUMENT...\n%s\n\n", program->name, program->summary);
  for (const struct cli_command *command = program->commands; command->name; ++command)
    printf("  %-12s%s\n", command->name, command->help);
  printf("  help        this text, or `%s help COMMAND` for one command\n"
         "\n"
         "  -h, --help, --version\n"
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

/* argp names the program by argv[0], so that usage lines say "bakeslab info". */
static int run_command(const struct cli_program *program, const char *word, int argc, char **argv) {
  const struct cli_command *command = find_command(program, word);
  if (!command) {
    cli_complain("%s: no such command; see %s --help", word, program->name);
    return CLI_USAGE;
  }
  char name[64], *called = argv[0];
  snprintf(name, sizeof name, "%s %s", program->name, command->name);
  argv[0] = name;
  set_failed(program, command->name);
  int status = command->run(argc, argv);
  argv[0] = called;
  return status;
}

static int dispatch(const struct cli_program *program, int argc, char **argv) {
  if (argc < 2) {
    cli_complain("no command given; see %s --help", program->name);
    return CLI_USAGE;
  }
  const char *word = argv[1];
  if (!strcmp(word, "help") && argc > 2) {
    char option[] = "--help";
    char *help_argv[] = {argv[0], option, NULL};
    return run_command(program, argv[2], 2, help_argv);
  }
  if (!strcmp(word, "help") || !strcmp(word, "--help") || !strcmp(word, "-h") ||
      !strcmp(word, "-?"))
    print_help(program);
  else if (!strcmp(word, "--version") || !strcmp(word, "-V"))
    puts(argp_program_version);
  else
    return run_command(program, word, argc - 1, argv + 1);
  return cli_close_stdout();
}

int cli_main(const struct cli_program *program, int argc, char **argv) {
  static char version[64]; /* argp looks at it until the program ends */
  struct argument_words arguments = {0};
  struct error error = {{0}};
  int status;
  /* An ignored SIGCHLD, as some parents leave it, would keep us from waiting for programs. */
  signal(SIGCHLD, SIG_DFL);
  signal(SIGPIPE, SIG_IGN); /* a closed pipe is an error like a full disk */
  temporary_mind_signals();
  atexit(close_stdout_at_exit);
  argp_err_exit_status = CLI_USAGE;
  snprintf(version, sizeof version, "%s " CANNED_VERSION, program->name);
  argp_program_version = version;
  name_of_program = program->name;
  enum result result = arguments_expand(argc, argv, &arguments, &error);
  if (result == RESULT_OK && !set_command_line(arguments.count, arguments.words))
    result = result_no_memory(&error);
  if (result == RESULT_OK) {
    status = dispatch(program, arguments.count, arguments.words);
  } else {
    set_failed(program, arguments.count > 1 ? arguments.words[1] : argc > 1 ? argv[1] : "");
    status = cli_fail(&error);
    if (result != RESULT_MEMORY) status = CLI_USAGE;
  }
  arguments_free(&arguments);
  return status;
}
