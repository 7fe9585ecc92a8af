/* plot.c - see plot.h. gnuplot reads its script from a file without a name and writes to
 * standard output: names never meet its language. */
#include "tradeoff/plot.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/output.h"

enum { NOT_THERE = 127 };

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

/* Starts it with these as standard input, output and error; returns its exit status, NOT_THERE,
 * or -1 with errno. */
static int run_gnuplot(int in, int out, int errors) {
  char name[] = "gnuplot";
  char *arguments[] = {name, NULL};
  posix_spawn_file_actions_t actions;
  pid_t child;
  int status = 0;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  int failure = posix_spawnp(&child, name, &actions, NULL, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT) return NOT_THERE;
  errno = failure;
  if (failure) return -1;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

static enum result not_there(const char *path, struct error *error) {
  return result_fail(error, RESULT_BAD,
                     "%s: a plot needs gnuplot, which is not installed (Debian: gnuplot-nox); "
                     "leave --plot out for the table alone",
                     path);
}

enum result plot_check(const char *path, struct error *error) {
  if (!terminal(path))
    return result_fail(error, RESULT_BAD, "%s: a plot must end in .svg or .png", path);
  int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nothing < 0) return result_fail(error, RESULT_IO, "/dev/null: %s", strerror(errno));
  int status = run_gnuplot(nothing, nothing, nothing);
  close(nothing);
  return status == 0 ? RESULT_OK : not_there(path, error);
}

/* What gnuplot complained of, its first line with words. */
static void first_words(FILE *said, char words[200]) {
  rewind(said);
  words[0] = 0;
  while (fgets(words, 200, said))
    if (words[strspn(words, " \t\r\n^")]) break;
  result_one_line(words);
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

static enum result draw(const char *path, const char *script, FILE *in, FILE *said, int out,
                        struct error *error) {
  char words[200];
  bool good = fprintf(in, "%s\n%s", terminal(path), script) > 0 && fflush(in) == 0;
  if (!good || lseek(fileno(in), 0, SEEK_SET) != 0)
    return result_fail(error, RESULT_IO, "%s: gnuplot's script: %s", path, strerror(errno));
  int status = run_gnuplot(fileno(in), out, fileno(said));
  if (status == NOT_THERE) return not_there(path, error);
  if (status == 0 && is_whole(out)) return RESULT_OK;
  first_words(said, words);
  if (status == 0 && !*words)
    return result_fail(error, RESULT_IO, "%s: gnuplot did not write all of it; is the disk full?",
                       path);
  return result_fail(error, RESULT_IO, "%s: gnuplot failed: %s", path, words);
}

enum result plot_write(const char *path, const char *script, struct error *error) {
  struct output output = {0};
  FILE *in = tmpfile(), *said = tmpfile();
  enum result result = RESULT_OK;
  if (!in || !said)
    result = result_fail(error, RESULT_IO, "%s: a temporary file: %s", path, strerror(errno));
  if (result == RESULT_OK) result = output_begin(&output, path, error);
  if (result == RESULT_OK) {
    result = draw(path, script, in, said, output.fd, error);
    if (result == RESULT_OK) result = output_commit(&output, error);
    output_abandon(&output);
  }
  if (in) fclose(in);
  if (said) fclose(said);
  return result;
}
