/* temporary.c - names in slots that a signal handler may read at any moment, on any thread. */
#include "base/temporary.h"

#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/files.h"

enum { SLOTS = 16 }; /* more at once are not removed by a signal */

static char *_Atomic slots[SLOTS];

/* Replaces a slot that holds `from`, if there is one. */
static bool replace(char *from, char *to) {
  for (int k = 0; k < SLOTS; ++k) {
    char *expected = from;
    if (atomic_compare_exchange_strong(&slots[k], &expected, to)) return true;
  }
  return false;
}

/* `fd` is NULL for a folder. No signal comes between making and remembering it. */
static char *make(const char *path, int *fd) {
  char *name;
  sigset_t all, before;
  if (asprintf(&name, "%s.XXXXXX", path) < 0) {
    errno = ENOMEM;
    return NULL;
  }
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  bool made = fd ? (*fd = mkstemp(name)) >= 0 : mkdtemp(name) != NULL;
  int why = errno;
  if (made) replace(NULL, name);
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  if (!made) {
    free(name);
    errno = why;
    return NULL;
  }
  mode_t mask = umask(0);
  umask(mask);
  /* It was made private; a file system without modes does not matter. */
  (void)!(fd ? fchmod(*fd, 0666 & ~mask) : chmod(name, 0777 & ~mask));
  return name;
}

char *temporary_file(const char *path, int *fd) {
  return make(path, fd);
}

char *temporary_folder(const char *path) {
  return make(path, NULL);
}

/* A name that is in no slot may be in the signal handler's hands, on another thread. */
void temporary_keep(char *name) {
  if (name && replace(name, NULL)) free(name);
}

void temporary_remove(char *name) {
  if (name) files_remove_tree(name);
  temporary_keep(name);
}

static void on_signal(int number) {
  for (int k = 0; k < SLOTS; ++k) {
    const char *name = atomic_exchange(&slots[k], NULL);
    if (name) files_remove_tree(name);
  }
  raise(number); /* ends the program when the handler returns, by SA_RESETHAND */
}

void temporary_mind_signals(void) {
  static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND}, now;
  for (int k = 0; k < 3; ++k) sigaddset(&action.sa_mask, signals[k]);
  for (int k = 0; k < 3; ++k)
    if (sigaction(signals[k], NULL, &now) == 0 && now.sa_handler == SIG_DFL)
      sigaction(signals[k], &action, NULL);
}
