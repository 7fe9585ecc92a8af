/* ies_opening.h - the luminous opening that an IES file's width, length and height say: 0 and
 * negative numbers are shapes (ANSI/IES LM-63-1995 and 2002, luminous openings). */
#ifndef IES_OPENING_H
#define IES_OPENING_H

#include "import/photometric/photometry.h"

/* Sets the lamp's shape, axis and sizes. `year` is the standard's: of two shapes the numbers mean
 * another until 1995. */
enum result ies_opening(int year, double metres, double width, double length, double height,
                        struct photometry *lamp, struct warnings *notes, struct error *error);

/* Of type A, whose light goes along the horizontal, towards +x: an opening that the file lays flat
 * faces that way, its length upwards and its width across. */
void ies_opening_raise(struct photometry *lamp, struct warnings *notes);

#endif
