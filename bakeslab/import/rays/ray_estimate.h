/* ray_estimate.h - from the rays that leave through one page to its samples, the mean radiance of
 * each cell, with the error that is told.
 *
 * Rays come one at a time and are summed on the page's grid (ray_bins.h), so that memory does not
 * grow with their number: some 270 bytes a sample while the samples are found. Fluxes and radiances
 * are in the page's units: W and W/(sr m2), lm and cd/m2; lengths are in lamp units, as in slab.h.
 */
#ifndef RAY_ESTIMATE_H
#define RAY_ESTIMATE_H

#include "import/rays/ray_told.h"
#include "slab/slab.h"

struct ray_estimate; /* the rays of one page */

enum { RAY_ESTIMATE_APERTURES = 4 }; /* a tolerance holds from here on (plane_width) */

struct ray_estimate_wish {
  bool coloured;           /* fluxes differ between red, green and blue */
  double tolerance;        /* > 0: of irradiance, relative; chooses the samples */
  bool uv_given, st_given; /* then these samples stay */
  int threads;             /* at least 1; any number gives the same bits */
};

/* For the geometry of `page` (slab.h; it is copied, and its samples are not read), whose samples
 * are those that will be given or, with a tolerance, the finest that may be chosen. */
enum result ray_estimate_new(const struct slab *page, const struct ray_estimate_wish *wish,
                             struct ray_estimate **estimate, struct error *error);
void ray_estimate_free(struct ray_estimate *estimate);

/* Adds a ray through (a, b, s, t), as slab_ray gives it, that carries the flux rgb[3] (linear
 * Rec. 709; where not coloured, rgb[1] is read alone). False, and nothing is added, where it passes
 * outside the rectangle or the window, or where its luminance is not positive and finite. */
bool ray_estimate_add(struct ray_estimate *estimate, const double abst[SLAB_AXES],
                      const double rgb[3]);

/* That a ray through (a, b, s, t) will be added soon: what that takes is fetched from memory
 * meanwhile. Cells are too many for a cache, and to wait for each is most of what adding takes. */
void ray_estimate_expect(const struct ray_estimate *estimate, const double abst[SLAB_AXES]);

/* Luminous flux of all rays of the source, those that leave elsewhere included: which of them leave
 * here is chance then, and counts in the error. Without it the flux through the page is exact. */
void ray_estimate_whole(struct ray_estimate *estimate, double flux);

/* The samples: fills slab->rgb of a new slab, which the caller frees, with the geometry of the page
 * and no JSON but "samples_are". With a tolerance, the fewest samples for which told->irradiance is
 * at most that, or those of the least error: halvings of the page's, down to 4 along an axis. No
 * ray at all gives a dark slab, and errors of 0. */
enum result ray_estimate_finish(struct ray_estimate *estimate, struct slab *slab,
                                struct ray_estimate_told *told, struct error *error);

#endif
