/* rebin_levels.c
 *
 * 1. Pull: a coarse node is the weighted mean of the finer ones around it, by the weights 1 3 3 1
 *    along each axis that is halved (the paper's basis functions with nodes in the middles of
 *    cells, as a slab's samples are). Weights add up, but count at most 1, so that many rays in one
 *    place do not outweigh a few in the next.
 * 2. Push: what a finer node lacks of the weight 1 it takes from the coarser ones, linearly
 *    interpolated. */
#include "import/pictures/rebin_levels.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

size_t rebin_levels_nodes(const struct rebin_levels *levels, int level) {
  const int *size = levels->size[level];
  return (size_t)size[0] * (size_t)size[1] * (size_t)size[2] * (size_t)size[3];
}

/* The next coarser size; false where there is none. */
static bool halve(const int fine[SLAB_AXES], int coarse[SLAB_AXES]) {
  bool st = fine[SLAB_S] > 1 || fine[SLAB_T] > 1;
  bool smaller = false;
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    bool halved = (axis >= SLAB_S) == st && fine[axis] > 1;
    coarse[axis] = halved ? (fine[axis] + 1) / 2 : fine[axis];
    smaller = smaller || halved;
  }
  return smaller;
}

enum result rebin_levels_make(const int samples[SLAB_AXES], struct rebin_levels *levels,
                              struct error *error) {
  *levels = (struct rebin_levels){.count = 1};
  memcpy(levels->size[0], samples, sizeof levels->size[0]);
  while (levels->count < REBIN_MOST_LEVELS &&
         halve(levels->size[levels->count - 1], levels->size[levels->count]))
    ++levels->count;
  for (int k = 0; k < levels->count; ++k) {
    levels->node[k] = calloc(rebin_levels_nodes(levels, k), REBIN_NODE * sizeof(float));
    if (!levels->node[k]) return result_no_memory(error);
  }
  return RESULT_OK;
}

void rebin_levels_free(struct rebin_levels *levels) {
  for (int k = 0; k < levels->count; ++k) free(levels->node[k]);
  *levels = (struct rebin_levels){0};
}

/* The coarse nodes that a fine one lies between, and their weights: the nearer one's is 3/4. */
struct tap {
  int index[2];
  float weight[2];
};

static struct tap find_tap(int fine, int from, int to) {
  struct tap tap = {{fine, fine}, {1, 0}};
  if (from == to) return tap;
  int near = fine / 2, far = fine % 2 ? near + 1 : near - 1;
  if (far < 0 || far >= to) far = near;
  return (struct tap){{near, far}, {0.75f, 0.25f}};
}

/* The up to 16 coarse nodes around a fine one, as offsets in floats, and their weights. */
struct corners {
  int count;
  size_t offset[16];
  float weight[16];
};

static void find_corners(const int fine[SLAB_AXES], const int coarse[SLAB_AXES],
                         const int at[SLAB_AXES], struct corners *corners) {
  *corners = (struct corners){.count = 1, .weight = {1}};
  for (int axis = 0; axis < SLAB_AXES; ++axis) {
    struct tap tap = find_tap(at[axis], fine[axis], coarse[axis]);
    int taps = tap.weight[1] > 0 ? 2 : 1, count = corners->count;
    for (int c = taps * count - 1; c >= 0; --c) {
      size_t before = corners->offset[c % count] * (size_t)coarse[axis];
      float weight = corners->weight[c % count];
      corners->offset[c] = before + (size_t)tap.index[c / count];
      corners->weight[c] = weight * tap.weight[c / count];
    }
    corners->count = taps * count;
  }
  for (int c = 0; c < corners->count; ++c) corners->offset[c] *= REBIN_NODE;
}

/* A node's weight is at most 1. */
static void saturate(float *node, size_t count) {
  for (size_t n = 0; n < count; ++n, node += REBIN_NODE) {
    if (node[3] <= 1) continue;
    for (int c = 0; c < 3; ++c) node[c] /= node[3];
    node[3] = 1;
  }
}

typedef void visitor(float *fine, float *coarse, const struct corners *corners);

static void pull(float *fine, float *coarse, const struct corners *corners) {
  if (fine[3] == 0) return;
  for (int n = 0; n < corners->count; ++n)
    for (int c = 0; c < REBIN_NODE; ++c)
      coarse[corners->offset[n] + (size_t)c] += corners->weight[n] * fine[c];
}

static void push(float *fine, float *coarse, const struct corners *corners) {
  float lacks = 1 - fine[3];
  if (lacks == 0) return;
  for (int n = 0; n < corners->count; ++n)
    for (int c = 0; c < 3; ++c)
      fine[c] += lacks * corners->weight[n] * coarse[corners->offset[n] + (size_t)c];
}

static void for_each(struct rebin_levels *levels, int level, visitor *visit) {
  const int *fine = levels->size[level], *coarse = levels->size[level + 1];
  float *node = levels->node[level];
  int at[SLAB_AXES];
  for (at[0] = 0; at[0] < fine[0]; ++at[0])
    for (at[1] = 0; at[1] < fine[1]; ++at[1])
      for (at[2] = 0; at[2] < fine[2]; ++at[2])
        for (at[3] = 0; at[3] < fine[3]; ++at[3], node += REBIN_NODE) {
          struct corners corners;
          find_corners(fine, coarse, at, &corners);
          visit(node, levels->node[level + 1], &corners);
        }
}

void rebin_levels_fill(struct rebin_levels *levels) {
  saturate(levels->node[0], rebin_levels_nodes(levels, 0));
  for (int k = 0; k + 1 < levels->count; ++k) {
    size_t count = rebin_levels_nodes(levels, k + 1);
    memset(levels->node[k + 1], 0, count * REBIN_NODE * sizeof(float));
    for_each(levels, k, pull);
    saturate(levels->node[k + 1], count);
  }
  float *top = levels->node[levels->count - 1];
  for (int c = 0; c < 3 && top[3] > 0; ++c) top[c] /= top[3];
  for (int k = levels->count - 2; k >= 0; --k) for_each(levels, k, push);
}
