#include "microlight/paper.h"

#include <math.h>

#include "base/simd.h"

/* A uniform number in [0,1) from a seed, which is advanced (Steele, Lea and Flood, "Fast
 * splittable pseudorandom number generators", 2014). */
static double uniform(uint64_t *seed) {
  uint64_t z = *seed += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* What one sample of a level stands for along an axis of the raster: the samples of `fine`
 * from first to last. */
struct block {
  int first, last;
};

static struct block find_block(int fine, int coarse, int index) {
  return (struct block){(int)((int64_t)index * fine / coarse),
                        (int)((int64_t)(index + 1) * fine / coarse)};
}

/* Adds weight times the mean of the samples that (i, j, k, l) of the level stands for. */
static void add_mean(const struct slab *fine, const struct slab *level, const int at[SLAB_AXES],
                     double weight, double rgb[3]) {
  struct block block[SLAB_AXES];
  double sum[3] = {0}, count = 1;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    block[axis] = find_block(fine->samples[axis], level->samples[axis], at[axis]);
    count *= block[axis].last - block[axis].first;
  }
  for (int j = block[SLAB_V].first; j < block[SLAB_V].last; ++j)
    for (int l = block[SLAB_T].first; l < block[SLAB_T].last; ++l)
      for (int i = block[SLAB_U].first; i < block[SLAB_U].last; ++i)
        for (int k = block[SLAB_S].first; k < block[SLAB_S].last; ++k) {
          const float *sample = slab_at(fine, i, j, k, l);
          for (int c = 0; c < 3; ++c) sum[c] += (double)sample[c];
        }
  for (int c = 0; c < 3; ++c) rgb[c] += weight / count * sum[c];
}

/* Equation 2. */
static void interpolate(const struct slab *fine, const struct slab *level, const struct strip *u,
                        const struct strip *v, const double along_u[4], const double along_v[4],
                        double rgb[3]) {
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int row = 0; row < 4; ++row)
    for (int tap = 0; tap < 4; ++tap) {
      double weight = along_v[row] * along_u[tap];
      if (weight == 0) continue; /* at a border there is no upper sample to read */
      const int at[SLAB_AXES] = {u->taps.near + (tap >> 1), v->taps.near + (row >> 1),
                                 u->taps.far + (tap & 1), v->taps.far + (row & 1)};
      if (fine == level) {
        const float *sample = slab_at(fine, at[0], at[1], at[2], at[3]);
        for (int c = 0; c < 3; ++c) rgb[c] += weight * (double)sample[c];
      } else {
        add_mean(fine, level, at, weight, rgb);
      }
    }
}

static void add_cell(const struct seen_page *seen, const struct light_page *fine,
                     const struct strip *u, const struct strip *v, uint64_t *seed,
                     double irradiance[3], double gloss[3]) {
  double x[SIMD_LANES] = {0}, value[SIMD_LANES], along_u[4], along_v[4], rgb[3];
  double across = uniform(seed), up = uniform(seed);
  double y = v->low + up * v->width, area = u->width * v->width;
  x[0] = u->low + across * u->width;
  double height = kernel_height(&seen->kernel, x[0], y), square = 1 + x[0] * x[0] + y * y;
  if (!(height > 0)) return;
  rule_hats(u, across, along_u);
  rule_hats(v, up, along_v);
  interpolate(&fine->slab, &seen->page->slab, u, v, along_u, along_v, rgb);
  for (int c = 0; c < 3; ++c) irradiance[c] += area * rgb[c] * height / (square * square);
  if (seen->kernel.shininess <= 0) return;
  kernel_gloss(&seen->kernel, x, y, 1, value);
  for (int c = 0; c < 3; ++c) gloss[c] += area * rgb[c] * value[0];
}

void paper_sum(const struct seen_page *seen, const struct light_page *fine,
               const struct strips strips[2], uint64_t seed, double irradiance[3], double gloss[3],
               struct gather_counts *counts) {
  for (int r = 0; r < strips[1].count; ++r)
    for (int c = 0; c < strips[0].count; ++c)
      add_cell(seen, fine, &strips[0].strip[c], &strips[1].strip[r], &seed, irradiance, gloss);
  uint64_t count = (uint64_t)strips[0].count * (uint64_t)strips[1].count;
  counts->microlights += count;
  counts->nodes += count;
}
