/* viewer_command.h - the command that makes the viewer's picture again, by `renderslab image`. */
#ifndef VIEWER_COMMAND_H
#define VIEWER_COMMAND_H

#include "viewer/viewer_state.h"

/* What does not change while the window is open. */
struct viewer_arguments {
  const char *mesh;
  bool repair;
  const char **lights; /* as --light took them */
  const struct viewer_world *world;
};

/* For a shell, without an end of line; `output` is the picture's name. To be freed; NULL without
 * memory. Numbers of what was moved have nine digits. */
char *viewer_command(const struct viewer_arguments *arguments, const struct viewer_state *state,
                     int width, int height, const char *output);

#endif
