/* name.h - what a slab's name makes of the lamp's names in POV-Ray: the slab
 * "desk_lamp" lights a scene by the macro Desk_Lamp_Canned. */
#ifndef NAME_H
#define NAME_H

#include "base/result.h"

#ifdef __cplusplus
extern "C" {
#endif

/* POV-Ray's identifiers have at most 40 characters, and the longest suffix that an
 * include adds is _Canned_Inc_Temp. With the zero at the end. */
enum { SDL_IDENTIFIER_SIZE = 40 - 16 + 1 };

/* Each word capitalised: desk_lamp becomes Desk_Lamp. RESULT_BAD for what is no identifier
 * (letters, digits and _, a letter first) and for what is longer than SDL_IDENTIFIER_SIZE - 1. */
enum result sdl_capitalise(const char *name, char capitalised[SDL_IDENTIFIER_SIZE],
                           struct error *error);

#ifdef __cplusplus
}
#endif
#endif
