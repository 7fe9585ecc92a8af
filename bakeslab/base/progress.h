/* progress.h - a bar with the time left, on stderr while that is a terminal; of several at once, by
 * threads, one at a time. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>

struct progress {
  bool shown, draws;   /* may be shown; is the one that is */
  double start, drawn; /* seconds */
  double start_part;   /* of the work, done before this run */
};

/* Seconds on a clock that never jumps. */
double progress_now(void);

/* When this process began, to 5 ms; now, where the system does not tell. */
double progress_process_start(void);

/* `quiet`, or a stderr that is no terminal, keeps it silent. */
void progress_start(struct progress *progress, bool quiet, double part);
/* part: 0..1 of the work, label: what is being done. Draws at most 5 times a second. */
void progress_show(struct progress *progress, double part, const char *label);
/* Clears the line. */
void progress_end(struct progress *progress);

#endif
