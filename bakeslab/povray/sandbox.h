/* sandbox.h - a place for programs that are not trusted, by bubblewrap: the file system is there
 * to be read, but only the working folder to be written; there is no network, no other process
 * to be seen, and nothing of /run, where services listen. What may be read can end up in what is
 * written: this keeps a program from doing harm, not from seeing. */
#ifndef SANDBOX_H
#define SANDBOX_H

#include "base/result.h"

/* Whether sandboxes can be made here; if not, why, in one line. */
enum result sandbox_check(struct error *error);

/* Replaces this process by a program in a sandbox whose working folder is this one's, with
 * LD_PRELOAD set to `preload` unless that is NULL. It ends with its parent; a signal that ended
 * it is the exit status 128 + signal. Returns only where that fails. */
void sandbox_exec(const char *program, const char *argument, const char *preload);

#endif
