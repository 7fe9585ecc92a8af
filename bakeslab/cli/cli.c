/* cli.c - messages, sizes, the recorded command line and the end of stdout. */
#include "cli/cli.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdio_ext.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_SIZE = 65536 };

static const char *name_of_program;

static char *command_line;

/* A test may call a command's parts without cli_main. */
static const char *program_name(void) {
  return name_of_program ? name_of_program : program_invocation_short_name;
}

static void say(const char *format, va_list arguments) {
  char text[4096];
  vsnprintf(text, sizeof text, format, arguments);
  result_one_line(text);
  fprintf(stderr, "%s: %s\n", program_name(), text);
}

void cli_complain(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  say(format, arguments);
  va_end(arguments);
}

void cli_note(const char *format, ...) {
  va_list arguments;
  if (cli_quiet()) return;
  va_start(arguments, format);
  say(format, arguments);
  va_end(arguments);
}

int cli_fail(const struct error *error) {
  cli_complain("%s", error->text);
  return CLI_FAILED;
}

/* A decimal number from 1 to MAX_SIZE without sign or blanks. */
static bool parse_count(const char *text, const char **end, int *count) {
  int value = 0;
  const char *c = text;
  for (; *c >= '0' && *c <= '9'; ++c) {
    value = value * 10 + (*c - '0');
    if (value > MAX_SIZE) return false;
  }
  *end = c;
  *count = value;
  return c > text && value >= 1;
}

bool cli_parse_size(const char *text, int size[2]) {
  const char *end;
  int n, m;
  if (!parse_count(text, &end, &n)) return false;
  m = n;
  if (*end == 'x' && !parse_count(end + 1, &end, &m)) return false;
  if (*end) return false;
  size[0] = n;
  size[1] = m;
  return true;
}

static bool needs_quotes(const char *word) {
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                              "0123456789_-+=./,:@%^";
  return !*word || word[strspn(word, plain)];
}

/* Appends the word quoted for a shell; `out` has room for 4 bytes a byte. */
static char *append_word(char *out, const char *word) {
  if (!needs_quotes(word)) return stpcpy(out, word);
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

bool cli_set_command_line(const char *program, int argc, char **argv) {
  size_t room = strlen(program) + 1;
  for (int k = 1; k < argc; ++k) room += 4 * strlen(argv[k]) + 3;
  name_of_program = program;
  free(command_line);
  command_line = malloc(room);
  if (!command_line) return false;
  char *out = stpcpy(command_line, program); /* wherever it was called from */
  for (int k = 1; k < argc; ++k) {
    *out++ = ' ';
    out = append_word(out, argv[k]);
  }
  return true;
}

const char *cli_command_line(void) {
  return command_line ? command_line : program_name();
}

static int stdout_status = -1; /* not closed yet */

int cli_close_stdout(void) {
  if (stdout_status >= 0) return stdout_status;
  bool failed = ferror(stdout) != 0, pending = __fpending(stdout) > 0;
  errno = 0;
  /* A stdout that was closed from the start is missed by nobody who writes nothing. */
  if (fclose(stdout) != 0 && (pending || errno != EBADF)) failed = true;
  stdout_status = failed ? CLI_FAILED : CLI_OK;
  if (failed) cli_complain("stdout: %s", errno ? strerror(errno) : "could not be written");
  return stdout_status;
}

void cli_check_stdout_at_exit(void) {
  /* Who closed it himself has already chosen his exit status. */
  if (stdout_status < 0 && cli_close_stdout() != CLI_OK) _exit(CLI_FAILED);
}
