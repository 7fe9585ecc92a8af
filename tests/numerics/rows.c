/* rows.c - the table's rows. */
#include "numerics.h"

#define QUADRATURE "exact rationals, long double quadrature"

const struct numerics_row numerics_rows[] = {
    {"distance", "1e-9 to 1e9 apertures away", QUADRATURE, row_distance, 40},
    {"grazing-receiver", "light from 1e-9 to 90 degrees over the receiver's horizon", QUADRATURE,
     row_grazing_receiver, 40},
    {"grazing-lamp", "slopes up to 1e9 in the lamp's window", QUADRATURE, row_grazing_lamp, 20},
    {"aspect", "apertures, windows of 1:1 to 1:1e6", QUADRATURE, row_aspect, 40},
    {"st-distance", "st plane at 1e-6 to 1e9 apertures", QUADRATURE, row_st_distance, 40},
    {"offset", "lamp up to 1e8 apertures from the origin", QUADRATURE, row_offset, 20},
    {"range", "samples of 1e-30 to 1e30", QUADRATURE, row_range, 40},
    {"peak", "one lit sample", QUADRATURE, row_peak, 40},
    {"sizes", "1-wide grids", QUADRATURE, row_sizes, 20},
    {"signed", "samples of both signs", QUADRATURE, row_signed, 20},
    {"tangent", "the receiver's tangent plane through corners and along edges", QUADRATURE,
     row_tangent, 40},
    {"window", "the window's edge seen through the aperture's", QUADRATURE, row_window, 40},
    {"touching", "down to the uv plane and on it", QUADRATURE, row_touching, 40},
    {"st-plane", "through the st plane and on it", QUADRATURE, row_st_plane, 40},
    {"st-infinity", "st plane at 10 to 1e15, against infinity", QUADRATURE, row_st_infinity, 20},
    {"lines", "on lines of both grids, and the next double beside", QUADRATURE, row_lines, 20},
    {"units", "lengths of 1e-150 to 1e150", QUADRATURE, row_units, 40},
    {"switches", "both sides of a change of rules, nodes or micro lights", "itself", row_switches,
     60},
    {"growth", "small steps along each kind of hardness: no jump of the error", QUADRATURE,
     row_growth, 3},
    {"constant", "radiance 1", "Lambert's polygon formula", row_constant, 20},
    {"mpmath", "a table of hard cases", "mpmath, 50 digits", row_mpmath, 6},
    {"strips", "lines of uv and st merged, hat functions", "exact rationals", row_strips, 20},
    {"single", "sums in single precision", "the rules' definitions, long double", row_single, 20},
    {"levels", "energy on each level", "exact rationals", row_levels, 20},
    {"random", "the mean of random samples", QUADRATURE, row_random, 10},
    {"powers", "lengths and samples times powers of two: the same bits", "itself", row_powers, 60},
    {"symmetry", "mirrored, u and v swapped, turned by 90 degrees", "itself", row_symmetry, 60},
    {"neighbours", "receivers in another order, in other groups: the same bits", "itself",
     row_neighbours, 3},
    {"superposition", "sums and differences of samples", "itself", row_superposition, 60},
};
const int numerics_row_count = sizeof numerics_rows / sizeof numerics_rows[0];
