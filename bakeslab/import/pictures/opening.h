/* opening.h - which part of a page is the lamp's opening, as pictures show it. Half cells of
 * positions where none of them sees any light are dark in all directions; those beside them are
 * open in part. Radiance is interpolated as if there were no edge, from the rays that are clear of
 * it, and then cut off there. So light that is interpolated behind the opening stays within it, and
 * the dark around it does not dim it. */
#ifndef OPENING_H
#define OPENING_H

#include "import/pictures/rebin.h"

struct opening {
  int size[2];            /* half cells along u and v */
  struct half_cell *cell; /* [j * size[0] + i]; owned */
};

/* From a page's rays, whose places are in the slab's samples. Dark is what is below 1/1000 of the
 * brightest ray; what no ray shows counts as open. Free it in any case. */
enum result opening_find(const struct rebin_ray *rays, size_t count, const struct slab *slab,
                         struct opening *opening, struct error *error);
void opening_free(struct opening *opening);

/* Where a ray leaves. */
enum opening_part { OPENING_CLEAR, OPENING_EDGE, OPENING_DARK };
enum opening_part opening_part(const struct opening *opening, const struct rebin_ray *ray);

/* Tells what a ray at the edge would be if there were none: its half cell is open by the share that
 * fits all of its rays best, by least squares; before any are told, by half. */
void opening_compare(struct opening *opening, const struct rebin_ray *ray, double clear);

/* The part of a position's cell that is open. */
double opening_share(const struct opening *opening, int i, int j);

#endif
