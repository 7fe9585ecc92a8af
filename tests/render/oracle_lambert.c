/* oracle_lambert.c - two simple answers that the oracle is held against:
 * Lambert's polygon formula, and a midpoint sum. */
#include <math.h>

#include "oracle.h"

struct seen {
  long double foot[2], height, n[3]; /* in the slab's frame */
  long double half[2], kappa;
};

static struct seen look(const struct slab *slab, const double p[3], const double n[3]) {
  struct seen seen = {.kappa = isinf(slab->st_distance) ? 0 : 1 / (long double)slab->st_distance};
  long double frame[3][3], local[3] = {0}, length = 0;
  oracle_frame(slab, frame);
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) {
      local[r] += frame[r][k] * ((long double)p[k] - (long double)slab->center[k]);
      seen.n[r] += frame[r][k] * (long double)n[k];
    }
  for (int k = 0; k < 3; ++k) {
    length += seen.n[k] * seen.n[k];
    if (k < 2)
      for (int c = 0; c < 3; ++c)
        seen.half[k] += frame[k][c] * (long double)(k ? slab->v : slab->u)[c] / 2;
  }
  for (int k = 0; k < 3; ++k) seen.n[k] /= sqrtl(length);
  seen.foot[0] = local[0], seen.foot[1] = local[1], seen.height = local[2];
  return seen;
}

/* The visible interval of slopes along an axis. */
static void visible(const struct seen *seen, const double window[2], int axis, long double x[2]) {
  long double lean = 1 - seen->kappa * seen->height, s = seen->kappa * seen->foot[axis];
  x[0] = (-seen->half[axis] - seen->foot[axis]) / seen->height;
  x[1] = (seen->half[axis] - seen->foot[axis]) / seen->height;
  if (lean == 0) {
    if (s < (long double)window[0] || s > (long double)window[1]) x[1] = x[0];
    return;
  }
  long double a = (s - (long double)window[0]) / lean, b = (s - (long double)window[1]) / lean;
  x[0] = fmaxl(x[0], fminl(a, b));
  x[1] = fminl(x[1], fmaxl(a, b));
}

/* Keeps the part of a convex polygon in front of the receiver. */
static int clip(const long double from[][3], int count, const long double n[3],
                long double to[][3]) {
  int kept = 0;
  for (int k = 0; k < count; ++k) {
    const long double *a = from[k], *b = from[(k + 1) % count];
    long double da = a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
    long double db = b[0] * n[0] + b[1] * n[1] + b[2] * n[2];
    if (da >= 0) {
      for (int c = 0; c < 3; ++c) to[kept][c] = a[c];
      ++kept;
    }
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      for (int c = 0; c < 3; ++c) to[kept][c] = a[c] + (b[c] - a[c]) * (da / (da - db));
      ++kept;
    }
  }
  return kept;
}

long double oracle_lambert(const struct slab *slab, const double p[3], const double n[3]) {
  struct seen seen = look(slab, p, n);
  long double x[2], y[2], sum = 0;
  visible(&seen, slab->st_window, 0, x);
  visible(&seen, slab->st_window + 2, 1, y);
  if (!(x[0] < x[1] && y[0] < y[1])) return 0;
  const long double whole[4][3] = {
      {x[0], y[0], -1}, {x[1], y[0], -1}, {x[1], y[1], -1}, {x[0], y[1], -1}};
  long double part[8][3];
  int count = clip(whole, 4, seen.n, part);
  for (int k = 0; k < count; ++k) {
    const long double *a = part[k], *b = part[(k + 1) % count];
    long double cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                            a[0] * b[1] - a[1] * b[0]};
    long double size = sqrtl(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    long double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    if (size > 0)
      sum += atan2l(size, dot) / size *
             (cross[0] * seen.n[0] + cross[1] * seen.n[1] + cross[2] * seen.n[2]);
  }
  return fabsl(sum) / 2;
}

/* The samples on both sides of x where the grid spans 0..1, and their hats. */
static void hats(double x, int n, int index[2], double weight[2]) {
  double at = fmin(fmax(x * n - 0.5, 0), n - 1);
  index[0] = (int)at;
  index[1] = index[0] + 1 < n ? index[0] + 1 : index[0];
  weight[1] = at - index[0];
  weight[0] = 1 - weight[1];
}

static void radiance(const struct slab *slab, const double at[4], double rgb[3]) {
  const int *n = slab->samples;
  int index[4][2];
  double weight[4][2];
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int axis = 0; axis < 4; ++axis) {
    if (at[axis] < 0 || at[axis] > 1) return;
    hats(at[axis], n[axis], index[axis], weight[axis]);
  }
  for (int k = 0; k < 16; ++k) {
    int i = k & 1, j = k >> 1 & 1, s = k >> 2 & 1, t = k >> 3;
    long row = (long)index[1][j] * n[3] + index[3][t],
         column = (long)index[0][i] * n[2] + index[2][s];
    double w = weight[0][i] * weight[1][j] * weight[2][s] * weight[3][t];
    for (int c = 0; c < 3; ++c)
      rgb[c] += w * (double)slab->rgb[3 * (row * n[0] * n[2] + column) + c];
  }
}

void oracle_brute(const struct slab *slab, const double p[3], const double n[3], int count,
                  double rgb[3]) {
  struct seen seen = look(slab, p, n);
  const double *w = slab->st_window;
  double z = (double)seen.height, kappa = (double)seen.kappa;
  double size[2] = {2 * (double)seen.half[0], 2 * (double)seen.half[1]};
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      double at[4] = {(i + 0.5) / count, (j + 0.5) / count, 0, 0}, colour[3];
      double a = (at[0] - 0.5) * size[0], b = (at[1] - 0.5) * size[1];
      double dx = (double)seen.foot[0] - a, dy = (double)seen.foot[1] - b;
      double s = dx / z + kappa * a, t = dy / z + kappa * b, r2 = dx * dx + dy * dy + z * z;
      double facing = -dx * (double)seen.n[0] - dy * (double)seen.n[1] - z * (double)seen.n[2];
      if (facing <= 0) continue;
      at[2] = (s - w[0]) / (w[1] - w[0]), at[3] = (t - w[2]) / (w[3] - w[2]);
      radiance(slab, at, colour);
      for (int c = 0; c < 3; ++c)
        rgb[c] += colour[c] * facing * z / (r2 * r2) * size[0] * size[1] / count / count;
    }
}
