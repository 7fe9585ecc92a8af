/* paper.c - see paper.h. */
#include "paper.h"

#include <math.h>

#include "simd.h"

/* A uniform number in [0,1) from a seed, which moves on (Steele, Lea and Flood, "Fast
 * splittable pseudorandom number generators", 2014). */
static double uniform(uint64_t *seed) {
  uint64_t z = *seed += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* Equation 2. */
static void interpolate(const float *const rows[4], const int offset[2], const double u[4],
                        const double v[4], double rgb[3]) {
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int row = 0; row < 4; ++row)
    for (int tap = 0; tap < 4; ++tap) {
      double weight = v[row] * u[tap];
      if (weight == 0) continue; /* at a border there is no upper sample to read */
      const float *sample = rows[row] + offset[tap >> 1] + 3 * (tap & 1);
      for (int c = 0; c < 3; ++c) rgb[c] += weight * (double)sample[c];
    }
}

static void add_cell(const struct view *view, const struct strip *u, const struct strip *v,
                     const float *const rows[4], uint64_t *seed, double irradiance[3],
                     double gloss[3]) {
  double x[SIMD_LANES] = {0}, value[SIMD_LANES], along_u[4], along_v[4], rgb[3];
  x[0] = u->low + uniform(seed) * (u->high - u->low);
  double y = v->low + uniform(seed) * (v->high - v->low);
  double area = (u->high - u->low) * (v->high - v->low);
  double height = kernel_height(&view->kernel, x[0], y), square = 1 + x[0] * x[0] + y * y;
  if (!(height > 0)) return;
  int offset[2];
  view_columns(view, &u->taps, offset);
  rule_hats(u, x[0], along_u);
  rule_hats(v, y, along_v);
  interpolate(rows, offset, along_u, along_v, rgb);
  for (int c = 0; c < 3; ++c) irradiance[c] += area * rgb[c] * height / (square * square);
  if (view->kernel.shininess <= 0) return;
  kernel_gloss(&view->kernel, x, y, 1, value);
  for (int c = 0; c < 3; ++c) gloss[c] += area * rgb[c] * value[0];
}

void paper_sum(const struct view *view, const struct strips strips[2], uint64_t seed,
               double irradiance[3], double gloss[3], struct cells_counts *counts) {
  for (int r = 0; r < strips[1].count; ++r) {
    const float *rows[4];
    view_rows(view, &strips[1].strip[r].taps, rows);
    for (int c = 0; c < strips[0].count; ++c)
      add_cell(view, &strips[0].strip[c], &strips[1].strip[r], rows, &seed, irradiance, gloss);
  }
  uint64_t count = (uint64_t)strips[0].count * (uint64_t)strips[1].count;
  counts->microlights += count;
  counts->nodes += count;
}
