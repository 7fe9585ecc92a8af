/* test_process.c - other programs: what they are given, what they say, how they end. */
#include "base/process.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>

#include "helpers.h"

/* Runs a line of the shell; what it wrote and said is in *process. */
static enum result shell(const char *line, struct process *process, struct error *error) {
  static const char *const variables[] = {"GIVEN", "a value=", "HOME", "/changed", NULL};
  const char *words[] = {"sh", "-c", line, NULL};
  *process = (struct process){.words = words,
                              .environment = variables,
                              .folder = "/usr",
                              .in = PROCESS_NOTHING,
                              .out = PROCESS_SAID,
                              .errors = PROCESS_SAID};
  return process_run(process, error);
}

TEST(test_given) {
  struct process process;
  struct error error;
  assert_ok(shell("echo $GIVEN $HOME; pwd >&2; cat", &process, &error), &error);
  assert_string_equal(process.said, "a value= /changed\n/usr\n");
  assert_null(getenv("GIVEN"));
}

TEST(test_ends) {
  static const struct {
    const char *line, *message;
    int exit;
  } cases[] = {
      {"echo; echo ' first'; echo second; exit 3", "first", 3},
      {"exit 3", "sh failed with exit status 3", 3},
      {"echo words; kill -SEGV $$", "sh was killed by signal 11 (Segmentation fault)", 139},
      {"exit 137", "sh was killed by signal 9 (Killed)", 137},
  };
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    struct process process;
    struct error error;
    assert_int_equal(shell(cases[k].line, &process, &error), RESULT_IO);
    assert_string_equal(error.text, cases[k].message);
    assert_int_equal(process.exit, cases[k].exit);
  }
}

/* Neither a program that is not there nor one that says too much makes its parent wait. */
TEST(test_troubles) {
  struct process process;
  struct error error;
  const char *words[] = {"/nowhere/program", NULL};
  process = (struct process){
      .words = words, .in = PROCESS_NOTHING, .out = PROCESS_NOTHING, .errors = PROCESS_SAID};
  assert_int_equal(process_run(&process, &error), RESULT_IO);
  assert_int_equal(process.exit, PROCESS_MISSING);
  assert_string_equal(error.text, "/nowhere/program: cannot be run (No such file or directory)");
  assert_int_equal(shell("yes", &process, &error), RESULT_IO);
  assert_int_equal(strlen(process.said), sizeof process.said - 1);
}

static volatile sig_atomic_t stop;

static void on_alarm(int number) {
  (void)number;
  stop = 1;
}

/* With what it has started, and in whatever it is waiting for. */
TEST(test_stopped) {
  static const char *const words[] = {"sh", "-c", "sleep 1000 & echo $!; wait", NULL};
  struct process process = {.words = words,
                            .in = PROCESS_NOTHING,
                            .out = PROCESS_SAID,
                            .errors = PROCESS_SAID,
                            .stop = &stop};
  struct error error;
  struct itimerval soon = {.it_value = {0, 300000}};
  char path[64], state = 'Z';
  signal(SIGALRM, on_alarm);
  setitimer(ITIMER_REAL, &soon, NULL);
  assert_int_equal(process_run(&process, &error), RESULT_STOPPED);
  int child = atoi(process.said);
  assert_true(child > 0);
  snprintf(path, sizeof path, "/proc/%d/stat", child);
  for (int tries = 0; tries < 100; ++tries) {
    FILE *file = fopen(path, "re");
    state = 'Z';
    if (file) assert_int_equal(fscanf(file, "%*s %*s %c", &state), 1);
    if (file) fclose(file);
    if (state == 'Z') break;
    nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
  }
  assert_int_equal(state, 'Z');
}

int main(void) {
  return testing_run(NULL, NULL);
}
