/* cluster_gradient.c - how the irradiance of a light changes with its numbers. */
#include <math.h>
#include <string.h>

#include "include/cluster/cluster.h"

/* A lobe of the cosine `c` to its axis: its value and derivatives. */
struct lobe_slopes {
  double value, by_cosine, by_tightness, by_falloff, by_softness;
};

static struct lobe_slopes lobe_slopes(const struct cluster_light *light, double c) {
  double n = light->tightness, logarithm = log(c), power = exp(n * logarithm);
  double room = 1 - light->cos_falloff, edge = light->cos_radius - light->cos_falloff;
  double p = fmin((c - light->cos_falloff) / edge, 1), share = p * p * (3 - 2 * p);
  double steep = power * 6 * p * (1 - p); /* of the value, by p; 0 inside the radius */
  return (struct lobe_slopes){.value = power * share,
                              .by_cosine = n / c * power * share + steep / edge,
                              .by_tightness = (n + 1) * logarithm * power * share,
                              .by_falloff = steep * (c - 1) / (edge * room),
                              .by_softness = -steep * p * room / edge};
}

static void add_point(const struct cluster_light *light, double p, double q, const double at[3],
                      double slopes[CLUSTER_NUMBERS]) {
  const double *axis = light->axis;
  double size = sqrt(1 + axis[0] * axis[0] + axis[1] * axis[1]), by_place[2];
  double x[2] = {at[0] - light->center[0] - p * light->edge[0][0] - q * light->edge[1][0],
                 at[1] - light->center[1] - p * light->edge[0][1] - q * light->edge[1][1]};
  double r2 = x[0] * x[0] + x[1] * x[1] + at[2] * at[2], r = sqrt(r2);
  double c = (x[0] * axis[0] + x[1] * axis[1] + at[2]) / (r * size), facing = at[2] / (r2 * r);
  if (c <= light->cos_falloff) return;
  struct lobe_slopes lobe = lobe_slopes(light, c);
  for (int k = 0; k < 2; ++k) {
    by_place[k] = -facing * (lobe.by_cosine * (axis[k] / (r * size) - c * x[k] / r2) -
                             3 * lobe.value * x[k] / r2);
    slopes[CLUSTER_CENTER + k] += by_place[k];
    slopes[CLUSTER_AXIS + k] +=
        facing * lobe.by_cosine * (x[k] / (r * size) - c * axis[k] / (size * size));
  }
  for (int k = 0; k < 2; ++k)
    slopes[CLUSTER_SCALE + k] +=
        (k ? q : p) * (light->edge[k][0] * by_place[0] + light->edge[k][1] * by_place[1]);
  slopes[CLUSTER_TIGHTNESS] += facing * lobe.by_tightness;
  slopes[CLUSTER_FALLOFF] += facing * lobe.by_falloff;
  slopes[CLUSTER_SOFTNESS] += facing * lobe.by_softness;
}

void cluster_gradient(const struct cluster_light *light, const double at[3],
                      double slopes[CLUSTER_NUMBERS]) {
  int nu = light->size[0], nv = light->size[1];
  memset(slopes, 0, CLUSTER_NUMBERS * sizeof *slopes);
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      add_point(light, (i + 0.5) / nu - 0.5, (j + 0.5) / nv - 0.5, at, slopes);
  for (int n = 0; n < CLUSTER_NUMBERS; ++n) slopes[n] /= nu * nv;
}
