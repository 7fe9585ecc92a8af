/* lookup.c - see lookup.h. */
#include "oracle/lookup.h"

#include <math.h>

float *oracle_sample(const struct slab *slab, int i, int j, int k, int l) {
  const int *n = slab->samples;
  size_t row = (size_t)j * (size_t)n[3] + (size_t)l, column = (size_t)i * (size_t)n[2] + (size_t)k;
  return slab->rgb + 3 * (row * (size_t)n[0] * (size_t)n[2] + column);
}

bool oracle_taps(long double x, long double low, long double high, int count, int index[2],
                 long double weight[2]) {
  if (!(x >= low && x <= high)) return false;
  long double at = fminl(fmaxl((x - low) / (high - low) * count - 0.5L, 0), count - 1);
  index[0] = (int)at;
  index[1] = index[0] + 1 < count ? index[0] + 1 : index[0];
  weight[1] = at - index[0];
  weight[0] = 1 - weight[1];
  return true;
}

/* Squares of doubles are within the range of long double. */
static long double half_of(const double edge[3]) {
  long double x = edge[0], y = edge[1], z = edge[2];
  return sqrtl(x * x + y * y + z * z) / 2;
}

void oracle_lookup(const struct slab *slab, const double abst[4], double rgb[3]) {
  const double *w = slab->st_window;
  const long double u = half_of(slab->u), v = half_of(slab->v);
  const long double ends[4][2] = {{-u, u}, {-v, v}, {w[0], w[1]}, {w[2], w[3]}};
  long double weight[4][2];
  int index[4][2];
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int axis = 0; axis < 4; ++axis)
    if (!oracle_taps(abst[axis], ends[axis][0], ends[axis][1], slab->samples[axis], index[axis],
                     weight[axis]))
      return;
  for (int m = 0; m < 16; ++m) {
    int i = m & 1, j = m >> 1 & 1, k = m >> 2 & 1, l = m >> 3;
    double share = (double)(weight[0][i] * weight[1][j] * weight[2][k] * weight[3][l]);
    const float *sample = oracle_sample(slab, index[0][i], index[1][j], index[2][k], index[3][l]);
    for (int c = 0; c < 3; ++c) rgb[c] += share * (double)sample[c];
  }
}

void oracle_lookup_view(const struct slab *slab, int i, int j, long double s, long double t,
                        long double rgb[3]) {
  const double *w = slab->st_window;
  long double by_s[2], by_t[2];
  int k[2], l[2];
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!oracle_taps(s, w[0], w[1], slab->samples[2], k, by_s) ||
      !oracle_taps(t, w[2], w[3], slab->samples[3], l, by_t))
    return;
  for (int m = 0; m < 4; ++m)
    for (int c = 0; c < 3; ++c)
      rgb[c] += by_s[m & 1] * by_t[m >> 1] *
                (long double)oracle_sample(slab, i, j, k[m & 1], l[m >> 1])[c];
}
