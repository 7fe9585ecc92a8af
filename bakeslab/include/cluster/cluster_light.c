/* cluster_light.c - what one light does, and the colours that suit several best. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "include/cluster/cluster.h"
#include "include/cluster/nnls.h"
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
  double sum = 0,
         size = sqrt(1 + light->axis[0] * light->axis[0] + light->axis[1] * light->axis[1]);
  int nu = light->size[0], nv = light->size[1];
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      double p = (i + 0.5) / nu - 0.5, q = (j + 0.5) / nv - 0.5;
      double x = at[0] - light->center[0] - p * light->edge[0][0] - q * light->edge[1][0];
      double y = at[1] - light->center[1] - p * light->edge[0][1] - q * light->edge[1][1];
      double r2 = x * x + y * y + at[2] * at[2], r = sqrt(r2);
      double cosine = (x * light->axis[0] + y * light->axis[1] + at[2]) / (r * size);
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

int cluster_drop_dark(struct cluster_light *lights, int count) {
  int kept = 0;
  for (int k = 0; k < count; ++k)
    if (lights[k].rgb[0] + lights[k].rgb[1] + lights[k].rgb[2] > 0) lights[kept++] = lights[k];
  return kept;
}

void cluster_rows(const struct cluster_target *target, const struct cluster_light *light,
                  double *table, size_t step) {
  for (int r = 0; r < target->count; ++r)
    table[(size_t)r * step] = target->weight[r] * cluster_irradiance(light, target->at[r]);
  table[(size_t)target->count * step] = target->weight[target->count] * cluster_flux(light);
}

bool cluster_system_make(int lights, int rows, struct cluster_system *system) {
  size_t n = (size_t)lights;
  system->lights = lights;
  system->rgb = calloc(n, sizeof *system->rgb);
  system->rest = calloc((size_t)rows, sizeof *system->rest);
  system->gram = calloc(n * n, sizeof *system->gram);
  system->side = calloc(2 * n, sizeof *system->side);
  system->scratch = calloc(n * (n + 4), sizeof *system->scratch);
  return system->rgb && system->rest && system->gram && system->side && system->scratch;
}

void cluster_system_free(struct cluster_system *system) {
  free(system->rgb);
  free(system->rest);
  free(system->gram);
  free(system->side);
  free(system->scratch);
  memset(system, 0, sizeof *system);
}

static void make_gram(const double *base, int rows, int n, double *gram) {
  memset(gram, 0, (size_t)n * (size_t)n * sizeof *gram);
  for (int r = 0; r < rows; ++r) {
    const double *row = base + (size_t)r * (size_t)n;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i && row[i] > 0; ++j) gram[i * n + j] += row[i] * row[j];
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j) gram[j * n + i] = gram[i * n + j];
}

double cluster_solve(const struct cluster_target *target, struct cluster_system *system,
                     const double *base) {
  int n = system->lights, rows = target->count + 1;
  double *colours = system->side + n, squares = 0;
  make_gram(base, rows, n, system->gram);
  for (int c = 0; c < 3; ++c) {
    memset(system->side, 0, (size_t)n * sizeof *system->side);
    for (int r = 0; r < rows; ++r) {
      double value = target->weight[r] * target->rgb[r][c];
      for (int i = 0; i < n; ++i)
        system->side[i] += value * base[(size_t)r * (size_t)n + (size_t)i];
    }
    nnls_solve(n, system->gram, system->side, colours, system->scratch);
    for (int i = 0; i < n; ++i) system->rgb[i][c] = colours[i];
  }
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < 3; ++c) {
      double rest = target->weight[r] * target->rgb[r][c];
      for (int i = 0; i < n; ++i)
        rest -= system->rgb[i][c] * base[(size_t)r * (size_t)n + (size_t)i];
      system->rest[r][c] = rest;
      squares += rest * rest;
    }
  return squares;
}
