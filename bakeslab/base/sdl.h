/* sdl.h - text from elsewhere (names, files, commands) in POV-Ray's scene description
 * language, so that it cannot become anything else there. */
#ifndef SDL_H
#define SDL_H

#include <stdio.h>

/* A string: POV-Ray knows \" and \\. */
void sdl_string(const char *text, FILE *out);

/* Within a comment: a control character must not end the line. */
void sdl_comment(const char *text, FILE *out);

#endif
