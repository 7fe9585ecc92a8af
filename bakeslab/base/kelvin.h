/* kelvin.h - the colour of a black body. */
#ifndef KELVIN_H
#define KELVIN_H

enum { KELVIN_LEAST = 1000, KELVIN_MOST = 40000 };

/* Linear Rec. 709 of luminance 1, within the primaries' gamut; chromaticity within 8e-5 (u, v) of
 * Planck's from KELVIN_LEAST to 15000 and 0.003 to KELVIN_MOST (Krystek, "An algorithm to calculate
 * correlated colour temperature", Color Research and Application 10, 1985). Nothing is balanced:
 * white is D65, which 6504 K comes near to. */
void kelvin_colour(double kelvin, double rgb[3]);

#endif
