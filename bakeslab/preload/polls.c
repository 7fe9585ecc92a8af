/* polls.c - preloaded into POV-Ray, whose front end polls: it looks for news 20 times a second, a
 * process begins and ends in a dozen such looks, and sleeps for 0.6 s on the way, each frame for
 * another 0.2 s (vfe/vfe.cpp, 3.7). Here short sleeps and waits are shorter still: a process costs
 * 0.1 s. Pictures do not depend on them. Waits that are longer than a look stay as they are. */
#include <dlfcn.h>
#include <pthread.h>
#include <time.h>

static const long look = 150000000, brief = 2000000; /* ns */

int nanosleep(const struct timespec *time, struct timespec *left) {
  __typeof__(&nanosleep) next = (__typeof__(&nanosleep))dlsym(RTLD_NEXT, "nanosleep");
  const struct timespec shorter = {.tv_nsec = brief};
  return next(time->tv_sec == 0 && time->tv_nsec > brief && time->tv_nsec < look ? &shorter : time,
              left);
}

/* Whether `until` is nearer than a look by that clock, but further than `brief`; sets *sooner. */
static int is_look(clockid_t clock, const struct timespec *until, struct timespec *sooner) {
  if (clock_gettime(clock, sooner) != 0) return 0;
  long seconds = until->tv_sec - sooner->tv_sec;
  if (seconds < 0 || seconds > 1) return 0;
  long nanoseconds = 1000000000 * seconds + until->tv_nsec - sooner->tv_nsec;
  sooner->tv_nsec += brief;
  sooner->tv_sec += sooner->tv_nsec / 1000000000;
  sooner->tv_nsec %= 1000000000;
  return nanoseconds > brief && nanoseconds < look;
}

/* The condition knows its clock, and we do not; but their times are decades apart. */
int pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex,
                           const struct timespec *until) {
  static const char name[] = "pthread_cond_timedwait";
  struct timespec sooner;
  /* On amd64, dlsym may find the one of 2002, of another structure. */
  void *found = dlvsym(RTLD_NEXT, name, "GLIBC_2.3.2");
  if (!found) found = dlsym(RTLD_NEXT, name);
  __typeof__(&pthread_cond_timedwait) next = (__typeof__(&pthread_cond_timedwait))found;
  if (is_look(CLOCK_MONOTONIC, until, &sooner) || is_look(CLOCK_REALTIME, until, &sooner))
    until = &sooner;
  return next(condition, mutex, until);
}
