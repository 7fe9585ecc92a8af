/* view_loop.h - looking at a scene in a window until somebody quits. */
#ifndef VIEW_LOOP_H
#define VIEW_LOOP_H

#include "view_command.h"

/* Starts from the camera in a window of width x height. `keys` are pressed first (view_state.h),
 * each once the picture is complete; NULL for none. Saved pictures are view-N.exr in the current
 * folder, with the first N that is free; their commands go to standard output. A picture that
 * cannot be saved is told of on standard error, and makes this fail in the end. */
enum slab_result view_loop_run(const struct view_arguments *arguments, const struct camera *camera,
                               int width, int height, const char *keys, struct slab_error *error);

#endif
