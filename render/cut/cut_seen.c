#include "cut/cut_seen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void cut_seen_free(struct cut_seen *nodes) {
  free(nodes->spots);
  free(nodes->taps);
  *nodes = (struct cut_seen){0};
}

bool cut_seen_begin(const struct cut_tree *tree, const struct seen_page *seen,
                    struct cut_seen *nodes) {
  const struct light_axis *axes = seen->page->axes;
  const double *n = seen->kernel.normal;
  if (tree->fours > nodes->room) {
    const size_t fours = (size_t)tree->fours;
    cut_seen_free(nodes);
    nodes->spots = malloc(fours * sizeof *nodes->spots);
    nodes->taps = malloc(4 * fours * sizeof *nodes->taps);
    if (!nodes->spots || !nodes->taps) return false;
    nodes->room = tree->fours;
  }
  nodes->tree = tree;
  nodes->seen = seen;
  nodes->prepared = nodes->fours = 0;
  nodes->per_height = 1 / seen->height;
  nodes->w = nodes->per_height - axes[0].kappa;
  nodes->tilt = sqrt(n[0] * n[0] + n[1] * n[1]);
  nodes->slant = n[0] * n[1];
  for (int axis = 0; axis < 2; ++axis) {
    nodes->rate[axis] = -nodes->w / axes[axis].far_step;
    nodes->speed[axis] = fabs(nodes->rate[axis]);
    nodes->per_speed[axis] = 1 / nodes->speed[axis];
  }
  return true;
}

SIMD_INLINE void set_spots_body(const struct cut_seen *nodes, int number, int axis) {
  const struct cut_axis *tree = &nodes->tree->axes[axis];
  const struct cut_seen_level *level = &nodes->level[number];
  const struct cut_view view = {.foot = SIMD_ALL(nodes->seen->foot[axis]),
                                .per_height = SIMD_ALL(nodes->per_height),
                                .speed = SIMD_ALL(nodes->speed[axis]),
                                .per_speed = SIMD_ALL(nodes->per_speed[axis])};
  for (int k = 0; 4 * k < tree->count[number]; ++k) {
    cut_four_see(&nodes->seen->page->axes[axis], tree->per_step, &tree->fours[number][k], &view,
                 &level->spots[axis][k]);
    for (int lane = 0; lane < 4; ++lane) level->taps[axis][4 * k + lane].count = -1;
  }
}

SIMD_DISPATCH(set_spots, (const struct cut_seen *nodes, int number, int axis),
              (nodes, number, axis))

void cut_seen_prepare(struct cut_seen *nodes, int number) {
  struct cut_seen_level *level = &nodes->level[number];
  const struct cut_axis *axes = nodes->tree->axes;
  double widest = 0;
  if (number < nodes->prepared) return;
  nodes->prepared = number + 1;
  level->samples = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double wide = axes[axis].widest[number] * fabs(nodes->w);
    widest = simd_max(wide, widest);
    level->samples *= 2 + wide;
    level->reach[axis] = axes[axis].reach[number] * nodes->per_height;
    level->spots[axis] = nodes->spots + nodes->fours;
    level->taps[axis] = nodes->taps + 4 * nodes->fours;
    nodes->fours += (axes[axis].count[number] + 3) / 4;
    set_spots(nodes, number, axis);
  }
  level->width = cut_width_of(widest, nodes->w);
}

/* The spots of four nodes, one after the other. */
#define FOUR(type, axis, field)                                                                    \
  ((type){spots[axis][0]->field[lane[axis][0]], spots[axis][1]->field[lane[axis][1]],              \
          spots[axis][2]->field[lane[axis][2]], spots[axis][3]->field[lane[axis][3]]})

SIMD_INLINE void weigh_body(const struct cut_seen *seen, const struct cut_seen_level *level,
                            const struct cut_spots *const spots[2][4], const int lane[2][4],
                            struct cut_worth *worth) {
  const double *n = seen->seen->kernel.normal;
  const struct cut_nodes nodes = {
      .slope = {FOUR(simd_double4, 0, slope), FOUR(simd_double4, 1, slope)},
      .size = {FOUR(simd_double4, 0, size), FOUR(simd_double4, 1, size)},
      .normal = {SIMD_ALL(n[0]), SIMD_ALL(n[1]), SIMD_ALL(n[2])},
      .tilt = SIMD_ALL(seen->tilt),
      .slant = SIMD_ALL(seen->slant),
      .reach = {SIMD_ALL(level->reach[0]), SIMD_ALL(level->reach[1])},
      .across = SIMD_ALL(level->width.across),
      .whole = FOUR(simd_long4, 0, whole) & FOUR(simd_long4, 1, whole)};
  cut_four_weigh(&nodes, worth);
}

SIMD_DISPATCH(weigh,
              (const struct cut_seen *seen, const struct cut_seen_level *level,
               const struct cut_spots *const spots[2][4], const int lane[2][4],
               struct cut_worth *worth),
              (seen, level, spots, lane, worth))

int cut_seen_estimate(const struct cut_seen *seen, int number, const int (*at)[2], int count,
                      struct cut_node *const *nodes) {
  const struct cut_seen_level *level = &seen->level[number];
  const struct cut_spots *spots[2][4];
  struct cut_worth worth;
  int lane[2][4], used = 0;
  for (int k = 0; k < 4; ++k)
    for (int axis = 0; axis < 2; ++axis) {
      const int place = at[k < count ? k : 0][axis];
      spots[axis][k] = &level->spots[axis][place >> 2];
      lane[axis][k] = place & 3;
    }
  weigh(seen, level, spots, lane, &worth);
  for (int k = 0; k < count; ++k) {
    const struct cut_spots *const of[2] = {spots[0][k], spots[1][k]};
    const int in[2] = {lane[0][k], lane[1][k]};
    struct cut_node *node = nodes[used];
    if (!(of[0]->seen[in[0]] && of[1]->seen[in[1]])) continue;
    node->level = number;
    memcpy(node->at, at[k], sizeof node->at);
    cut_node_estimate(seen->tree, &level->width, of, in, &worth, k, node);
    ++used;
  }
  return used;
}

static bool find_taps(const struct cut_seen *nodes, int number, int axis, int at) {
  const struct cut_seen_level *level = &nodes->level[number];
  const struct cut_spots *spots = &level->spots[axis][at >> 2];
  struct cut_taps *taps = &level->taps[axis][at];
  if (taps->count >= 0) return true;
  const struct cut_sight sight = {.place = spots->place[at & 3],
                                  .rate = nodes->rate[axis],
                                  .scale = nodes->per_height,
                                  .clipped = !spots->whole[at & 3]};
  return cut_taps_find(&nodes->tree->axes[axis].level[number][at], &sight,
                       nodes->seen->page->axes[axis].far_count, taps);
}

bool cut_seen_light(struct cut_seen *nodes, const struct cut_node *node, double rgb[3],
                    double *error) {
  const struct cut_seen_level *level = &nodes->level[node->level];
  const int *at = node->at, lane[2] = {at[0] & 3, at[1] & 3};
  for (int axis = 0; axis < 2; ++axis)
    if (!find_taps(nodes, node->level, axis, at[axis])) return false;
  const struct cut_spots *const spots[2] = {&level->spots[0][at[0] >> 2],
                                            &level->spots[1][at[1] >> 2]};
  const struct cut_taps *const taps[2] = {&level->taps[0][at[0]], &level->taps[1][at[1]]};
  cut_node_light(nodes->tree, node, nodes->seen->kernel.normal, spots, lane, taps, rgb, error);
  return true;
}
