/* housing.h - the visible housing that a lamp script may declare for pictures in which
 * the lamp is seen: `#declare Canned_Housing = union { ... }`. The include file of a
 * canned lamp is to work without the script, so the declaration is lifted out of it as
 * text, with the numbers and vectors that the script declares before it. */
#ifndef HOUSING_H
#define HOUSING_H

#include "lamp.h"

/* SDL that stands for the housing inside a macro, or NULL where the script declares none.
 * The caller frees it. */
char *housing_find(const char *script);

/* Whether the text parses by itself; renders a tiny scene in `directory`, which is made
 * and removed. */
bool housing_parses(const struct povray *povray, const char *housing, const char *directory);

#endif
