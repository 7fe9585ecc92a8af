/* lambert.h - radiance 1 through rectangles, in closed form (Lambert, "Photometria", 1760). */
#ifndef LAMBERT_H
#define LAMBERT_H

/* Irradiance of a receiver that sees radiance 1 in the slopes x0..x1 and y0..y1 to its normal:
 * the integral of 1/(1 + x^2 + y^2)^2 over the window [x0, x1, y0, y1]. */
double lambert_window(const double window[4]);

/* The flux of radiance 1 that one of two parallel rectangles [x0, x1, y0, y1], so far apart, sends
 * to the other; relative error below 1e-9 while they are no farther than wide by 10. */
double lambert_exchange(const double a[4], const double b[4], double apart);

#endif
