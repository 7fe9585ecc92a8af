#include "include/cluster/cluster_colours.h"

#include <string.h>

#include "include/cluster/nnls.h"

void cluster_rows(const struct cluster_target *target, const struct cluster_light *light,
                  double *table, int step) {
  for (int r = 0; r < target->count; ++r, table += step)
    *table = target->weight[r] * cluster_irradiance(light, target->at[r]);
  *table = target->weight[target->count] * cluster_flux(light);
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

double cluster_solve(const struct cluster_target *target, int lights, const double *base,
                     struct cluster_colours *colours) {
  int rows = target->count + 1;
  double rgb[CLUSTER_MOST_LIGHTS], squares = 0;
  make_gram(base, rows, lights, colours->gram);
  for (int c = 0; c < 3; ++c) {
    memset(colours->side, 0, sizeof colours->side);
    for (int r = 0; r < rows; ++r) {
      double value = target->weight[r] * target->rgb[r][c];
      for (int i = 0; i < lights; ++i) colours->side[i] += value * base[r * lights + i];
    }
    nnls_solve(lights, colours->gram, colours->side, rgb, colours->scratch);
    for (int i = 0; i < lights; ++i) colours->rgb[i][c] = rgb[i];
  }
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < 3; ++c) {
      double rest = target->weight[r] * target->rgb[r][c];
      for (int i = 0; i < lights; ++i) rest -= colours->rgb[i][c] * base[r * lights + i];
      colours->rest[r][c] = rest;
      squares += rest * rest;
    }
  return squares;
}
