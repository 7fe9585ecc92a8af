/* lit.h - the irradiance that samples give a plane below the lamp: many times faster than looking
 * up ray by ray, for the benchmarks' floors of thousands of receivers. */
#ifndef LIT_H
#define LIT_H

/* Grey samples of UV x UV x ST x ST on lamp.h's aperture and window, in the raster of a slab:
 * [j][l][i][k], slopes of one position together. */
struct lit_samples {
  int uv, st; /* UV at most 128 */
  const float *sample;
};

/* At (x, z), so far below the aperture, by midpoints of a grid of 8 a cell and axis. */
double lit_irradiance(const struct lit_samples *light, double x, double z, double below);

#endif
