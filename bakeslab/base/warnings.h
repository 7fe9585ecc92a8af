/* warnings.h - what goes on, but not as its user may think: one list, told as it grows. Library
 * code adds to it; the command prints each line at once, and may take the list for a failure. */
#ifndef WARNINGS_H
#define WARNINGS_H

enum { WARNING_LINE = 400, WARNINGS_KEPT = 32 };

struct warnings {
  void (*tell)(const char *line); /* called with each new line; NULL: nobody */
  int count;                      /* all that were added; the first WARNINGS_KEPT are kept */
  char lines[WARNINGS_KEPT][WARNING_LINE];
};

/* Adds a line: what is so, what it means and what to do, without the file's name. One that is
 * there already is not added again. */
void warnings_add(struct warnings *warnings, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* How many lines are kept. */
int warnings_kept(const struct warnings *warnings);

#endif
