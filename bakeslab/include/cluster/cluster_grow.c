/* cluster_grow.c - orthogonal matching pursuit. */
#include "include/cluster/cluster_grow.h"

#include <stdbool.h>
#include <stdlib.h>

#include "include/cluster/cluster_colours.h"

struct growth {
  int rows, candidate_count;
  double *tables;    /* candidates x rows; owned, as all below */
  double *base;      /* rows x lights */
  double (*rest)[3]; /* of each row */
  bool *taken;       /* of the candidates */
};

static bool allocate(struct growth *g, int wanted) {
  size_t rows = (size_t)g->rows, candidates = (size_t)g->candidate_count;
  g->tables = calloc(rows * candidates, sizeof *g->tables);
  g->base = calloc(rows * (size_t)wanted, sizeof *g->base);
  g->taken = calloc(candidates, sizeof *g->taken);
  g->rest = calloc(rows, sizeof *g->rest);
  return g->tables && g->base && g->taken && g->rest;
}

/* The candidate that takes most of what is left; -1 where none takes anything. */
static int best_candidate(const struct growth *g) {
  int best = -1;
  double most = 0;
  for (int k = 0; k < g->candidate_count; ++k) {
    const double *table = g->tables + (size_t)k * (size_t)g->rows;
    double size = 0, along[3] = {0}, gain = 0;
    for (int r = 0; r < g->rows && !g->taken[k]; ++r) {
      size += table[r] * table[r];
      for (int c = 0; c < 3; ++c) along[c] += table[r] * g->rest[r][c];
    }
    for (int c = 0; c < 3; ++c) gain += along[c] > 0 ? along[c] * along[c] : 0;
    if (!(size > 0) || gain / size <= most) continue;
    most = gain / size;
    best = k;
  }
  return best;
}

enum result cluster_grow(const struct cluster_target *target,
                         const struct cluster_light *candidates, int candidate_count,
                         struct cluster_light *lights, int *count, int wanted,
                         struct error *error) {
  struct growth g = {.rows = target->count + 1, .candidate_count = candidate_count};
  struct cluster_colours colours;
  enum result result = RESULT_OK;
  if (!allocate(&g, wanted)) {
    result = result_no_memory(error);
    goto out;
  }
  for (int k = 0; k < candidate_count; ++k)
    cluster_rows(target, &candidates[k], g.tables + (size_t)k * (size_t)g.rows, 1);
  colours.rest = g.rest;
  while (*count < wanted) {
    for (int k = 0; k < *count; ++k) cluster_rows(target, &lights[k], g.base + k, *count);
    cluster_solve(target, *count, g.base, &colours);
    int best = best_candidate(&g);
    if (best < 0) break;
    g.taken[best] = true;
    lights[(*count)++] = candidates[best];
  }
out:
  free(g.tables);
  free(g.base);
  free(g.taken);
  free(g.rest);
  return result;
}
