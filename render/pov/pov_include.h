/* pov_include.h - the include files of lights, made by `bakeslab include SLAB -o NAME.inc`
 * beside their slabs: what they are called, and the macro that they declare. */
#ifndef POV_INCLUDE_H
#define POV_INCLUDE_H

#include "base/sdl.h"
#include "light/light.h"

struct pov_include {
  char *path;                     /* of the include: the slab's, ending in .inc; owned */
  char *image;                    /* of its image; owned */
  char name[SDL_IDENTIFIER_SIZE]; /* Desk_Lamp for the macro Desk_Lamp_Canned */
  bool face;                      /* it declares Desk_Lamp_Canned_Face, too */
  int light;                      /* the first that uses it */
};

struct pov_includes {
  int count;
  struct pov_include *list; /* owned */
  int *of_light;            /* [lights]: index into the list; owned */
};

/* Finds one include for each slab; lights of the same slab share it. Refuses what is not
 * there, saying the command that makes it, and two includes of the same name. Free with
 * pov_includes_free, also after a failure. */
enum result pov_includes_find(const struct light *lights, int count, struct pov_includes *includes,
                              struct error *error);
void pov_includes_free(struct pov_includes *includes); /* zeroed allowed */

#endif
