/* view_lamps.h - which pixels look into a lamp, and what they see there: light_seen for those
 * rays of a camera that may meet an aperture. */
#ifndef VIEW_LAMPS_H
#define VIEW_LAMPS_H

#include <stdbool.h>

#include "camera.h"
#include "light.h"

struct view_lamps {
  int width, height;
  float (*pixels)[4]; /* radiance and distance, 0: no lamp; row 0 at the top; owned */
  bool any;           /* some pixel sees one */
};

enum slab_result view_lamps_create(int width, int height, struct view_lamps *lamps,
                                   struct slab_error *error);
void view_lamps_free(struct view_lamps *lamps); /* zeroed lamps allowed */

/* What surfaces hide is seen here too: compare the distances. */
void view_lamps_look(struct view_lamps *lamps, const struct light *lights, int count,
                     const struct camera *camera, int threads);

#endif
