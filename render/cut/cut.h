/* cut.h - method `cut`: the light of a page as a sum over blocks of views, few where that is
 * exact enough. The algorithm is told in cut.c.
 *
 * For a receiver at height z the ray through the point a of the aperture has the st coordinate
 * s = s0 - w (a - a0), w = 1/z - kappa, s0 that of the ray through a0. A node of the tree
 * (cut_tree.h) has radiance linear in a and in b. Its product with the hat functions of uv and st
 * (cut_axis.h) and the kernel, expanded to second order about the node's center, is integrated
 * exactly: single views, the leaves, err by the kernel's higher orders alone.
 *
 * The error of a page's light: the largest of the channels' absolute errors, relative to the
 * largest channel, or to 1e-4 of the most that the page can send to the receiver's height, if that
 * is more. That most is (largest radiance summed over the aperture)/z^2, or pi times its mean over
 * the aperture, if that is less. Tolerances below 1e-6 are beyond single precision: the micro
 * lights do it. Slabs that are nowhere negative give no negative light. */
#ifndef CUT_H
#define CUT_H

#include <stdbool.h>
#include <stdint.h>

#include "microlight/seen_page.h"

struct cut_tree; /* keeps a pointer to the page's samples */

/* Builds the tree of a page: the same bits whatever the threads. It takes 64 bytes of memory per
 * st sample and node; with a third as many nodes as views, about 1.78 times the slab's. Nearly all
 * of the time goes into measuring errors: 0.6 s of CPU for 16 x 16 x 64 x 64 samples, 2.5 s for 32
 * x 32 x 64 x 64, what 100,000 receivers' micro lights take. Loading such slabs takes 0.06 s and
 * 0.2 s, so a file beside the slab would pay for small pictures; there is none yet. */
enum result cut_build(const struct light_page *page, int threads, struct cut_tree **made,
                      struct error *error);
void cut_free(struct cut_tree *tree); /* NULL allowed */

struct cut_counts {
  uint64_t nodes; /* summed */
  uint64_t views; /* summed all at once (cut_views.h): the kernel's nodes */
  double error;   /* predicted, relative, of the last sum */
  bool no_memory; /* for a sum, which was not done: that of the micro lights has other digits */
};

/* The light of up to four receivers who see all of the tree's page, and its predicted error: the
 * bits that cut_sum finds. Only those are `done` for whom the tree's root is exact enough, as far
 * away; of the others nothing is known. All of `seen` must be set, more than once if there are
 * fewer. */
enum { CUT_ROOTS = 4 };
struct cut_root {
  double irradiance[3], error;
  bool done;
};
void cut_roots(const struct cut_tree *tree, const struct seen_page seen[CUT_ROOTS], int count,
               double tolerance, struct cut_root roots[CUT_ROOTS]);

/* Scratch memory of one thread. */
struct cut_work;
struct cut_work *cut_work_make(void);      /* NULL: no memory */
void cut_work_free(struct cut_work *work); /* NULL allowed */

/* The light of the tree's page, for a receiver who sees all of it. False: not done, the micro
 * lights do it better. */
bool cut_sum(const struct cut_tree *tree, const struct seen_page *seen, double tolerance,
             struct cut_work *work, double irradiance[3], struct cut_counts *counts);

#endif
