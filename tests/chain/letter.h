/* letter.h - the letter F, which no mirror and no turn leaves as it is: as ink on a
 * square, and in a picture of a wall. */
#ifndef LETTER_H
#define LETTER_H

#include "file/slab_exr.h"

enum { LETTER_STROKES = 7 };

/* One cell of the square, row 0 on top: 1 or 0, and 0 off the square. */
int letter_cell(int column, int row);

/* The letter on the square -1..1, x to the right, y up. */
double letter_ink(double x, double y);

/* Renders the wall z = 1 under these lights, as POV-Ray's plainest camera sees it (x to
 * the right, y up, the square -1..1). Free the picture with picture_free. */
void letter_render(const char *lights, struct picture *picture);

/* Such a picture of a lamp around the origin shows the letter the right way round, and no mirror
 * image of it. */
void letter_expect(const struct picture *picture);

#endif
