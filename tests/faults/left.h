/* left.h - what a command has left in its folder and on stdout, to be compared: the files, and the
 * folders with all that is in them. The store of a bake, NAME.partial, is left out. */
#ifndef LEFT_H
#define LEFT_H

#include <stdbool.h>
#include <stdint.h>

enum { LEFT_MOST = 16, LEFT_NAME_SIZE = 32 };

struct left {
  uint64_t output; /* on stdout */
  int count;
  struct {
    char name[LEFT_NAME_SIZE];
    uint64_t hash;
  } files[LEFT_MOST];
};

/* In the working folder; `output` is the file that holds stdout. `timed`: what numbers are made of
 * does not count. Ends the program with a line on stdout where there are too many. */
struct left left_look(const char *output, bool timed);

bool left_is_same(const struct left *a, const struct left *b);

/* Each file is old or new, never in between; those that belong together all the same. */
bool left_is_old_or_new(const struct left *now, const struct left *before, const struct left *whole,
                        bool together);

#endif
