/* lit.c - see lit.h. Columns and rows of the raster are interpolated each by itself. */
#include "lit.h"

#include <math.h>

#include "lamp.h"
#include "oracle/lookup.h"

enum { CELL_POINTS = 8, MOST = 1024 };

/* The samples around a point of an axis. */
struct taps {
  bool inside;
  int index[2];
  float weight[2];
};

static struct taps taps_at(double x, double half, int count) {
  struct taps taps;
  long double weight[2] = {0, 0};
  taps.inside = oracle_taps(x, -half, half, count, taps.index, weight);
  for (int k = 0; k < 2; ++k) taps.weight[k] = (float)weight[k];
  return taps;
}

static float mix(float one, float two, const struct taps *taps) {
  return taps->weight[0] * one + taps->weight[1] * two;
}

double lit_irradiance(const struct lit_samples *light, double x, double z, double below) {
  struct taps uv[MOST], st[2][MOST];
  double slope[2][MOST];
  int points = light->uv * CELL_POINTS, side = light->uv * light->st;
  double step = lamp_aperture / points, sum = 0;
  for (int n = 0; n < points; ++n) {
    double a = (n + 0.5) * step - lamp_aperture / 2;
    uv[n] = taps_at(a, lamp_aperture / 2, light->uv);
    for (int axis = 0; axis < 2; ++axis) {
      slope[axis][n] = ((axis ? z : x) - a) / below;
      st[axis][n] = taps_at(slope[axis][n], lamp_slope, light->st);
    }
  }
  for (int j = 0; j < points; ++j) {
    const struct taps *v = &uv[j], *t = &st[1][j];
    if (!t->inside) continue;
    const float *rows[4];
    for (int n = 0; n < 4; ++n)
      rows[n] =
          light->sample + (size_t)(v->index[n / 2] * light->st + t->index[n % 2]) * (size_t)side;
    for (int i = 0; i < points; ++i) {
      const struct taps *u = &uv[i], *s = &st[0][i];
      if (!s->inside) continue;
      float corner[4];
      for (int n = 0; n < 4; ++n) {
        int column = u->index[n / 2] * light->st + s->index[n % 2];
        corner[n] = mix(mix(rows[0][column], rows[1][column], t),
                        mix(rows[2][column], rows[3][column], t), v);
      }
      double radiance = (double)mix(mix(corner[0], corner[1], s), mix(corner[2], corner[3], s), u);
      double r = 1 + slope[0][i] * slope[0][i] + slope[1][j] * slope[1][j];
      sum += radiance / (r * r);
    }
  }
  return sum * step * step / (below * below);
}
