/* flux_box.h - checks that the light of a slab is conserved: what leaves the aperture arrives on a
 * closed box around it, and no other page emits it again.
 *
 * The box stands on the aperture's plane: its lid and walls are an aperture's width (the longer
 * edge) away from it. The flux on them is an integral of irradiance over points of the box, by
 * lookups of rays as in a renderer. slab_flux integrates over the aperture and the window instead,
 * and shares only the samples with it. Quasi-random, always the same; a fraction of a second. */
#ifndef FLUX_BOX_H
#define FLUX_BOX_H

#include "slab/slab.h"

struct flux_box {
  double aperture[3]; /* slab_flux */
  double box[3];      /* arriving on the box, same units */
  double difference;  /* of the two, over the flux of |radiance|; 0 without light */
  double uncertainty; /* how far `difference` may be wrong; INFINITY: the light is too thin a peak
                         for this sum to have met it often enough */
};

enum result flux_box_measure(const struct slab *slab, struct flux_box *flux, struct error *error);

/* The part of a slab's flux, of |radiance|, that goes on to leave through the aperture of `other`,
 * inside its window: light that a lamp of both pages counts twice. Of `other` only the geometry
 * matters. */
enum result flux_box_twice(const struct slab *slab, const struct slab *other, double *share,
                           struct error *error);

/* The flux of a lamp of `count` pages: that of each ray once, through the last page of its channel
 * that it leaves by. Units of slab_flux. */
enum result flux_box_lamp(const struct slab *pages, int count, double rgb[3], struct error *error);

/* Whether the line of a ray passes through a page's aperture inside its window, outwards; *ahead
 * is where along the normal, from the point on. */
bool flux_box_leaves(const struct slab *page, const double point[3], const double direction[3],
                     double *ahead);

#endif
