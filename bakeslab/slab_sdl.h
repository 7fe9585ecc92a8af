/* slab_sdl.h - text from elsewhere (names, files, commands) in POV-Ray's scene description
 * language, so that it cannot become anything else there. */
#ifndef SLAB_SDL_H
#define SLAB_SDL_H

#include <stdio.h>

/* A string: POV-Ray knows \" and \\. */
void slab_sdl_string(const char *text, FILE *out);

/* Within a comment: a control character must not end the line. */
void slab_sdl_comment(const char *text, FILE *out);

#endif
