/* plane.h - the irradiance of a slab on a plane parallel to the aperture, integrated densely, at
 * receivers that cover the part of the plane that light can reach through the window.
 * Approximations of the slab are fitted to it and compared with it. */
#ifndef PLANE_H
#define PLANE_H

#include "slab/slab.h"

/* receivers x receivers equal cells, each with a receiver in it that faces the
 * aperture. Lengths in lamp units, x along u and y along v. */
struct plane {
  double distance; /* from the aperture */
  double low[2], size[2];
  int receivers;
  int points[2]; /* of the dense sum, along u and v */
};

/* The plane at a distance, its lit part widened by `margin` (1: just what is
 * lit) about its centre. The number of receivers follows from a bound on the
 * work, a fraction of a second, and is at most `most` (0: the default). */
struct plane plane_make(const struct slab *slab, double distance, double margin, int most);

/* The same number of receivers at equal angles as seen from the aperture's middle, closer
 * together where light is bright; (column, row) count cells, the first's middle is (0.5, 0.5).
 * Returns the area of the plane that a cell stands for there. */
double plane_fan(const struct plane *plane, double column, double row, double at[2]);

/* Largest angle between neighbours of a fan, in radians. */
double plane_fan_step(const struct plane *plane);

/* Irradiance at (x, y, distance) of points[0] x points[1] point lights on the
 * middles of as many cells of the aperture. */
void plane_irradiance(const struct slab *slab, const int points[2], const double at[2],
                      double distance, double rgb[3]);

/* The same of those that lie below `until` along u and v; a cell that it cuts counts in part. */
void plane_irradiance_until(const struct slab *slab, const int points[2], const double until[2],
                            const double at[2], double distance, double rgb[3]);

/* The irradiance that approximation `k` of `of` gives to a receiver at (x, y, z). */
typedef void plane_approximation(const void *of, int k, const double at[3], double rgb[3]);

/* The relative RMSE of `count` approximations on the plane at a distance: over its receivers,
 * the root of the squared errors' sum over that of the slab's own irradiance; 0 without light. */
void plane_errors(const struct slab *slab, double distance, double margin,
                  plane_approximation *approximation, const void *of, int count, double *errors);

/* Length of the aperture's edge along SLAB_U or SLAB_V; the longer of both, the unit
 * of relative distances. */
double plane_edge(const struct slab *slab, int axis);
double plane_width(const struct slab *slab);

#endif
