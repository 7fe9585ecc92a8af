/* test_tiles.c - every piece once, whatever the number of threads, and the same failure. */
#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>
#include <time.h>

#include "base/tiles.h"
#include "helpers.h"

enum { TILES = 500, THREADS = 7 };

struct job {
  atomic_int runs[TILES];
  int of_worker[THREADS]; /* scratch memory: no other thread's */
  int threads;
  bool bad_worker;
  int failing[2]; /* tiles; the first one takes longer */
  double done;
  bool back;
};

static enum result work(void *context, int tile, int worker, struct error *error) {
  struct job *job = context;
  if (worker < 0 || worker >= job->threads) {
    job->bad_worker = true;
    return RESULT_OK;
  }
  ++job->of_worker[worker];
  atomic_fetch_add(&job->runs[tile], 1);
  /* Those after a failure take long, so that a thread that was stopped on its way to fail
   * comes in time. */
  if (job->failing[1] >= 0 && tile > job->failing[1])
    nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
  for (int k = 0; k < 2; ++k)
    if (tile == job->failing[k]) {
      if (k == 0) nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
      return result_fail(error, k ? RESULT_MEMORY : RESULT_BAD, "tile %d", tile);
    }
  return RESULT_OK;
}

static void progress(void *context, double done) {
  struct job *job = context;
  if (done <= job->done || done > 1) job->back = true;
  job->done = done;
}

TEST(test_all_once) {
  for (int threads = 1; threads <= THREADS; ++threads) {
    struct job job = {.threads = threads, .failing = {-1, -1}};
    struct error error = {""};
    assert_int_equal(tiles_run(threads, TILES, work, progress, &job, &error), RESULT_OK);
    int total = 0;
    for (int k = 0; k < TILES; ++k) assert_int_equal(job.runs[k], 1);
    for (int k = 0; k < THREADS; ++k) total += job.of_worker[k];
    assert_int_equal(total, TILES);
    assert_false(job.bad_worker);
    assert_false(job.back);
    if (threads == 1) assert_near(job.done, 1, 0);
  }
}

TEST(test_lowest_failure) {
  for (int k = 0; k < 20; ++k) {
    struct job job = {.threads = THREADS, .failing = {100, 101}};
    struct error error = {""};
    assert_int_equal(tiles_run(THREADS, TILES, work, NULL, &job, &error), RESULT_BAD);
    assert_string_equal(error.text, "tile 100");
    assert_int_equal(job.runs[TILES - 1], 0);
  }
}

TEST(test_few) {
  struct job job = {.threads = 2, .failing = {-1, -1}};
  struct error error = {""};
  assert_int_equal(tiles_run(5, 0, work, NULL, &job, &error), RESULT_OK);
  assert_int_equal(tiles_run(5, 2, work, NULL, &job, &error), RESULT_OK);
  assert_false(job.bad_worker); /* no more workers than tiles */
  assert_int_equal(tiles_run(0, 2, work, NULL, &job, &error), RESULT_BAD);
  assert_true(tiles_processors() >= 1);
}

int main(void) {
  return testing_run(NULL, NULL);
}
