/* strips.h - the visible pieces along one axis of a page (the paper's section 4.1).
 *
 * A receiver at height z over the uv plane, its foot at q along the axis, looks at the
 * point a of the aperture along the slope x = (a - q)/z. That ray has the st coordinate
 *     s = kappa q + (kappa z - 1) x,
 * one formula for both st planes. Slopes have no unit. All are found relative to the lowest
 * visible slope, so that no digits cancel: neither far from the aperture, where all slopes are
 * nearly the same, nor near it.
 *
 * The lines of the uv samples and the projected lines of the st samples merge into one
 * ascending list; between two of them, radiance is the product of two linear functions.
 * The visible micro lights are the pairs of a strip along u and a strip along v. */
#ifndef STRIPS_H
#define STRIPS_H

#include "base/result.h"
#include "light/light.h"

/* Samples on both sides: `near` along u or v, `far` along s or t, and one further where
 * `up` is 1; 0 in the half cells at the borders. */
struct strip_taps {
  int near, far;
  int near_up, far_up;
};

struct strip {
  double low, high; /* slopes; far away they may round to the same */
  double width;     /* high - low > 0, exact to rounding */
  struct strip_taps taps;
  double near_weight[2], far_weight[2]; /* of the upper sample, at low and at high */
};

struct strips {
  struct strip *strip; /* owned */
  int count, room;
};

void strips_free(struct strips *strips);

/* The strips that a receiver at q, z >= 0 sees; none where the aperture or the window ends
 * before the other begins. z = 0 is the limit z -> 0+: all of the window inside the
 * aperture, one half on its border, nothing outside. At most near_count + far_count + 1. */
enum result strips_find(const struct light_axis *axis, double q, double z, struct strips *strips,
                        struct error *error);

/* One strip for each uv sample that is visible, as wide as its cell and with its slope in the
 * middle: for a sum over views. Strips may reach over the window's edge. None for views less than
 * 1e-150 of their spacing away: as point lights they would be infinitely bright. */
enum result strips_find_views(const struct light_axis *axis, double q, double z,
                              struct strips *strips, struct error *error);

/* The part of a strip between two slopes. */
struct strip strip_part(const struct strip *strip, double low, double high);

/* Appends the parts of `from` that lie between two slopes. */
enum result strips_clip(const struct strips *from, double low, double high, struct strips *strips,
                        struct error *error);

enum result strips_append(struct strips *strips, const struct strip *strip, struct error *error);

#endif
