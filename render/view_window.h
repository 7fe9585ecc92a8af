/* view_window.h - a window with OpenGL 4.3, by GLFW; its events go into a view_state. One at a
 * time, in the main thread. */
#ifndef VIEW_WINDOW_H
#define VIEW_WINDOW_H

#include "view_state.h"

struct view_window; /* owned by whoever created it */

/* Opens it and makes its context current. The state outlives the window. Fails where there is
 * no display or no such context: the message says what is missing and what does without. */
enum slab_result view_window_create(int width, int height, struct view_state *state,
                                    struct view_window **window, struct slab_error *error);
void view_window_free(struct view_window *window); /* NULL allowed */

/* Of the frame buffer, in pixels; 0 while it is hidden. */
void view_window_size(const struct view_window *window, int size[2]);

/* Takes what has happened; if `wait`, not before something has. */
void view_window_events(struct view_window *window, bool wait);

/* Shows what was drawn. */
void view_window_show(struct view_window *window);

#endif
