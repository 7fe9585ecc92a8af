/* sdl.h - text from elsewhere (names, files, commands) in POV-Ray's scene description
 * language, quoted so that it cannot become code there. */
#ifndef SDL_H
#define SDL_H

#include <stddef.h>
#include <stdio.h>

#include "base/result.h"

/* A string, with the escapes \" and \\. */
void sdl_string(const char *text, FILE *out);

/* Within a comment: control characters, which could end the line, become ?. */
void sdl_comment(const char *text, FILE *out);

/* RESULT_BAD for what is no identifier (letters, digits and _, a letter first) and for what is
 * longer than `longest`. */
enum result sdl_check_identifier(const char *name, size_t longest, struct error *error);

/* POV-Ray's identifiers have at most 40 characters, and the longest suffix that an
 * include adds is _Canned_Inc_Temp. With the zero at the end. */
enum { SDL_IDENTIFIER_SIZE = 40 - 16 + 1 };

/* The name of a lamp's macros, from its slab's: each word capitalised, so that desk_lamp
 * lights a scene by Desk_Lamp_Canned. Refuses what sdl_check_identifier refuses, at most
 * SDL_IDENTIFIER_SIZE - 1 long. */
enum result sdl_capitalise(const char *name, char capitalised[SDL_IDENTIFIER_SIZE],
                           struct error *error);

#endif
