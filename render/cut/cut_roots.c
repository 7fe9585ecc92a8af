/* cut_roots.c - the cut of receivers so far away that it is the root alone: of four of them at
 * once, since for each there are few numbers to find. They are those that cut.c finds, to the last
 * bit. */
#include <math.h>

#include "cut/cut.h"
#include "cut/cut_allowed.h"
#include "cut/cut_node.h"

struct roots {
  simd_double4 per_height, w, rate[2], samples; /* cut_seen.h; the root's width */
  struct cut_spots spots[2];
  struct cut_worth worth;
  simd_long4 taken;
};

/* One field of all receivers. */
#define ALL(field) ((simd_double4){seen[0].field, seen[1].field, seen[2].field, seen[3].field})

/* Which of them see all of the aperture above their tangent plane, and any of it in the window. */
SIMD_INLINE void find_taken(const struct cut_tree *tree, const simd_double4 normal[3],
                            const simd_double4 foot[2], struct roots *out) {
  simd_double4 near[2], far[2]; /* from the tangent plane */
  for (int axis = 0; axis < 2; ++axis) {
    const struct light_axis *along = &tree->page->axes[axis];
    const double across = along->kappa * along->half;
    const simd_double4 low = (-along->half - foot[axis]) * out->per_height;
    const simd_double4 high = (along->half - foot[axis]) * out->per_height;
    const simd_double4 first = -across - low, second = across - high, n = normal[axis];
    out->taken &= ~((first < along->far_low) & (second < along->far_low));
    out->taken &= ~((first > along->far_high) & (second > along->far_high));
    near[axis] = n * SIMD_CHOOSE(n > 0, low, high);
    far[axis] = n * SIMD_CHOOSE(n > 0, high, low);
  }
  out->taken &= near[0] + near[1] - normal[2] > 0;
  out->taken &= far[0] + far[1] - normal[2] < INFINITY;
}

SIMD_INLINE void see_roots_body(const struct cut_tree *tree, const struct seen_page *seen,
                                struct roots *out) {
  const struct light_axis *axes = tree->page->axes;
  const simd_double4 foot[2] = {ALL(foot[0]) * tree->per_unit, ALL(foot[1]) * tree->per_unit};
  const simd_double4 n[3] = {ALL(kernel.normal[0]), ALL(kernel.normal[1]), ALL(kernel.normal[2])};
  const simd_double4 per_height = 1 / (ALL(height) * tree->per_unit);
  const simd_double4 w = per_height - axes[0].kappa, square = n[0] * n[0] + n[1] * n[1];
  struct cut_nodes nodes = {
      .normal = {n[0], n[1], n[2]}, .tilt = SIMD_ROOT(square), .slant = n[0] * n[1]};
  out->taken = (ALL(height) > 0) & (ALL(kernel.shininess) <= 0);
  out->per_height = per_height;
  out->w = w;
  find_taken(tree, n, foot, out);
  simd_double4 samples = {0};
  for (int axis = 0; axis < 2; ++axis) {
    const struct cut_axis *of = &tree->axes[axis];
    const struct cut_interval *root = of->level[0];
    const struct cut_four four = {.center = SIMD_ALL(root->center),
                                  .half = SIMD_ALL(root->half),
                                  .per_half = SIMD_ALL(root->per_half),
                                  .size = SIMD_ALL(root->moment[0])};
    const simd_double4 rate = -w / axes[axis].far_step, speed = SIMD_ABSOLUTE(rate);
    const simd_double4 wide = of->widest[0] * SIMD_ABSOLUTE(w);
    const struct cut_view view = {
        .foot = foot[axis], .per_height = per_height, .speed = speed, .per_speed = 1 / speed};
    cut_four_see(&axes[axis], of->per_step, &four, &view, &out->spots[axis]);
    out->rate[axis] = rate;
    samples = SIMD_CHOOSE(wide > samples, wide, samples);
    nodes.slope[axis] = out->spots[axis].slope;
    nodes.size[axis] = out->spots[axis].size;
    nodes.reach[axis] = of->reach[0] * per_height;
    out->taken &= out->spots[axis].seen;
  }
  nodes.whole = out->spots[0].whole & out->spots[1].whole;
  nodes.across = samples / 2;
  out->samples = samples;
  out->taken &= samples <= cut_widest;
  cut_four_weigh(&nodes, &out->worth);
}

SIMD_DISPATCH(see_roots,
              (const struct cut_tree *tree, const struct seen_page *seen, struct roots *out),
              (tree, seen, out))

static bool find_taps(const struct cut_tree *tree, const struct roots *roots, int k,
                      struct cut_taps taps[2]) {
  for (int axis = 0; axis < 2; ++axis) {
    const struct cut_spots *spots = &roots->spots[axis];
    const struct cut_sight sight = {.place = spots->place[k],
                                    .rate = roots->rate[axis][k],
                                    .scale = roots->per_height[k],
                                    .clipped = !spots->whole[k]};
    if (!cut_taps_find(tree->axes[axis].level[0], &sight, tree->page->axes[axis].far_count,
                       &taps[axis]))
      return false;
  }
  return true;
}

/* Steps 2 to 4 of cut.c for the k-th receiver. False: its cut needs more nodes. */
static bool sum_root(const struct cut_tree *tree, const struct roots *roots,
                     const struct seen_page *seen, double share, int k, struct cut_root *root) {
  const struct cut_spots *const spots[2] = {&roots->spots[0], &roots->spots[1]};
  const struct cut_width width = cut_width_of(roots->samples[k], roots->w[k]);
  const double least = cut_allowed_least(tree, roots->per_height[k]);
  const int lane[2] = {k, k};
  struct cut_node node = {.level = 0};
  struct cut_taps taps[2];
  double rgb[3] = {0}, most = least;
  cut_node_estimate(tree, &width, spots, lane, &roots->worth, k, &node);
  double error = cut_allowed_sum(node.curvature, node.spread, node.spread * node.spread);
  if (!(error <= share * simd_max(node.light, least)) || !find_taps(tree, roots, k, taps))
    return false;
  cut_node_light(tree, &node, seen[k].kernel.normal, spots, lane,
                 (const struct cut_taps *const[2]){&taps[0], &taps[1]}, rgb, &error);
  for (int c = 0; c < 3; ++c) {
    most = simd_max(rgb[c], most);
    root->irradiance[c] = simd_max(rgb[c], tree->least);
  }
  root->error = cut_rounding + (most > 0 ? error / most : 0);
  return error <= share * most;
}

void cut_roots(const struct cut_tree *tree, const struct seen_page seen[CUT_ROOTS], int count,
               double tolerance, struct cut_root roots[CUT_ROOTS]) {
  const double share = cut_allowed_share(tolerance);
  struct roots four;
  for (int k = 0; k < count; ++k) roots[k].done = false;
  if (count == 0 || !(share > 0) || tree->levels == 1) return;
  see_roots(tree, seen, &four);
  for (int k = 0; k < count; ++k)
    if (four.taken[k]) roots[k].done = sum_root(tree, &four, seen, share, k, &roots[k]);
}
