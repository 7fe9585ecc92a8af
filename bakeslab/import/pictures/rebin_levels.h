/* rebin_levels.h - holes in a 4D grid are filled by pull and push (Gortler et al. 1996, section
 * 3.4.2, after Mitchell 1987). A node holds rgb times its weight, and the weight: 0 where nothing
 * is known, 1 where enough is.
 *
 * s and t are halved first, until one node of each is left, then u and v: each picture shows all
 * positions of the aperture from nearly one direction, so that what is missing are directions, and
 * what is known of a position's neighbours in direction tells more than other positions do. */
#ifndef REBIN_LEVELS_H
#define REBIN_LEVELS_H

#include <stddef.h>

#include "slab/slab.h"

enum { REBIN_NODE = 4, REBIN_MOST_LEVELS = 40 }; /* floats in a node */

struct rebin_levels {
  int count;
  int size[REBIN_MOST_LEVELS][SLAB_AXES]; /* [0]: of the grid */
  float *node[REBIN_MOST_LEVELS];         /* [u][v][s][t], REBIN_NODE floats each; owned */
};

/* A zeroed grid and its coarser levels. Free it in any case. */
enum result rebin_levels_make(const int samples[SLAB_AXES], struct rebin_levels *levels,
                              struct error *error);
void rebin_levels_free(struct rebin_levels *levels);

size_t rebin_levels_nodes(const struct rebin_levels *levels, int level);

/* Fills what is not known of level 0: then each node's weight stands for 1, and its first three
 * floats are rgb. Weights themselves are kept, at most 1. Without any weight all is 0. */
void rebin_levels_fill(struct rebin_levels *levels);

#endif
