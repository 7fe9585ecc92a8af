/* test_store.c - two bakes of the same output: the store has one holder, whoever comes and goes
 * at the same time, or is killed. */
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "batch/bake_store.h"
#include "testing.h"

enum { PROCESSES = 4, TURNS = 500 };

/* In place of the C library's: waits first, so that other processes have time to act between the
 * opening of a lock and its taking. */
int fcntl(int file, int command, ...) {
  va_list rest;
  va_start(rest, command);
  void *argument = va_arg(rest, void *);
  va_end(rest);
  usleep((useconds_t)(random() % 300));
  return (int)syscall(SYS_fcntl, file, command, argument);
}

/* Shared by the processes. */
struct tally {
  atomic_int holders, opened, refused, wrong;
};

/* Takes and leaves the store again and again, as bakes do that are done or stopped. */
static void come_and_go(const char *output, struct tally *tally) {
  for (int turn = 0; turn < TURNS; ++turn) {
    struct bake_store store;
    struct error error;
    char *scratch = NULL;
    if (bake_store_open(output, false, &store, &error) == RESULT_OK) {
      ++tally->opened;
      if (++tally->holders != 1) ++tally->wrong;
      if (bake_store_scratch(&store, &scratch, NULL) != RESULT_OK) ++tally->wrong;
      if (scratch && access(scratch, F_OK) != 0) ++tally->wrong;
      free(scratch);
      --tally->holders;
    } else {
      ++tally->refused;
    }
    bake_store_close(&store, turn % 3 > 0);
  }
}

TEST(test_one_holder) {
  char folder[] = "/tmp/store.XXXXXX", output[64];
  struct tally *tally =
      mmap(NULL, sizeof *tally, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  assert_true(tally != MAP_FAILED);
  assert_non_null(mkdtemp(folder));
  snprintf(output, sizeof output, "%s/x.tif", folder);
  for (int k = 0; k < PROCESSES; ++k)
    if (fork() == 0) {
      srandom((unsigned)k);
      come_and_go(output, tally);
      _exit(0);
    }
  for (int k = 0; k < PROCESSES; ++k) wait(NULL);
  printf("# %d openings, %d refusals\n", tally->opened, tally->refused);
  assert_int_equal(tally->opened + tally->refused, PROCESSES * TURNS);
  assert_int_equal(tally->wrong, 0);
  assert_true(tally->opened >= TURNS / 10);
  struct bake_store store;
  assert_int_equal(bake_store_open(output, false, &store, NULL), RESULT_OK);
  bake_store_close(&store, true);
  assert_int_equal(rmdir(folder), 0); /* nothing is left */
}

/* A bake that is killed while a child of it has not become POV-Ray yet. */
TEST(test_killed_holder) {
  char folder[] = "/tmp/store.XXXXXX", output[64];
  int ends[2];
  pid_t child = 0;
  assert_non_null(mkdtemp(folder));
  snprintf(output, sizeof output, "%s/x.tif", folder);
  assert_int_equal(pipe(ends), 0);
  pid_t holder = fork();
  if (holder == 0) {
    struct bake_store store;
    if (bake_store_open(output, false, &store, NULL) != RESULT_OK) _exit(1);
    child = fork();
    if (child > 0 && write(ends[1], &child, sizeof child) != sizeof child) _exit(1);
    for (;;) pause();
  }
  close(ends[1]);
  assert_int_equal(read(ends[0], &child, sizeof child), sizeof child);
  struct bake_store store;
  assert_int_equal(bake_store_open(output, false, &store, NULL), RESULT_IO);
  bake_store_close(&store, false);
  kill(holder, SIGKILL);
  waitpid(holder, NULL, 0);
  enum result result = bake_store_open(output, false, &store, NULL);
  kill(child, SIGKILL);
  bake_store_close(&store, true);
  assert_int_equal(result, RESULT_OK);
  assert_int_equal(rmdir(folder), 0);
}

int main(void) {
  return testing_run(NULL, NULL);
}
