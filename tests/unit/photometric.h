/* photometric.h - photometric files made for tests, from functions of the direction. */
#ifndef PHOTOMETRIC_H
#define PHOTOMETRIC_H

#include "import/import.h"

/* Intensity towards a unit direction of lamp space, cd. */
typedef double photometric_candela(const double direction[3], const void *about);

/* Writes an IES file of 2002, type C, metres, with an intensity every `step` degrees of gamma and
 * twice that of C, and the opening's width, length and height. Returns its path. */
const char *photometric_ies(const char *name, photometric_candela *candela, const void *about,
                            double step, const double size[3]);

/* Imports a file; fails the test where that fails. To be freed with import_free. */
struct import_light photometric_import(const char *path, const struct import_wish *wish);

/* The light's irradiance at a point with a normal, by a sum over count x count points of each
 * page, and its intensity towards a direction, seen from `distance` away. Luminance. */
double photometric_irradiance(const struct import_light *light, const double point[3],
                              const double normal[3], int count);
double photometric_far(const struct import_light *light, const double direction[3],
                       double distance);

/* Directions all over the sphere: number n of count. */
void photometric_direction(int n, int count, double direction[3]);

#endif
