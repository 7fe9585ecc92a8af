/* viewer_status.h - the text on the viewer's picture: progress, error, what is skipped, and what
 * the keys do. */
#ifndef VIEWER_STATUS_H
#define VIEWER_STATUS_H

#include "viewer/viewer_picture.h"
#include "viewer/viewer_state.h"
#include "viewer/viewer_text.h"

/* `seconds` a frame takes; `white` is the exposure; `news` is one more line, or empty. */
void viewer_status_write(const struct viewer_picture *picture, const struct viewer_state *state,
                         double seconds, double white, const char *news, struct viewer_text *text);

#endif
