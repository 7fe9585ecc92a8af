/* radiance_source.h - how Radiance adds up the light of an aperture, and what that errs.
 *
 * A light polygon is a source. With -dj 0 its light is that of the middles of its parts: it is
 * halved across its longer edge until that is below -ds times the distance, into 64 parts at
 * most (Radiance, rt/srcsamp.c: flt_partit, MAXSPART). More polygons, more parts.
 *
 * A part whose slopes are only in part within the window gives that share of its light, at the
 * middle of the share: without that, the edge of the window would err most. */
#ifndef RADIANCE_SOURCE_H
#define RADIANCE_SOURCE_H

#include "slab/slab.h"

/* The -ds that users are told to give. */
extern const double radiance_source_ds;

/* How an aperture is cut: polygons along u and v, and how often Radiance may halve each. */
struct radiance_source {
  int polygons[2], halvings[2];
};

struct radiance_source radiance_source_make(const struct slab *slab, const int polygons[2]);

/* Relative RMS error of irradiance on a plane so many aperture widths (longer edges) away. */
double radiance_source_error(const struct slab *slab, const struct radiance_source *source,
                             double widths);

/* The fewest polygons, 16 along the longer edge at most, whose error is the tolerance or less at
 * one aperture width. */
struct radiance_source radiance_source_choose(const struct slab *slab, double tolerance);

#endif
