/* seen_page.h - a page as one receiver sees it: in the page's frame, in slopes (strips.h). */
#ifndef SEEN_PAGE_H
#define SEEN_PAGE_H

#include <stdbool.h>

#include "light/light.h"
#include "microlight/kernel.h"
#include "microlight/receiver.h"
#include "microlight/strips.h"

struct seen_page {
  const struct light_page *page;
  double foot[2], height; /* of the receiver in the page's frame, in scene units */
  struct kernel kernel;
};

/* False where the receiver is behind the uv plane. */
bool seen_page_find(const struct light_page *page, const struct receiver *receiver,
                    struct seen_page *seen);

/* The slopes of the middle of the aperture, and those between which it is, along u and along v;
 * height > 0. */
void seen_page_middle(const struct seen_page *seen, double middle[2]);
void seen_page_aperture(const struct seen_page *seen, double low[2], double high[2]);

/* The strips along u and along v, or for each view of the page (strips_find_views). */
enum result seen_page_strips(const struct seen_page *seen, bool each_view, struct strips strips[2],
                             struct error *error);

/* The range of g (kernel.h) over all strips, none of the two lists empty. */
void seen_page_heights(const struct seen_page *seen, const struct strips strips[2],
                       double range[2]);

/* The first float of a row or column of the page's raster, for one sample along u or v and
 * one along s or t. axis: 0 for columns, 1 for rows. */
size_t seen_page_offset(const struct seen_page *seen, int axis, int near, int far);

/* The four rows of a strip along v, as taps.h takes them. */
void seen_page_rows(const struct seen_page *seen, const struct strip_taps *taps,
                    const float *rows[4]);

/* The pixels of a strip along u, as taps.h takes them. */
void seen_page_columns(const struct seen_page *seen, const struct strip_taps *taps, int offset[2]);

#endif
