/* cut_four.h - how receivers see intervals and nodes of a tree, four at a time: four of one
 * receiver, or one of four receivers. All lengths are in the tree's units (cut_tree_seen). */
#ifndef CUT_FOUR_H
#define CUT_FOUR_H

#include <math.h>
#include <string.h>

#include "base/simd.h"
#include "cut/cut_axis.h"

/* Where the centers of four intervals are seen. */
struct cut_spots {
  simd_doubles4 slope, place;  /* place: number of the st sample */
  simd_doubles4 size, half;    /* of the interval, in slopes: the integral of H; cut_axis.h */
  simd_doubles4 per_curvature; /* error per curvature of radiance at `line`; 0: not in it */
  simd_longs4 seen, whole;     /* is any of it, is all of it within the st window */
  simd_ints4 cell;             /* number of the st sample before it */
  simd_ints4 line; /* of the nearest st sample: in a node that is seen narrow (cut_tree.h)
                      there is at most one */
};

/* From where they are seen along their axis. */
struct cut_view {
  simd_double4 foot, per_height; /* of the receivers; 1/height */
  simd_double4 speed, per_speed; /* st samples per length of the aperture, and 1 over that */
};

SIMD_INLINE void cut_four_see(const struct light_axis *axis, double per_step,
                              const struct cut_four *four, const struct cut_view *view,
                              struct cut_spots *spots) {
  const double last = axis->far_count - 1, most = last + 0.5;
  const simd_double4 center = four->center, slope = (center - view->foot) * view->per_height;
  const simd_double4 place = (axis->kappa * center - slope - axis->far_low) * per_step - 0.5;
  const simd_double4 reach = view->speed * four->half, low = place - reach, high = place + reach;
  const simd_double4 above = SIMD_CHOOSE(place > 0, place, SIMD_ALL(0));
  const simd_double4 within = SIMD_CHOOSE(above < last, above, SIMD_ALL(last));
  const simd_int4 cell = __builtin_convertvector(within, simd_int4);
  const simd_double4 before = __builtin_convertvector(cell, simd_double4);
  const simd_long4 nearer = (place - before > 0.5) & (before < last);
  const simd_double4 line = before + SIMD_CHOOSE(nearer, SIMD_ALL(1), SIMD_ALL(0));
  const simd_double4 off = SIMD_ABSOLUTE(place - line);
  spots->slope = slope;
  spots->place = place;
  spots->size = four->size * view->per_height;
  spots->half = view->per_height * four->half;
  spots->per_curvature =
      SIMD_CHOOSE(off < reach, reach - off * off * (view->per_speed * four->per_half), SIMD_ALL(0));
  spots->seen = (high > -0.5) & (low < most);
  spots->whole = (low >= -0.5) & (high <= most);
  spots->cell = cell;
  spots->line = __builtin_convertvector(line, simd_int4);
}

/* Factors of the errors that the kernel's expansion to second order makes, measured to be enough
 * on smooth, rough and cut lamps. Relative to a node's light:
 * - its third and fourth order, in powers of the node's reach over its distance: odd orders nearly
 *   cancel over a node, unless the window's edge cuts it;
 * - its mixed second order, in units of the product of the reaches: it cancels for radiance that
 *   is the same all over the node. */
static const double cut_whole_third = 0.5, cut_clipped_third = 8, cut_fourth = 0.3;
static const double cut_whole_mixed = 0.16, cut_clipped_mixed = 0.6;

/* Relative to the difference of the views from the node: of any part of it, where it is seen wide;
 * of the second moments, where it is seen narrow, by the kernel's second order and by its slope
 * times the width. */
static const double cut_part_order = 1, cut_second_order = 2, cut_first_order = 2;

/* The centers of four nodes, and from where they are seen. */
struct cut_nodes {
  simd_double4 slope[2], size[2]; /* cut_spots */
  simd_long4 whole;
  simd_double4 normal[3], tilt, slant; /* the receiver's; of its part in the uv plane: its length,
                                          and the product along the axes */
  simd_double4 reach[2], across;       /* cut_seen_level */
};

/* What they are worth there. */
struct cut_worth {
  simd_double4 kernel, per_g, per_square; /* cut_node */
  simd_double4 value;                     /* the kernel times the node's size */
  simd_double4 flat;                      /* square of the node's reach over its distance */
  simd_double4 tilt;      /* how much faster than for one who faces it the kernel changes */
  simd_double4 per_light; /* what the kernel's expansion leaves out, relative to the light */
  simd_double4 second;    /* tilt times this: relative to the second moments */
};

SIMD_INLINE void cut_four_weigh(const struct cut_nodes *in, struct cut_worth *out) {
  const simd_double4 x = in->slope[0], y = in->slope[1], square = 1 + x * x + y * y;
  const simd_double4 g = in->normal[0] * x + in->normal[1] * y - in->normal[2];
  const simd_double4 per = 1 / (g * square), per_square = per * g, per_g = per * square;
  const simd_double4 kernel = g * per_square * per_square, root = SIMD_ROOT(square);
  const simd_double4 reach = SIMD_CHOOSE(in->reach[0] > in->reach[1], in->reach[0], in->reach[1]);
  const simd_double4 flat = reach * reach * per_square, narrow = reach * root * per_square;
  const simd_double4 tilt = 1 + in->tilt * root * per_g;
  const simd_double4 mixed = 8 * x * y * per_square * per_square - in->slant * per_g * per_g;
  const simd_double4 third =
      SIMD_CHOOSE(in->whole, SIMD_ALL(cut_whole_third), SIMD_ALL(cut_clipped_third));
  const simd_double4 cross =
      SIMD_CHOOSE(in->whole, SIMD_ALL(cut_whole_mixed), SIMD_ALL(cut_clipped_mixed));
  out->kernel = kernel;
  out->per_g = per_g;
  out->per_square = per_square;
  out->value = kernel * in->size[0] * in->size[1];
  out->flat = flat;
  out->per_light = flat * (third * narrow * tilt + cut_fourth * flat) +
                   cross * SIMD_ABSOLUTE(mixed) * in->reach[0] * in->reach[1];
  out->tilt = tilt;
  out->second = cut_second_order * flat + cut_first_order * narrow * in->across;
}

#endif
