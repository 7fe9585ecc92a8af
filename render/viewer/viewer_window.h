/* viewer_window.h - a window with OpenGL 4.3, by GLFW; its events go into a viewer_state. One at a
 * time, in the main thread. */
#ifndef VIEWER_WINDOW_H
#define VIEWER_WINDOW_H

#include "viewer/viewer_state.h"

struct viewer_window; /* owned by whoever created it */

/* Opens it and makes its context current. The state outlives the window. Fails where there is
 * no display or no such context: the message says what is missing and what does without. */
enum result viewer_window_create(int width, int height, struct viewer_state *state,
                                 struct viewer_window **window, struct error *error);
void viewer_window_free(struct viewer_window *window); /* NULL allowed */

/* Of the frame buffer, in pixels; 0 while it is hidden. */
void viewer_window_size(const struct viewer_window *window, int size[2]);

/* Takes what has happened; if `wait`, not before something has. */
void viewer_window_events(struct viewer_window *window, bool wait);

/* Shows what was drawn. */
void viewer_window_show(struct viewer_window *window);

#endif
