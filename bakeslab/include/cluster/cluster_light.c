/* cluster_light.c - what one light does, and how that changes with its numbers. */
#include "include/cluster/cluster_light.h"

#include <math.h>
#include <string.h>

#include "slab/slab_gauss.h"

enum { LOBE_NODES = 12, LOBE_PIECES = 12 };

static double lobe(const struct cluster_light *light, double cosine) {
  if (cosine <= light->cos_falloff) return 0;
  double value = exp(light->tightness * log(cosine));
  if (cosine >= light->cos_radius) return value;
  double p = (cosine - light->cos_falloff) / (light->cos_radius - light->cos_falloff);
  return value * p * p * (3 - 2 * p);
}

double cluster_irradiance(const struct cluster_light *light, const double at[3]) {
  static const double all[2] = {INFINITY, INFINITY};
  return cluster_irradiance_until(light, all, at);
}

double cluster_irradiance_until(const struct cluster_light *light, const double until[2],
                                const double at[3]) {
  const double *axis = light->axis;
  double sum = 0, size = sqrt(1 + axis[0] * axis[0] + axis[1] * axis[1]);
  int nu = light->size[0], nv = light->size[1];
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      double p = (i + 0.5) / nu - 0.5, q = (j + 0.5) / nv - 0.5;
      double x = at[0] - light->center[0] - p * light->edge[0][0] - q * light->edge[1][0];
      double y = at[1] - light->center[1] - p * light->edge[0][1] - q * light->edge[1][1];
      if (at[0] - x > until[0] || at[1] - y > until[1]) continue;
      double r2 = x * x + y * y + at[2] * at[2], r = sqrt(r2);
      double cosine = (x * axis[0] + y * axis[1] + at[2]) / (r * size);
      if (cosine > light->cos_falloff) sum += lobe(light, cosine) * at[2] / (r2 * r);
    }
  return sum / (nu * nv);
}

/* 2 pi times the lobe's integral over the cosine; closed within the inner cone. */
double cluster_flux(const struct cluster_light *light) {
  double nodes[LOBE_NODES], weights[LOBE_NODES], sum = 0, power = light->tightness + 1;
  double low = light->cos_falloff, step = (light->cos_radius - low) / LOBE_PIECES;
  slab_gauss_legendre(LOBE_NODES, nodes, weights);
  for (int piece = 0; piece < LOBE_PIECES && step > 0; ++piece)
    for (int k = 0; k < LOBE_NODES; ++k)
      sum += weights[k] * step / 2 * lobe(light, low + (piece + 0.5 + nodes[k] / 2) * step);
  return 2 * M_PI * (sum + (1 - pow(light->cos_radius, power)) / power);
}

/* A lobe of the cosine `c` to its axis: its value and derivatives. */
struct lobe_gradient {
  double value, by_cosine, by_tightness, by_falloff, by_softness;
};

static struct lobe_gradient lobe_gradient(const struct cluster_light *light, double c) {
  double n = light->tightness, logarithm = log(c), power = exp(n * logarithm);
  double room = 1 - light->cos_falloff, edge = light->cos_radius - light->cos_falloff;
  double p = fmin((c - light->cos_falloff) / edge, 1), share = p * p * (3 - 2 * p);
  double steep = power * 6 * p * (1 - p); /* of the value, by p; 0 inside the radius */
  return (struct lobe_gradient){.value = power * share,
                                .by_cosine = n / c * power * share + steep / edge,
                                .by_tightness = (n + 1) * logarithm * power * share,
                                .by_falloff = steep * (c - 1) / (edge * room),
                                .by_softness = -steep * p * room / edge};
}

/* Adds the derivatives of one point's irradiance, (p, q) edges away from the middle. */
static void add_point(const struct cluster_light *light, double p, double q, const double at[3],
                      struct cluster_numbers *gradient) {
  const double *axis = light->axis;
  double size = sqrt(1 + axis[0] * axis[0] + axis[1] * axis[1]), by_place[2];
  double x[2] = {at[0] - light->center[0] - p * light->edge[0][0] - q * light->edge[1][0],
                 at[1] - light->center[1] - p * light->edge[0][1] - q * light->edge[1][1]};
  double r2 = x[0] * x[0] + x[1] * x[1] + at[2] * at[2], r = sqrt(r2);
  double c = (x[0] * axis[0] + x[1] * axis[1] + at[2]) / (r * size), facing = at[2] / (r2 * r);
  if (c <= light->cos_falloff) return;
  struct lobe_gradient lobe = lobe_gradient(light, c);
  for (int k = 0; k < 2; ++k) {
    by_place[k] = -facing * (lobe.by_cosine * (axis[k] / (r * size) - c * x[k] / r2) -
                             3 * lobe.value * x[k] / r2);
    gradient->center[k] += by_place[k];
    gradient->axis[k] +=
        facing * lobe.by_cosine * (x[k] / (r * size) - c * axis[k] / (size * size));
  }
  for (int k = 0; k < 2; ++k)
    gradient->scale[k] +=
        (k ? q : p) * (light->edge[k][0] * by_place[0] + light->edge[k][1] * by_place[1]);
  gradient->tightness += facing * lobe.by_tightness;
  gradient->falloff += facing * lobe.by_falloff;
  gradient->softness += facing * lobe.by_softness;
}

struct cluster_numbers cluster_gradient(const struct cluster_light *light, const double at[3]) {
  struct cluster_numbers gradient = {0};
  int nu = light->size[0], nv = light->size[1];
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      add_point(light, (i + 0.5) / nu - 0.5, (j + 0.5) / nv - 0.5, at, &gradient);
  for (int n = 0; n < CLUSTER_NUMBERS; ++n) gradient.x[n] /= nu * nv;
  return gradient;
}

struct cluster_numbers cluster_to_numbers(const struct cluster_light *light) {
  return (struct cluster_numbers){.center = {light->center[0], light->center[1]},
                                  .axis = {light->axis[0], light->axis[1]},
                                  .tightness = log1p(light->tightness),
                                  .falloff = light->cos_falloff,
                                  .softness = (light->cos_radius - light->cos_falloff) /
                                              (1 - light->cos_falloff)};
}

struct cluster_light cluster_from_numbers(const struct cluster_numbers *n,
                                          const struct cluster_light *seed) {
  struct cluster_light light = *seed;
  double tilt = hypot(n->axis[0], n->axis[1]);
  for (int k = 0; k < 2; ++k) {
    light.center[k] = n->center[k];
    light.axis[k] = n->axis[k];
    for (int c = 0; c < 2; ++c) light.edge[k][c] *= exp(n->scale[k]);
  }
  light.tightness = expm1(n->tightness);
  light.cos_falloff = fmax(n->falloff, tilt / sqrt(1 + tilt * tilt));
  light.cos_radius = light.cos_falloff + n->softness * (1 - light.cos_falloff);
  return light;
}
