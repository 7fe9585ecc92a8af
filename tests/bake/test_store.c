/* test_store.c - who renders which batch of a folder that many share: each is rendered once, unless
 * who does it dies; leases count by the folder's time; who leaves last removes the folder. */
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/files.h"
#include "batch/bake_claim.h"
#include "batch/bake_store.h"
#include "testing.h"

enum { PROCESSES = 5, TURNS = 60, BATCHES = 40, KILLS = 30 };

/* In place of the C library's: these wait first, so that others have time to act between a look
 * and what follows from it. */
DIR *opendir(const char *path) {
  usleep((useconds_t)(random() % 300));
  int file = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  return file < 0 ? NULL : fdopendir(file);
}

int link(const char *from, const char *to) {
  usleep((useconds_t)(random() % 300));
  return (int)syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0);
}

/* This machine's clock is an hour late. */
time_t time(time_t *out) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  now.tv_sec -= 3600;
  if (out) *out = now.tv_sec;
  return now.tv_sec;
}

/* Shared by the processes. */
struct tally {
  atomic_int rendered[BATCHES], opened, wrong;
};

static char folder[64], output[128], store_folder[160];

static struct tally *begin(void) {
  struct tally *tally =
      mmap(NULL, sizeof *tally, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  assert_true(tally != MAP_FAILED);
  snprintf(folder, sizeof folder, "/tmp/store.XXXXXX");
  assert_non_null(mkdtemp(folder));
  snprintf(output, sizeof output, "%s/x.tif", folder);
  snprintf(store_folder, sizeof store_folder, "%s.partial", output);
  return tally;
}

static void name_batch(int batch, char key[33]) {
  char text[16];
  snprintf(text, sizeof text, "%d", batch);
  bake_store_key(key, text, NULL);
}

static bool is_there(const struct bake_store *store, const char *key) {
  char *path = bake_store_path(store, key);
  bool there = access(path, F_OK) == 0;
  free(path);
  return there;
}

/* Renders a batch, unless it is there or another's. Returns whether it is there. */
static bool render(const struct bake_store *store, int batch, struct tally *tally) {
  char key[33], *scratch = NULL;
  int claim;
  name_batch(batch, key);
  if (is_there(store, key)) return true;
  if (bake_claim_take(store->worker, key, &claim, NULL) != RESULT_OK) {
    ++tally->wrong;
    return true;
  }
  if (claim == BAKE_CLAIM_OTHERS) return false;
  if (!is_there(store, key)) {
    if (bake_store_scratch(store, key, &scratch, NULL) != RESULT_OK) ++tally->wrong;
    usleep((useconds_t)(random() % 2000));
    ++tally->rendered[batch];
    if (bake_store_commit(store, scratch, key, NULL) != RESULT_OK) ++tally->wrong;
    free(scratch);
  }
  bake_claim_end(store->worker, key, claim);
  return true;
}

/* A process that renders all that is left, each from a batch of its own. */
static pid_t start_worker(int number, struct tally *tally) {
  pid_t pid = fork();
  if (pid != 0) return pid;
  struct bake_store store;
  int there = 0;
  srandom((unsigned)number);
  if (bake_store_open(output, 1, &store, NULL) != RESULT_OK) ++tally->wrong;
  int first = (int)(random() % BATCHES);
  while (there < BATCHES) {
    there = 0;
    for (int k = 0; k < BATCHES; ++k) there += render(&store, (first + k) % BATCHES, tally);
    usleep(1000);
  }
  bake_store_close(&store, BAKE_STORE_DONE);
  _exit(0);
}

static int count_rendered(const struct tally *tally, int *least) {
  int sum = 0;
  *least = tally->rendered[0];
  for (int k = 0; k < BATCHES; ++k) {
    sum += tally->rendered[k];
    if (tally->rendered[k] < *least) *least = tally->rendered[k];
  }
  return sum;
}

TEST(test_each_once) {
  struct tally *tally = begin();
  int least;
  for (int k = 0; k < PROCESSES; ++k) start_worker(k, tally);
  while (wait(NULL) > 0) continue;
  assert_int_equal(tally->wrong, 0);
  assert_int_equal(count_rendered(tally, &least), BATCHES);
  assert_int_equal(least, 1);
  assert_int_equal(rmdir(folder), 0); /* nothing is left */
}

/* What the dead had in hand is taken over at once, on this machine. */
TEST(test_killed) {
  struct tally *tally = begin();
  pid_t pids[PROCESSES];
  int least, number = 0, killed = 0;
  struct bake_store store; /* keeps the store, while others come and go */
  assert_int_equal(bake_store_open(output, 1, &store, NULL), RESULT_OK);
  for (int k = 0; k < PROCESSES; ++k) pids[k] = start_worker(number++, tally);
  for (; killed < KILLS; ++killed) {
    int k = killed % PROCESSES;
    usleep((useconds_t)(random() % 3000));
    kill(pids[k], SIGKILL);
    waitpid(pids[k], NULL, 0);
    pids[k] = start_worker(number++, tally);
  }
  for (int k = 0; k < PROCESSES; ++k) waitpid(pids[k], NULL, 0);
  int sum = count_rendered(tally, &least);
  printf("# %d batches, %d kills, rendered %d times\n", BATCHES, killed, sum);
  assert_int_equal(tally->wrong, 0);
  assert_true(least >= 1);
  assert_true(sum <= BATCHES + killed);
  assert_true(bake_store_is_done(&store));
  bake_store_close(&store, BAKE_STORE_KEPT);
  assert_int_equal(rmdir(folder), 0);
}

/* A claim of a worker on another machine that was last heard of so many seconds ago. */
static void claim_elsewhere(const struct bake_store *store, const char *key, double age) {
  char path[256], claim[256];
  struct stat now;
  snprintf(path, sizeof path, "%s/worker.abcdef", store->directory);
  snprintf(claim, sizeof claim, "%s/%s.0", store->directory, key);
  unlink(path);
  unlink(claim);
  assert_int_equal(files_write(store->directory, "worker.abcdef",
                               "abcdef\nelsewhere\nboot/pid:[1]\n"
                               "00000000000000000000000000000000\n1 1 1\n",
                               NULL),
                   RESULT_OK);
  assert_int_equal(stat(path, &now), 0);
  struct timespec times[2] = {now.st_mtim, now.st_mtim};
  times[1].tv_sec -= (time_t)age;
  assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
  assert_int_equal(link(path, claim), 0);
}

TEST(test_lease) {
  begin();
  struct bake_store store;
  struct bake_worker_seen holder;
  char key[33];
  int claim;
  name_batch(0, key);
  assert_int_equal(bake_store_open(output, 1, &store, NULL), RESULT_OK);
  claim_elsewhere(&store, key, BAKE_WORKER_LEASE - 10);
  assert_int_equal(bake_claim_take(store.worker, key, &claim, NULL), RESULT_OK);
  assert_int_equal(claim, BAKE_CLAIM_OTHERS);
  assert_true(bake_claim_look(store.directory, key, bake_worker_now(store.worker), &holder));
  assert_string_equal(holder.name.host, "elsewhere");
  assert_true(bake_store_has_others(&store));
  claim_elsewhere(&store, key, BAKE_WORKER_LEASE + 10);
  assert_false(bake_store_has_others(&store));
  assert_int_equal(bake_claim_take(store.worker, key, &claim, NULL), RESULT_OK);
  assert_int_equal(claim, 1); /* taken over; the dead one's is left */
  bake_claim_leave(store.worker, key, claim);
  assert_int_equal(bake_claim_take(store.worker, key, &claim, NULL), RESULT_OK);
  assert_int_equal(claim, 1);
  bake_claim_end(store.worker, key, claim);
  assert_false(bake_claim_look(store.directory, key, bake_worker_now(store.worker), &holder));
  bake_store_close(&store, BAKE_STORE_KEPT);
  assert_int_equal(rmdir(folder), 0);
}

/* Bakes that come, are done or stopped, and go, at the same time. */
static void come_and_go(struct tally *tally) {
  for (int turn = 0; turn < TURNS; ++turn) {
    struct bake_store store;
    char *scratch = NULL;
    if (bake_store_open(output, 1, &store, NULL) != RESULT_OK) ++tally->wrong;
    ++tally->opened;
    if (bake_store_scratch(&store, NULL, &scratch, NULL) != RESULT_OK) ++tally->wrong;
    if (!scratch || access(scratch, F_OK) != 0) ++tally->wrong;
    usleep((useconds_t)(random() % 1000));
    if (!scratch || rmdir(scratch) != 0) ++tally->wrong; /* nobody else's to remove */
    free(scratch);
    bake_store_close(&store, turn % 3 > 0 ? BAKE_STORE_DONE : BAKE_STORE_KEPT);
  }
}

TEST(test_comings_and_goings) {
  struct tally *tally = begin();
  for (int k = 0; k < PROCESSES; ++k)
    if (fork() == 0) {
      srandom((unsigned)k);
      come_and_go(tally);
      _exit(0);
    }
  while (wait(NULL) > 0) continue;
  assert_int_equal(tally->opened, PROCESSES * TURNS);
  assert_int_equal(tally->wrong, 0);
  assert_int_equal(rmdir(folder), 0);
}

int main(void) {
  return testing_run(NULL, NULL);
}
