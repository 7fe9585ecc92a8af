/* supervise.h - runs a program and fails the n-th of its system calls that change files: what
 * a full disk does. Linux's seccomp asks this process about each such call, so that nothing of
 * the program need be known or changed; its children are asked about too.
 *
 * Counted: write, pwrite64, writev, fsync, ftruncate, rename, link, symlink, mkdir, and open
 * where it creates. Not writes to stderr, since messages are to be seen. */
#ifndef SUPERVISE_H
#define SUPERVISE_H

#include <stdbool.h>

struct supervised {
  char *const *argv;
  const char *in, *out, *err; /* files; NULL: stdin is /dev/null */
  bool closed_pipe;           /* stdout is a pipe that nobody reads */
  long fail_from, fail_to;    /* the calls, from 1, that are to fail; 0: none */
  bool renames_too;           /* else those succeed, as they do on a full disk */
  bool of_children;           /* counts and fails those of the children, not its own */
  int seconds;                /* after so many it is killed */
};

struct outcome {
  int status;    /* as of waitpid */
  long calls;    /* counted */
  bool timeout;  /* killed */
  bool no_means; /* this kernel or container has no seccomp to ask with */
};

/* Blocks until the program and its children have ended. The folder it runs in is this one's. */
struct outcome supervise(const struct supervised *program);

#endif
