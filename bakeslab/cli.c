/* cli.c - messages, arguments and exit statuses that all subcommands share. */
#include "cli.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdio_ext.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_SIZE = 65536 };

static char *command_line;

static bool quiet;

static void say(const char *format, va_list arguments) {
  char text[4096];
  vsnprintf(text, sizeof text, format, arguments);
  slab_one_line(text);
  fprintf(stderr, "bakeslab: %s\n", text);
}

void cli_complain(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  say(format, arguments);
  va_end(arguments);
}

void cli_note(const char *format, ...) {
  va_list arguments;
  if (quiet) return;
  va_start(arguments, format);
  say(format, arguments);
  va_end(arguments);
}

int cli_fail(const struct slab_error *error) {
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

static error_t parse_common(int key, char *argument, struct argp_state *state) {
  (void)argument, (void)state;
  if (key != 'q') return ARGP_ERR_UNKNOWN;
  quiet = true;
  return 0;
}

static const struct argp_option common_options[] = {
    {"quiet", 'q', NULL, 0, "No notes and no progress on stderr; errors are still told", 0}, {0}};
static const struct argp common = {.options = common_options, .parser = parse_common};
const struct argp_child cli_options[] = {{&common, 0, NULL, 0}, {0}};

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

void cli_set_command_line(int argc, char **argv) {
  size_t room = 1;
  for (int k = 0; k < argc; ++k) room += 4 * strlen(argv[k]) + 3;
  free(command_line);
  command_line = malloc(room);
  if (!command_line) return;
  char *out = stpcpy(command_line, "bakeslab"); /* wherever it was called from */
  for (int k = 1; k < argc; ++k) {
    *out++ = ' ';
    out = append_word(out, argv[k]);
  }
}

const char *cli_command_line(void) {
  return command_line ? command_line : "bakeslab";
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
