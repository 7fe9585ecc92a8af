/* view.h - a page as one receiver sees it: in the page's frame, in slopes (strips.h). */
#ifndef VIEW_H
#define VIEW_H

#include <stdbool.h>

#include "gather.h"
#include "kernel.h"
#include "strips.h"

struct view {
  const struct light_page *page;
  double foot[2], height; /* of the receiver, in scene units */
  struct kernel kernel;
};

/* False where the page is turned away: the receiver is behind the uv plane. */
bool view_find(const struct light_page *page, const struct receiver *receiver, struct view *view);

/* The strips along u and along v, or for each view of the page (strips_find_views). */
enum slab_result view_strips(const struct view *view, bool each_view, struct strips strips[2],
                             struct slab_error *error);

/* The first float of a row or column of the page's raster, for one sample along u or v and
 * one along s or t. axis: 0 for columns, 1 for rows. */
size_t view_offset(const struct view *view, int axis, int near, int far);

/* The four rows of a strip along v, as taps.h takes them. */
void view_rows(const struct view *view, const struct strip_taps *taps, const float *rows[4]);

/* The pixels of a strip along u, as taps.h takes them. */
void view_columns(const struct view *view, const struct strip_taps *taps, int offset[2]);

#endif
