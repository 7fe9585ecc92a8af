/* cluster_target.h - what lights are fitted to, and what their error is told by: receivers that
 * see the page.
 *
 * Lengths are in aperture widths, x along u and y along v. The squared irradiance of a plane's
 * receivers, times the squares of their weights, sums to the plane's weight. */
#ifndef CLUSTER_TARGET_H
#define CLUSTER_TARGET_H

#include <stdbool.h>

#include "include/cluster/cluster_light.h"
#include "slab/slab.h"

struct cluster_target {
  double edge[2];   /* of the aperture */
  double window[4]; /* s0, s1, t0, t1, as seen from its centre */
  double unit;      /* of irradiance and flux, in lamp units */
  double narrowest; /* lobe that the receivers see, radians: their coarsest step */
  int count;        /* of receivers, without the flux */
  double (*at)[3];  /* the block of memory that holds all three; owned */
  double (*rgb)[3]; /* irradiance and, last, flux: count + 1 */
  double *weight;   /* count + 1 */
};

/* To fit to: receivers on planes around `distance`, and the flux, in units of its largest
 * channel. With `intensity` each counts by the solid angle that it takes up, and what the light is
 * seen from there, as if it faced the light: steep directions count as others do. Free with
 * cluster_target_free, also after a failure. */
enum result cluster_target_make(const struct slab *slab, double distance, bool intensity,
                                struct cluster_target *target, struct error *error);

/* To tell the error by: the whole plane at a distance, on many receivers, none of which is among
 * those to fit to; in lamp units, without the flux. */
enum result cluster_gauge_make(const struct slab *slab, double distance,
                               struct cluster_target *gauge, struct error *error);
void cluster_target_free(struct cluster_target *target);

/* The relative RMSE of lights, their rgb in units of `unit`. */
double cluster_error(const struct cluster_target *gauge, const struct cluster_light *lights,
                     int count, double unit);

#endif
