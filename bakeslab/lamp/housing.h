/* housing.h - the visible housing that a lamp script may declare for pictures in which
 * the lamp is seen: `#declare Canned_Housing = union { ... }`. The include file of a
 * canned lamp is to work without the script, so the declaration is lifted out of it as
 * text, with the numbers and vectors that it needs. */
#ifndef HOUSING_H
#define HOUSING_H

#include "lamp/lamp.h"

/* SDL that stands for the housing inside a macro, or NULL where the script declares none.
 * The text is empty, which does not parse, where the script alone does not decide what the
 * housing is: it, or a name that it needs, is declared twice or inside #if, #while, #macro
 * and the like. The caller frees it. */
char *housing_find(const char *script); /* NULL and errno ENOMEM: no memory */

/* Whether SDL that came with a slab file can do no more inside a macro than draw: braces
 * and blocks are closed, and there is no directive but #local, #if, #for, #while and their
 * kind; none that opens files, declares macros or ends the macro it stands in. */
bool housing_is_harmless(const char *text);

/* RESULT_BAD: the text does not parse by itself. Renders a tiny scene in `directory`, which is made
 * and removed; `stop` as for povray_run. */
enum result housing_parses(const struct povray *povray, const struct lamp_source *source,
                           const char *housing, const char *directory,
                           const volatile sig_atomic_t *stop, struct error *error);

#endif
