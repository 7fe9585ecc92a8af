/* view_text.h - words on a picture, in letters of 5 x 7 dots. */
#ifndef VIEW_TEXT_H
#define VIEW_TEXT_H

#include "slab_error.h"

struct view_text {
  int width, height, dot; /* pixels */
  unsigned char *pixels;  /* row 0 at the top: 0 nothing, 1 the ground of a letter, 255 its dots;
                             owned */
};

/* Dots become larger with the picture. */
enum slab_result view_text_create(int width, int height, struct view_text *text,
                                  struct slab_error *error);
void view_text_free(struct view_text *text); /* zeroed text allowed */

void view_text_clear(struct view_text *text);

/* A line of printable ASCII, at most as long as there is room; `row` counts from the top. */
void view_text_line(struct view_text *text, int row, const char *line);

#endif
