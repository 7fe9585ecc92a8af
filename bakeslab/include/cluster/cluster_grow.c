/* cluster_grow.c - more lights, where most is left to explain (orthogonal matching
 * pursuit). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "include/cluster/cluster.h"

struct growth {
  const struct cluster_target *target;
  int rows, wanted, candidate_count;
  double *tables; /* candidates x rows; owned, as all below */
  double *base;   /* rows x lights */
  bool *taken;
  struct cluster_system system;
};

static bool allocate(struct growth *g) {
  size_t rows = (size_t)g->rows;
  g->tables = calloc(rows * (size_t)g->candidate_count, sizeof *g->tables);
  g->base = calloc(rows * (size_t)g->wanted, sizeof *g->base);
  g->taken = calloc((size_t)g->candidate_count, sizeof *g->taken);
  return g->tables && g->base && g->taken && cluster_system_make(g->wanted, g->rows, &g->system);
}

static void release(struct growth *g) {
  free(g->tables);
  free(g->base);
  free(g->taken);
  cluster_system_free(&g->system);
}

/* Solves for the colours of the first `count` lights. */
static void solve(struct growth *g, const struct cluster_light *lights, int count) {
  for (int k = 0; k < count; ++k) cluster_rows(g->target, &lights[k], g->base + k, (size_t)count);
  g->system.lights = count;
  cluster_solve(g->target, &g->system, g->base);
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
      for (int c = 0; c < 3; ++c) along[c] += table[r] * g->system.rest[r][c];
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
  struct growth g = {.target = target,
                     .rows = target->count + 1,
                     .wanted = wanted,
                     .candidate_count = candidate_count};
  enum result result = RESULT_OK;
  if (allocate(&g)) {
    for (int k = 0; k < candidate_count; ++k)
      cluster_rows(target, &candidates[k], g.tables + (size_t)k * (size_t)g.rows, 1);
    while (*count < wanted) {
      solve(&g, lights, *count);
      int best = best_candidate(&g);
      if (best < 0) break;
      g.taken[best] = true;
      lights[(*count)++] = candidates[best];
    }
  } else {
    result = result_fail(error, RESULT_MEMORY, "out of memory");
  }
  release(&g);
  return result;
}
