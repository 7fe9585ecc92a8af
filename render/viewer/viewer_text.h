/* viewer_text.h - text on a picture, in letters of 5 x 7 dots. */
#ifndef VIEWER_TEXT_H
#define VIEWER_TEXT_H

#include "base/result.h"

struct viewer_text {
  int width, height, dot; /* pixels */
  unsigned char *pixels;  /* row 0 at the top: 0 nothing, 1 the ground of a letter, 255 its dots;
                             owned */
};

/* Dots become larger with the picture. */
enum result viewer_text_create(int width, int height, struct viewer_text *text,
                               struct error *error);
void viewer_text_free(struct viewer_text *text); /* zeroed text allowed */

void viewer_text_clear(struct viewer_text *text);

/* A line of printable ASCII, at most as long as there is room; `row` counts from the top. */
void viewer_text_line(struct viewer_text *text, int row, const char *line);

#endif
