/* process.h - other programs, run as processes that end with this one.
 *
 * A program gets a process group of its own, so that Ctrl-C reaches only its parent. */
#ifndef PROCESS_H
#define PROCESS_H

#include <sys/types.h>

#include "base/result.h"

enum {
  PROCESS_NOTHING = -1, /* /dev/null */
  PROCESS_SAID = -2     /* kept in `said`, for messages: what exceeds it may get lost */
};

struct process {
  const char *const *words;       /* the program, by PATH unless it has a slash, and its arguments;
                                     NULL-terminated */
  const char *const *environment; /* names, each with its value after it, that are set for it;
                                     NULL-terminated; NULL: none */
  const char *folder;             /* where it runs; NULL: here */
  int in, out, errors;            /* its standard streams: descriptors or one of the above */

  /* What process_start and process_wait fill in: */
  pid_t pid;
  int said_end; /* of a pipe */
  char said[4096];
};

/* Starts it. RESULT_IO where it cannot be run: "PROGRAM: cannot be run (why)". */
enum result process_start(struct process *process, struct error *error);

/* Waits for what was started, and judges it by process_judge. */
enum result process_wait(struct process *process, struct error *error);

/* RESULT_OK for the exit status 0, in `status` as waitpid tells it. Else RESULT_IO with the first
 * line of `said` that has words or, where there is none or a signal ended it, "NAME was killed by
 * signal N (its name)" or "NAME failed with exit status N". */
enum result process_judge(const char *name, int status, const char *said, struct error *error);

/* The signal that ended a process, also one that its shell or sandbox told by the exit status
 * 128 + signal; 0: none did. */
int process_signal(int status);

#endif
