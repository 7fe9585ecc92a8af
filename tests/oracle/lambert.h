/* lambert.h - radiance 1 through rectangles and polygons, in closed form (Lambert, "Photometria",
 * 1760). */
#ifndef LAMBERT_H
#define LAMBERT_H

/* Irradiance of a receiver that sees radiance 1 in the slopes x0..x1 and y0..y1 to its normal:
 * the integral of 1/(1 + x^2 + y^2)^2 over the window [x0, x1, y0, y1]. */
double lambert_window(const double window[4]);

/* The flux of radiance 1 that one of two parallel rectangles [x0, x1, y0, y1], so far apart, sends
 * to the other; relative error below 1e-9 while they are no farther than wide by 10. */
double lambert_exchange(const double a[4], const double b[4], double apart);

/* Convex polygons as a receiver at the origin sees them: `count` corners in order, at any distance.
 * The part in front of the plane through the origin with the normal n: its count, at most one
 * more. */
int lambert_clip(const long double from[][3], int count, const long double n[3],
                 long double to[][3]);
/* The irradiance from radiance 1 within one, all of it in front of the receiver of unit normal n;
 * 0 for fewer than three corners. */
long double lambert_polygon(const long double corners[][3], int count, const long double n[3]);

#endif
