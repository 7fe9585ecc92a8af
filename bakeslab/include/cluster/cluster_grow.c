/* cluster_grow.c - orthogonal matching pursuit. */
#include "include/cluster/cluster_grow.h"

#include <stdlib.h>
#include <string.h>

#include "include/cluster/cluster_colours.h"

struct growth {
  int rows, candidate_count;
  double *tables;    /* candidates x rows; that of one that was taken is zero */
  double (*rest)[3]; /* of each row */
};

/* The candidate that takes most of what is left; -1 where none takes anything. */
static int best_candidate(const struct growth *g) {
  int best = -1;
  double most = 0;
  for (int k = 0; k < g->candidate_count; ++k) {
    const double *table = g->tables + (size_t)k * (size_t)g->rows;
    double size = 0, along[3] = {0}, gain = 0;
    for (int r = 0; r < g->rows; ++r) {
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
  size_t rows = (size_t)target->count + 1, tables = rows * (size_t)candidate_count;
  struct cluster_colours colours;
  double *room = calloc(tables + rows * (size_t)(wanted + 3), sizeof *room);
  if (!room) return result_no_memory(error);
  double *base = room + tables; /* rows x lights */
  colours.rest = (double(*)[3])(base + rows * (size_t)wanted);
  struct growth g = {
      .rows = (int)rows, .candidate_count = candidate_count, .tables = room, .rest = colours.rest};
  for (int k = 0; k < candidate_count; ++k)
    cluster_rows(target, &candidates[k], room + (size_t)k * rows, 1);
  while (*count < wanted) {
    for (int k = 0; k < *count; ++k) cluster_rows(target, &lights[k], base + k, *count);
    cluster_solve(target, *count, base, &colours);
    int best = best_candidate(&g);
    if (best < 0) break;
    memset(room + (size_t)best * rows, 0, rows * sizeof *room);
    lights[(*count)++] = candidates[best];
  }
  free(room);
  return RESULT_OK;
}
