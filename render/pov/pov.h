/* pov.h - the scene as a POV-Ray 3.7 scene that shows the same: mesh, materials, camera, and
 * the lights by their include files.
 *
 * What POV-Ray cannot do is told in comments of the scene, and in a note: its highlights have
 * one amount for all colours, and a texture is multiplied by one number. The lamps themselves
 * are not seen there. */
#ifndef POV_H
#define POV_H

#include "picture/shade.h"
#include "pov/pov_include.h"

/* Writes the scene, whole or not at all. Files that it reads are named as they are from the
 * working folder, where POV-Ray looks for them. `includes` are the lights', and `command` is the
 * one that runs. `note` says what is lost, or is left empty. */
enum result pov_write(const char *path, const struct shade *view,
                      const struct pov_includes *includes, const char *command, char note[256],
                      struct error *error);

#endif
