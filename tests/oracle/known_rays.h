/* known_rays.h - sources of known radiance: rays of them at random, and the mean radiance of cells.
 *
 * Each fills the page of which it says the half widths of position (a, b) and slope (s, t), with
 * the st plane at infinity. Radiance is 1 or 0, but for the lobe's. */
#ifndef KNOWN_RAYS_H
#define KNOWN_RAYS_H

#include <stdint.h>

#include "slab/slab.h"

enum known_kind {
  KNOWN_SQUARE, /* a Lambertian square millimetre; the window has 92 % of it */
  KNOWN_BEAM,   /* a beam of 2 degrees, even in a cone, from a square of 10 mm */
  KNOWN_BARS,   /* a square of 12 cm, 10 cm behind an opening of 20 cm, and bars along v, 2 cm wide
                   and as far apart, 2 cm behind it */
  KNOWN_LOBE,   /* a Gaussian of slopes, standard deviation 0.3, that grows threefold along u */
  KNOWN_KINDS
};

struct known_source {
  const char *name;
  double half[4]; /* metres, metres, slopes, slopes */
};
extern const struct known_source known_sources[KNOWN_KINDS];

/* Its page, in W and metres, with nu^2 positions and ns^2 directions, and no samples yet. */
struct slab known_page(enum known_kind kind, int nu, int ns);

double known_radiance(enum known_kind kind, const double abst[4]);

/* A ray by chance, as likely as the source's flux. */
void known_ray(enum known_kind kind, uint64_t *seed, double abst[4]);

/* Fills the mean radiance and the etendue of each cell of samples[] = Nu, Nv, Ns, Nt, in the order
 * of a slab's pixels, and returns the flux, that outside the window included. Within a cell the
 * cosines are taken as linear with bars and as even without; the etendue is by 6^2 Gauss nodes. */
double known_cells(enum known_kind kind, const int samples[4], double *mean, double *etendue);

#endif
