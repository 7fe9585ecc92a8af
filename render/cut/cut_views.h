/* cut_views.h - all views of a page, what the cut (cut.h) ends with where few nodes are not exact
 * enough. A view is a hat function of uv; its light is a weighted sum over the few st samples that
 * it is seen over, the weights a product of one for s and one for t, integrated exactly. The kernel
 * is taken in the view's middle, with its slope; or, near the aperture, as the polynomial through
 * up to 4 nodes a side. That is more exact than the micro lights of the method pi, and there are
 * fewer views than micro lights. All lengths are in the tree's units (cut_tree_seen). */
#ifndef CUT_VIEWS_H
#define CUT_VIEWS_H

#include <stdbool.h>

#include "cut/cut_tree.h"
#include "microlight/seen_page.h"

enum { CUT_VIEWS_NODES = 4, CUT_VIEWS_MOST = 64 }; /* nodes, views along an axis */

/* How many nodes a side a view needs for the tolerance, and the relative error that is predicted
 * then; 0 where it cannot be met (cut_views_error.c). */
int cut_views_nodes(const struct seen_page *seen, double tolerance, double *error);

/* What it takes, in nanoseconds; only relative to other such prices. */
double cut_views_price(const struct seen_page *seen, int nodes);

/* Scratch memory of one thread. */
struct cut_views;
struct cut_views *cut_views_make(void);       /* NULL: no memory */
void cut_views_free(struct cut_views *views); /* NULL allowed */

/* The light of a page that is all above the receiver's tangent plane; matte receivers only.
 * False: more st samples than there is room for. */
bool cut_views_light(const struct cut_tree *tree, const struct seen_page *seen, int nodes,
                     struct cut_views *views, double rgb[3]);

#endif
