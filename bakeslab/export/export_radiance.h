/* export_radiance.h - a lamp for Radiance: NAME.rad with polygons for its apertures, and for each
 * page with light NAMEk.cal, which finds a ray's place in the slab, and its radiance in
 * four-dimensional data files (Ward and Shakespeare, "Rendering with Radiance"; ray(1),
 * "colordata", "light"). Exact for single rays. Radiance's space is right-handed with z up: a lamp
 * point (x, y, z) is (x, z, y) there. Radiance is in W/(sr m2), of which 1 cd/m2 is 1/179. */
#ifndef EXPORT_RADIANCE_H
#define EXPORT_RADIANCE_H

#include "export/export_wish.h"

/* Radiance's luminous efficacy of white light, in lm/W (color.h, WHTEFFICACY). */
extern const double export_radiance_efficacy;

export_write export_radiance;

#endif
