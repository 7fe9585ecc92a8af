/* lookup.h - the radiance of any ray of a light slab, from the text of light-slab(5) alone:
 * quadrilinear between samples, which are in the middles of their cells; constant in the half
 * cells at the borders; 0 outside. */
#ifndef LOOKUP_H
#define LOOKUP_H

#include <stdbool.h>

#include "slab/slab.h"

/* The three floats of a sample. */
float *oracle_sample(const struct slab *slab, int i, int j, int k, int l);

/* Along one axis of `count` cells from low to high: the samples on both sides of x and their
 * weights. False outside. */
bool oracle_taps(long double x, long double low, long double high, int count, int index[2],
                 long double weight[2]);

/* Radiance of the ray (a, b, s, t). */
void oracle_lookup(const struct slab *slab, const double abst[4], double rgb[3]);

/* Radiance of view i, j towards the slopes s, t. */
void oracle_lookup_view(const struct slab *slab, int i, int j, long double s, long double t,
                        long double rgb[3]);

#endif
