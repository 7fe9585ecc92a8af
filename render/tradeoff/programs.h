/* programs.h - bakeslab, POV-Ray and renderslab itself, run as processes, and what they cost. */
#ifndef PROGRAMS_H
#define PROGRAMS_H

#include <signal.h>

#include "base/result.h"

struct programs {
  char *bakeslab, *renderslab;       /* paths; owned */
  const char *povray;                /* by PATH */
  char folder[64];                   /* for files that nobody keeps; removed with all in it */
  const volatile sig_atomic_t *stop; /* as of struct process; may be NULL */
};

/* Finds bakeslab beside the running program, else by PATH, and makes the folder. Free with
 * programs_end, also after a failure. */
enum result programs_begin(const volatile sig_atomic_t *stop, struct programs *programs,
                           struct error *error);
void programs_end(struct programs *programs); /* zeroed allowed */

/* Runs one. Adds its CPU seconds, and those of what it ran itself, to `cpu`. A failure is told
 * with what the program said last, or with its line that names an error. */
enum result programs_run(const struct programs *programs, const char *const *words, double *cpu,
                         struct error *error);

/* The path of a file in the folder; the caller frees it. NULL without memory. */
char *programs_file(const struct programs *programs, const char *name);

#endif
