/* test_polls.c - what is preloaded into POV-Ray shortens the looks of its front end, sleeps and
 * waits between 2 ms and 150 ms, and no other. It is linked here: our own calls meet it. A machine
 * that is busy wakes us late, never early: what is shortened is so at least once in many times,
 * what is not lasts each time. */
#include <errno.h>
#include <pthread.h>
#include <time.h>

#include "testing.h"

enum { TIMES = 20, FEW = 3 };
static const double ms = 1e-3;

static double now(clockid_t clock) {
  struct timespec time;
  clock_gettime(clock, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static struct timespec time_of(double seconds) {
  const time_t whole = (time_t)seconds;
  return (struct timespec){whole, (long)(1e9 * (seconds - (double)whole))};
}

/* The shortest of so many sleeps. */
static double sleeps(double seconds, int times) {
  const struct timespec asked = time_of(seconds);
  double least = INFINITY;
  for (int k = 0; k < times; ++k) {
    double start = now(CLOCK_MONOTONIC);
    assert_int_equal(nanosleep(&asked, NULL), 0);
    least = fmin(least, now(CLOCK_MONOTONIC) - start);
  }
  return least;
}

TEST(test_sleeps) {
  assert_true(sleeps(10 * ms, TIMES) < 9 * ms);
  assert_true(sleeps(50 * ms, TIMES) < 25 * ms);
  assert_true(sleeps(149 * ms, TIMES) < 75 * ms);
}

TEST(test_other_sleeps) {
  assert_true(sleeps(1 * ms, FEW) >= 1 * ms);
  assert_true(sleeps(151 * ms, FEW) >= 150.9 * ms);
  assert_true(sleeps(1010 * ms, 1) >= 1009.9 * ms); /* 10 ms and a second */
}

/* A sleep that is refused is refused still. */
TEST(test_refused) {
  const struct timespec wrong = {.tv_nsec = -1};
  assert_int_equal(nanosleep(&wrong, NULL), -1);
  assert_int_equal(errno, EINVAL);
}

/* The shortest of so many waits for what never comes, by a condition's clock. */
static double waits(clockid_t clock, double seconds, int times) {
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_condattr_t attributes;
  pthread_cond_t condition;
  double least = INFINITY;
  pthread_condattr_init(&attributes);
  assert_int_equal(pthread_condattr_setclock(&attributes, clock), 0);
  assert_int_equal(pthread_cond_init(&condition, &attributes), 0);
  pthread_mutex_lock(&mutex);
  for (int k = 0; k < times; ++k) {
    const double start = now(clock);
    const struct timespec until = time_of(start + seconds);
    int answer = 0;
    while (answer == 0) answer = pthread_cond_timedwait(&condition, &mutex, &until);
    assert_int_equal(answer, ETIMEDOUT);
    least = fmin(least, now(clock) - start);
  }
  pthread_mutex_unlock(&mutex);
  pthread_cond_destroy(&condition);
  pthread_condattr_destroy(&attributes);
  return least;
}

TEST(test_waits) {
  assert_true(waits(CLOCK_REALTIME, 50 * ms, TIMES) < 25 * ms);
  assert_true(waits(CLOCK_MONOTONIC, 50 * ms, TIMES) < 25 * ms);
  assert_true(waits(CLOCK_REALTIME, 140 * ms, TIMES) < 70 * ms);
}

TEST(test_other_waits) {
  assert_true(waits(CLOCK_REALTIME, 160 * ms, FEW) >= 159.9 * ms);
  assert_true(waits(CLOCK_MONOTONIC, 160 * ms, FEW) >= 159.9 * ms);
  assert_true(waits(CLOCK_MONOTONIC, 1010 * ms, 1) >= 1009.9 * ms);
  assert_true(waits(CLOCK_MONOTONIC, -5, FEW) < 5); /* over before it begins */
}

int main(void) {
  return testing_run(NULL, NULL);
}
