/* lamp.h - lamps/parabolic.pov with its bulb alone, as the benchmarks know it: a ray
 * caster that shares nothing with the bake, for this lamp only and therefore fast. */
#ifndef LAMP_H
#define LAMP_H

/* The slab's rectangle is lamp_aperture units wide and long, its window +-lamp_slope. */
extern const double lamp_aperture, lamp_slope;

/* Radiance of the ray (a, b, s, t) of light-slab(5). */
double lamp_radiance(double a, double b, double s, double t);

/* Flux through rectangle and window in lamp units, by quasi-random rays. */
double lamp_flux(int rays);

/* The n-th point of a low-discrepancy sequence in the unit 4-cube, moved by `shift`. */
void lamp_point(int n, const double shift[4], double point[4]);

#endif
