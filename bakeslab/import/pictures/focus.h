/* focus.h - between pictures, radiance is interpolated at the same point of a plane: the
 * aperture's, or one behind it, where what shines is (the focal surface of A. Isaksen, L. McMillan
 * and S. J. Gortler, "Dynamically Reparameterized Light Fields", SIGGRAPH 2000; the depth
 * correction of Gortler et al. 1996, section 3.4.3, is the same with a shape for a plane). A bulb
 * stays sharp so, and does not become as many bulbs as there are pictures. */
#ifndef FOCUS_H
#define FOCUS_H

#include "import/pictures/rebin.h"

struct focus_report {
  struct rebin_report rebin;
  double depth;      /* behind the aperture, in lamp units */
  double holes;      /* share of the samples that no ray touches */
  double flux_holes; /* their share of the flux */
};

/* Rebins the rays at the depth behind the aperture at which the sources that are held out are told
 * best, and makes the slab of that: its geometry and samples are given, as many directions as the
 * sources tell, and it is not allocated. Its directions become st[], or where that is 0 as many as
 * the depth asks for. Places of rays are those in the given slab. */
enum result focus_rebin(const struct rebin_ray *rays, size_t count, const int st[2],
                        struct slab *slab, struct focus_report *report, struct error *error);

#endif
