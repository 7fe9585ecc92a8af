/* view_status.h - what the viewer writes on its picture: how far it is, what it leaves out, and
 * what the keys do. */
#ifndef VIEW_STATUS_H
#define VIEW_STATUS_H

#include "view_picture.h"
#include "view_state.h"
#include "view_text.h"

/* `seconds` a frame takes; `white` is the exposure; `news` is one more line, or empty. */
void view_status_write(const struct view_picture *picture, const struct view_state *state,
                       double seconds, double white, const char *news, struct view_text *text);

#endif
