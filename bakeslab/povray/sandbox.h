/* sandbox.h - a place for programs that are not trusted, by bubblewrap: the file system is there
 * to be read, but only the working folder to be written; there is no network, no other process
 * to be seen, and nothing of /run, where services listen. What may be read can end up in what is
 * written: this keeps a program from doing harm, not from seeing. */
#ifndef SANDBOX_H
#define SANDBOX_H

#include "base/result.h"

/* Whether sandboxes can be made here; if not, why, in one line. */
enum result sandbox_check(struct error *error);

enum { SANDBOX_WORDS = 40 };

/* The command, for struct process, of a program in a sandbox: it runs in `folder`, an absolute
 * path, with variables as in struct process. It ends with its parent; a signal that ended it is
 * the exit status 128 + signal. */
void sandbox_command(const char *const *program, const char *folder, const char *const *environment,
                     const char *words[SANDBOX_WORDS]);

#endif
