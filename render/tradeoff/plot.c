/* plot.c - see plot.h. gnuplot reads its script from a file without a name and writes to
 * standard output: names never meet its language. */
#include "tradeoff/plot.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/output.h"
#include "base/process.h"

static bool ends_in(const char *path, const char *suffix) {
  size_t length = strlen(path), tail = strlen(suffix);
  return length > tail && !strcasecmp(path + length - tail, suffix);
}

/* NULL: of another kind. */
static const char *terminal(const char *path) {
  if (ends_in(path, ".svg"))
    return "set terminal svg size 900,600 font 'sans,15' background 'white'";
  if (ends_in(path, ".png")) return "set terminal pngcairo size 900,600 font 'sans,12'";
  return NULL;
}

/* RESULT_BAD without gnuplot, RESULT_IO where it fails. */
static enum result run_gnuplot(const char *path, int in, int out, struct error *error) {
  static const char *const words[] = {"gnuplot", NULL};
  struct process process = {.words = words, .in = in, .out = out, .errors = PROCESS_SAID};
  struct error why;
  if (process_run(&process, &why) == RESULT_OK) return RESULT_OK;
  if (process.exit == PROCESS_MISSING)
    return result_fail(error, RESULT_BAD,
                       "%s: a plot needs gnuplot, which is not installed (Debian: gnuplot-nox); "
                       "leave --plot out for the table alone",
                       path);
  return result_fail(error, RESULT_IO, "%s: gnuplot failed: %s", path, why.text);
}

enum result plot_check(const char *path, struct error *error) {
  if (!terminal(path))
    return result_fail(error, RESULT_BAD, "%s: a plot must end in .svg or .png", path);
  return run_gnuplot(path, PROCESS_NOTHING, PROCESS_NOTHING, error);
}

/* gnuplot does not look whether its words get to the disk: the last must be there. */
static bool is_whole(int out) {
  static const char *const ends[] = {"</svg>", "IEND"};
  char tail[17] = "";
  off_t size = lseek(out, 0, SEEK_END), from = size - (off_t)sizeof tail + 1;
  ssize_t got = pread(out, tail, sizeof tail - 1, from > 0 ? from : 0);
  for (size_t k = 0; k < sizeof ends / sizeof *ends; ++k)
    if (got > 0 && memmem(tail, (size_t)got, ends[k], strlen(ends[k]))) return true;
  return false;
}

static enum result draw(const char *path, const char *script, FILE *in, int out,
                        struct error *error) {
  bool good = fprintf(in, "%s\n%s", terminal(path), script) > 0 && fflush(in) == 0;
  if (!good || lseek(fileno(in), 0, SEEK_SET) != 0)
    return result_fail(error, RESULT_IO, "%s: gnuplot's script: %s", path, strerror(errno));
  enum result result = run_gnuplot(path, fileno(in), out, error);
  if (result == RESULT_OK && !is_whole(out))
    result = result_fail(error, RESULT_IO, "%s: gnuplot did not write all of it; is the disk full?",
                         path);
  return result;
}

enum result plot_write(const char *path, const char *script, struct error *error) {
  struct output output = {0};
  FILE *in = tmpfile();
  if (!in) return result_fail(error, RESULT_IO, "%s: a temporary file: %s", path, strerror(errno));
  enum result result = output_begin(&output, path, error);
  if (result == RESULT_OK) result = draw(path, script, in, output.fd, error);
  if (result == RESULT_OK) result = output_commit(&output, error);
  output_abandon(&output);
  fclose(in);
  return result;
}

void plot_quote(FILE *file, const char *text) {
  fputc('\'', file);
  for (; *text; ++text) {
    if (*text == '\'') fputc('\'', file);
    fputc((unsigned char)*text < ' ' ? ' ' : *text, file);
  }
  fputc('\'', file);
}
