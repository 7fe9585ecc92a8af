/* picture_options.h - what the commands that show a mesh share on the command line: the mesh,
 * the camera, the size of the picture and its background. */
#ifndef PICTURE_OPTIONS_H
#define PICTURE_OPTIONS_H

#include <argp.h>
#include <stdbool.h>

#include "scene/camera.h"

struct picture_options {
  const char *mesh;
  bool camera_given, camera_optional; /* the second is set beforehand */
  const char *camera_name; /* of the mesh file, which world_load_scene looks up; NULL: none */
  struct camera camera;
  int size[2];          /* 640 x 480, unless another is set beforehand */
  double background[3]; /* black */
};

/* For the `children` of a command's argp, with a struct picture_options as input. It takes the
 * command's only argument, the mesh; mistakes end in argp_error. */
extern const struct argp picture_options_argp;

/* All children of a command that sums nothing by itself: options_lights_argp, with
 * state->child_inputs[0], this one, with [1], and cli_argp. */
extern const struct argp_child picture_options_children[];

#endif
