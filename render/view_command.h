/* view_command.h - the command that makes the viewer's picture again, by `renderslab image`. */
#ifndef VIEW_COMMAND_H
#define VIEW_COMMAND_H

#include "view_state.h"

/* What does not change while one looks. */
struct view_arguments {
  const char *mesh;
  bool repair;
  const char **lights; /* as --light took them */
  const struct view_world *world;
};

/* For a shell, without an end of line; `output` is the picture's name. To be freed; NULL without
 * memory. Numbers of what was moved have nine digits. */
char *view_command(const struct view_arguments *arguments, const struct view_state *state,
                   int width, int height, const char *output);

#endif
