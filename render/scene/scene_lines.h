/* scene_lines.h - the lines of a text, as OBJ and MTL files have them.
 *
 * A line ends with LF, CR or both; a backslash before that joins the next one. A byte order mark
 * of UTF-8 is skipped. Refused: what is no file, a zero byte (no text) and lines of more than
 * 64 MiB, so that memory stays bounded. */
#ifndef SCENE_LINES_H
#define SCENE_LINES_H

#include <stddef.h>

#include "base/result.h"

struct scene_line {
  const char *path;
  size_t number;       /* in the file, from 1; of the first one of those that were joined */
  const char *keyword; /* "" on empty lines */
  char *rest;          /* trimmed; the reader may change it */
};

typedef enum result scene_line_reader(void *context, const struct scene_line *line,
                                      struct error *error);

/* Gives each line to the reader, until that fails. */
enum result scene_lines_read(const char *path, scene_line_reader *reader, void *context,
                             struct error *error);

/* Blanks within a line. */
extern const char scene_blanks[];

/* As strtod, in a third of its time for short decimal numbers. */
double scene_number(const char *text, char **end);

/* Reads up to `most` numbers, until a comment or the end; returns how many there are, or -1 where
 * one is not finite in single precision or something is no number. */
int scene_numbers(const char *text, int most, double *numbers);

#endif
