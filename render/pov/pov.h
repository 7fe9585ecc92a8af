/* pov.h - the scene as a POV-Ray 3.7 scene that shows the same: mesh, materials, camera, and
 * the lights by their include files.
 *
 * What POV-Ray cannot do is told in comments of the scene, and in a note: its highlights have
 * one amount for all colours, and a texture is multiplied by one number. The lamps themselves
 * are not seen there. */
#ifndef POV_H
#define POV_H

#include "light/light.h"
#include "pov/pov_include.h"
#include "scene/camera.h"
#include "scene/scene.h"

struct pov_view {
  const struct scene *scene;
  const struct light *lights;
  int light_count;
  const struct pov_includes *includes;
  struct camera camera;
  int width, height;
  double background[3];
  const char *command; /* that made it */
};

/* Writes the scene, whole or not at all. Files that it reads are named as they are from the
 * working folder, where POV-Ray looks for them. `note` says what is lost, or is left empty. */
enum result pov_write(const char *path, const struct pov_view *view, char note[256],
                      struct error *error);

#endif
