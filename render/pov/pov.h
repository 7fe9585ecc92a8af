/* pov.h - the scene as a POV-Ray 3.7 scene that shows the same: mesh, materials, camera, and
 * the lights by their include files.
 *
 * What POV-Ray cannot do is told in comments of the scene, and in a note: its highlights have
 * one amount for all colours, and a texture is multiplied by one number. Lamps are seen, as far
 * as their includes declare what a camera sees of them: sheets do. */
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

/* A lamp's script, to light the scene as it is, and what is spent on its light. */
struct pov_lamp {
  const char *script;
  const struct light *light; /* where it is; its gain is left to whoever reads the picture */
  int gather;                /* rays of radiosity that gather at a point; 0: none */
  int photons;               /* 0: none */
  bool mark; /* no light: the mesh glows at 1e4, which shows where the lamp itself hides it */
};

/* Writes a scene in the lamp's space, to which mesh and camera are moved: POV-Ray's lights cannot
 * be scaled. It shows the lamp's light alone, without what surfaces of the mesh reflect onto each
 * other. */
enum result pov_write_lamp(const char *path, const struct shade *view, const struct pov_lamp *lamp,
                           struct error *error);

#endif
