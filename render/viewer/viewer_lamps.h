/* viewer_lamps.h - which pixels look into a lamp, and what they see there: light_seen for those
 * rays of a camera that may meet an aperture. */
#ifndef VIEWER_LAMPS_H
#define VIEWER_LAMPS_H

#include <stdbool.h>

#include "light/light.h"
#include "scene/camera.h"

struct viewer_lamps {
  int width, height;
  float (*pixels)[4]; /* radiance and distance, 0: no lamp; row 0 at the top; owned */
  bool any;           /* some pixel sees one */
};

enum result viewer_lamps_create(int width, int height, struct viewer_lamps *lamps,
                                struct error *error);
void viewer_lamps_free(struct viewer_lamps *lamps); /* zeroed lamps allowed */

/* What surfaces hide is seen here too: compare the distances. */
void viewer_lamps_look(struct viewer_lamps *lamps, const struct light *lights, int count,
                       const struct camera *camera, int threads);

#endif
