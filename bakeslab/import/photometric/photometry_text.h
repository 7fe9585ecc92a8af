/* photometry_text.h - what readers of photometric files share: lines and numbers of a text in any
 * 8-bit coding, whose lines end in LF, CR LF or CR. */
#ifndef PHOTOMETRY_TEXT_H
#define PHOTOMETRY_TEXT_H

#include "import/photometric/photometry.h"

struct photometry_text {
  const char *at, *end; /* what is not read yet */
  int line;             /* of `at`, from 1 */
  bool decimal_comma;   /* numbers are separated by blanks, and a comma is their point; otherwise
                           it separates them too */
};

struct photometry_text photometry_text_of(const char *text, size_t size);

/* A line without its end; false after the last. */
bool photometry_text_line(struct photometry_text *text, const char **line, size_t *length);

/* Whether commas may be its numbers' decimal points: some lie between digits, no word has two, and
 * no number has a point. */
bool photometry_text_may_be_decimal(const struct photometry_text *text);

/* The next number. `what` names it where it is missing, too large or no number: "line N: ...". */
enum result photometry_text_number(struct photometry_text *text, const char *what, double *number,
                                   struct error *error);

/* A whole number from low to high. */
enum result photometry_text_whole(struct photometry_text *text, const char *what, int low, int high,
                                  int *number, struct error *error);

/* `count` numbers; refuses a count that cannot be in what is left, before anything is read. */
enum result photometry_text_numbers(struct photometry_text *text, const char *what, size_t count,
                                    double *numbers, struct error *error);

/* Refuses numbers that do not ascend, or leave [low, high]. */
enum result photometry_text_ascending(const struct photometry_text *text, const char *what,
                                      const double *numbers, int count, double low, double high,
                                      struct error *error);

/* How many more words there are, and the line of the first. */
size_t photometry_text_left(const struct photometry_text *text, int *line);

/* Adds the bytes to the lamp's label, as UTF-8, after a blank: Latin-1 where they are not UTF-8;
 * control characters become blanks. */
void photometry_text_label(struct photometry *lamp, const char *bytes, size_t length);

#endif
