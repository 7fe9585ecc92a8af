/* arguments.h - @FILE on a command line: further arguments, read from FILE.
 *
 * FILE holds words as a shell reads them. Blanks and line ends separate words;
 * '...' keeps everything, "..." everything but a backslash before one of " \ $ ` or
 * a line end, and elsewhere a backslash keeps the character after it (with a line
 * end, both vanish). A # at the start of a word comments the rest of its line.
 * Nothing is substituted. A word that starts with an unquoted @ names another file,
 * relative to the working directory like all paths, at most 8 deep. */
#ifndef ARGUMENTS_H
#define ARGUMENTS_H

#include "base/result.h"

struct argument_words {
  int count;
  char **words; /* count of them and a NULL; all owned */
};

/* A copy of the arguments, with the words of FILE in place of each @FILE but argv[0].
 * `arguments` starts zeroed; free it even after a failure, whose message names FILE and
 * the line there. */
enum result arguments_expand(int argc, char **argv, struct argument_words *arguments,
                             struct error *error);

void arguments_free(struct argument_words *arguments);

#endif
