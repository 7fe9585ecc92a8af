/* process.h - other programs, run as processes that end with this one. Each has a process group
 * of its own, so that Ctrl-C reaches only its parent. */
#ifndef PROCESS_H
#define PROCESS_H

#include <signal.h>
#include <sys/types.h>

#include "base/result.h"

enum {
  PROCESS_MISSING = 127, /* exit status: it cannot be run */
  PROCESS_SIGNAL = 128   /* exit statuses above: killed by signal status - 128 */
};

/* What a standard stream may be, but for a descriptor: */
enum {
  PROCESS_NOTHING = -1, /* /dev/null */
  PROCESS_SAID = -2     /* output that is kept in `said`, as far as there is room */
};

struct process {
  const char *const *words;       /* the program, by PATH unless it has a slash, and its arguments;
                                     NULL-terminated */
  const char *const *environment; /* names, each with its value after it, that are set for it,
                                     or with "" are not there; NULL-terminated; NULL: none */
  const char *folder;             /* where it runs; NULL: here */
  int in, out, errors;            /* its standard streams */
  size_t most_memory;             /* bytes of address space that it may have; 0: no limit */
  size_t most_written;            /* bytes of a file that it may write; 0: no limit */
  const volatile sig_atomic_t *stop; /* set by a signal handler: process_wait ends it; or NULL */

  /* filled in: */
  pid_t pid;
  int exit; /* status */
  char said[4096];
  int said_end; /* of its pipe */
};

/* Starts it. That it cannot be run is told by its end, on its standard error. */
enum result process_start(struct process *process, struct error *error);

/* Waits for its end. Unless its exit status is 0: RESULT_IO with the first line of `said` that has
 * words, or "PROGRAM was killed by signal N (name)" or "PROGRAM failed with exit status N";
 * RESULT_STOPPED where it was stopped. */
enum result process_wait(struct process *process, struct error *error);

/* Both. */
enum result process_run(struct process *process, struct error *error);

/* Ends a process and all of its group: a wrapper's POV-Ray too. To be waited for. */
void process_kill(pid_t pid);

/* Waits for the end of a process, and kills it once `stop` (or NULL) is set: RESULT_STOPPED. */
enum result process_await(pid_t pid, const volatile sig_atomic_t *stop, int *status,
                          struct error *error);

/* The exit status in what waitpid tells. */
int process_exit(int status);

#endif
