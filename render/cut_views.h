/* cut_views.h - all views of a page, each with the kernel in its middle: what the cut (cut.h) ends
 * with where few nodes are not exact enough. A view is a hat function of uv; its light is a
 * weighted sum over the few st samples that it is seen over, the weights a product of one for s
 * and one for t, integrated exactly and with the kernel's slope in them. That is as exact as the
 * micro lights of the method pi, and there are fewer views than micro lights. */
#ifndef CUT_VIEWS_H
#define CUT_VIEWS_H

#include <stdbool.h>

#include "cut_tree.h"
#include "view.h"

/* Predicted relative error; INFINITY where this cannot be done. */
double cut_views_error(const struct view *view);

/* What it takes, in nanoseconds; only relative to other such prices. */
double cut_views_price(const struct view *view);

/* Scratch memory of one thread. */
struct cut_views;
struct cut_views *cut_views_make(void);       /* NULL: no memory */
void cut_views_free(struct cut_views *views); /* NULL allowed */

/* The light of a page that is all above the receiver's tangent plane; matte receivers only. False:
 * more st samples than there is room for. */
bool cut_views_sum(const struct cut_tree *tree, const struct view *view, struct cut_views *views,
                   double rgb[3]);

#endif
