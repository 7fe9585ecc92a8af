/* viewer_loop.h - shows a scene in a window until the user quits. */
#ifndef VIEWER_LOOP_H
#define VIEWER_LOOP_H

#include "viewer/viewer_command.h"

/* Starts from the camera in a window of width x height. `keys` are pressed first (viewer_state.h),
 * each once the picture is complete; NULL for none. Saved pictures are view-N.exr in the current
 * folder, with the first N that is free; their commands go to standard output. A picture that
 * cannot be saved is told of on standard error, and makes this fail in the end. */
enum result viewer_loop_run(const struct viewer_arguments *arguments, const struct camera *camera,
                            int width, int height, const char *keys, struct error *error);

#endif
