#include "bake/bake_planes.h"

#include <math.h>
#include <stdlib.h>

/* Positions and directions along an axis; how much wider the wide rectangles are, and half windows
 * in slope. */
enum {
  POSITIONS = 8,
  NEAR_DIRECTIONS = 28,
  DIRECTIONS = 16,
  WIDE_POSITIONS = 6,
  WIDER = 3,
  MOST_SIDES = 6
};
static const double REACH = 8, SIDE_REACH = 3;

/* Makes a page's window so wide that its half is at least `reach`, and twice as wide at least. */
static void widen_window(struct slab *slab, double reach, int directions) {
  for (int k = 0; k < 4; k += 2) {
    double *window = slab->st_window + k;
    double middle = (window[0] + window[1]) / 2, half = window[1] - window[0];
    window[0] = middle - fmax(half, reach);
    window[1] = middle + fmax(half, reach);
  }
  for (int k = 0; k < 2; ++k) {
    slab->samples[SLAB_U + k] = POSITIONS;
    slab->samples[SLAB_S + k] = directions;
  }
}

/* And its rectangle, to look beside it. */
static void widen_rectangle(struct slab *slab) {
  for (int c = 0; c < 3; ++c) {
    slab->u[c] *= WIDER;
    slab->v[c] *= WIDER;
  }
  slab->samples[SLAB_U] = slab->samples[SLAB_V] = WIDE_POSITIONS;
}

/* The box around all pages, in lamp space; false where they do not all face away from its middle:
 * then it does not hold the lamp, and its sides may lie inside that. */
static bool find_box(const struct bake_planes *planes, double box[2][3]) {
  double most = 0;
  bool outwards = true;
  for (int c = 0; c < 3; ++c) {
    box[0][c] = INFINITY;
    box[1][c] = -INFINITY;
    for (int n = 0; n < planes->count; ++n) {
      const struct slab *page = &planes->pages[n];
      double half = (fabs(page->u[c]) + fabs(page->v[c])) / 2;
      box[0][c] = fmin(box[0][c], page->center[c] - half);
      box[1][c] = fmax(box[1][c], page->center[c] + half);
    }
    most = fmax(most, box[1][c] - box[0][c]);
  }
  for (int n = 0; n < planes->count; ++n) {
    const struct slab *page = &planes->pages[n];
    double off = 0;
    for (int c = 0; c < 3; ++c)
      off += page->normal[c] * (page->center[c] - (box[0][c] + box[1][c]) / 2);
    outwards &= off > 0.025 * most;
  }
  return outwards;
}

/* The sides of the box that have no page in their plane, half the box further out and twice as
 * wide: a wall may lie on the side, and what is inside it does not leave. */
static void add_sides(struct bake_planes *planes) {
  double box[2][3];
  if (!find_box(planes, box)) return;
  for (int side = 0; side < MOST_SIDES; ++side) {
    int axis = side / 2, next = (axis + 1) % 3, last = (axis + 2) % 3;
    double at = box[side % 2][axis], close = 0.01 * (box[1][axis] - box[0][axis]);
    bool taken = false;
    for (int n = 0; n < planes->count; ++n)
      taken |= fabs(planes->pages[n].normal[axis]) > 0.999 &&
               fabs(planes->pages[n].center[axis] - at) < close;
    if (taken) continue;
    struct slab *plane = &planes->baked[PLANES_SIDE * planes->count + planes->sides];
    *plane = planes->pages[0];
    for (int c = 0; c < 3; ++c) {
      plane->center[c] =
          c == axis ? at + (side % 2 ? 50 : -50) * close : (box[0][c] + box[1][c]) / 2;
      plane->normal[c] = c == axis ? (side % 2 ? 1 : -1) : 0;
      plane->u[c] = c == next ? 2 * (box[1][c] - box[0][c]) : 0;
      plane->v[c] = c == last ? 2 * (box[1][c] - box[0][c]) : 0;
    }
    plane->st_distance = INFINITY;
    for (int k = 0; k < 4; ++k) plane->st_window[k] = 0;
    widen_window(plane, SIDE_REACH, NEAR_DIRECTIONS);
    ++planes->sides;
  }
}

enum result bake_planes_make(const struct bake_work *work, struct bake_planes *planes,
                             struct error *error) {
  *planes = (struct bake_planes){.pages = work->slabs, .count = work->lamp->slab_count};
  size_t most = PLANES_SIDE * (size_t)planes->count + MOST_SIDES;
  planes->baked = malloc(most * sizeof *planes->baked);
  planes->open = malloc(most * sizeof *planes->open);
  if (!planes->baked || !planes->open) return result_no_memory(error);
  for (int n = 0; n < PLANES_SIDE * planes->count; ++n) {
    struct slab *plane = &planes->baked[n];
    int kind = n / planes->count;
    *plane = planes->pages[n % planes->count];
    widen_window(plane, kind == PLANES_NEAR ? 0 : REACH,
                 kind == PLANES_NEAR ? NEAR_DIRECTIONS : DIRECTIONS);
    if (kind == PLANES_WIDE) widen_rectangle(plane);
  }
  add_sides(planes);
  for (int n = 0; n < PLANES_SIDE * planes->count + planes->sides; ++n) {
    planes->open[n] = planes->baked[n];
    for (int k = 0; k < 4; ++k) planes->open[n].st_window[k] = k % 2 ? INFINITY : -INFINITY;
  }
  return RESULT_OK;
}

void bake_planes_free(struct bake_planes *planes) {
  free(planes->baked);
  free(planes->open);
}
