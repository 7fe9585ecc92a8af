#include "cut/cut_seen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"

/* Factors of the errors that the kernel's expansion to second order makes, measured to be enough
 * on smooth, rough and cut lamps. Relative to a node's light:
 * - its third and fourth order, in powers of the node's reach over its distance: odd orders nearly
 *   cancel over a node, unless the window's edge cuts it;
 * - its mixed second order, in units of the product of the reaches: it cancels for radiance that
 *   is the same all over the node. */
static const double third_order = 0.5, cut_third_order = 8, fourth_order = 0.3;
static const double mixed_order = 0.16, cut_mixed_order = 0.6;

/* Relative to the difference of the views from the node: of any part of it, where it is seen wide;
 * of the second moments, where it is seen narrow, by the kernel's second order and by its slope
 * times the width. */
static const double part_order = 1, second_order = 2, first_order = 2;

/* From this square of a node's reach over its distance on, the kernel at its center says nothing
 * of its light: it may bring all that there is. */
static const double steep = 0.25;

void cut_seen_free(struct cut_seen *nodes) {
  free(nodes->spots);
  free(nodes->taps);
  *nodes = (struct cut_seen){0};
}

bool cut_seen_begin(const struct cut_tree *tree, const struct seen_page *seen,
                    struct cut_seen *nodes) {
  const struct light_axis *axes = seen->page->axes;
  const double *n = seen->kernel.normal;
  size_t count = 0;
  for (int level = 0; level < tree->levels; ++level) {
    count += (size_t)tree->axes[0].count[level] + (size_t)tree->axes[1].count[level];
    nodes->level[level].spots[0] = NULL;
  }
  if (count > nodes->room) {
    cut_seen_free(nodes);
    nodes->spots = malloc(count * sizeof *nodes->spots);
    nodes->taps = malloc(count * sizeof *nodes->taps);
    if (!nodes->spots || !nodes->taps) return false;
    nodes->room = count;
  }
  nodes->tree = tree;
  nodes->seen = seen;
  nodes->taps_used = 0;
  nodes->per_height = 1 / seen->height;
  nodes->w = nodes->per_height - axes[0].kappa;
  nodes->tilt = sqrt(n[0] * n[0] + n[1] * n[1]);
  for (int axis = 0; axis < 2; ++axis) nodes->rate[axis] = -nodes->w / axes[axis].far_step;
  return true;
}

/* At most one st sample is within a node that is seen narrow: `reach` to each side. */
static void set_line(struct cut_spot *spot, double reach, double per_reach, int far_count) {
  spot->line = spot->cell + (spot->place - spot->cell > 0.5 && spot->cell < far_count - 1);
  double off = fabs(spot->place - spot->line);
  spot->per_curvature = off < reach ? reach - off * off * per_reach : 0;
}

static void set_spots(const struct cut_seen *nodes, int level, int axis, struct cut_spot *spot) {
  const struct light_axis *along = &nodes->seen->page->axes[axis];
  const struct cut_axis *tree = &nodes->tree->axes[axis];
  const double q = nodes->seen->foot[axis], most = along->far_count - 0.5;
  const double kappa = along->kappa, shift = -along->far_low;
  const double per_step = 1 / along->far_step, speed = fabs(nodes->rate[axis]);
  const double per_speed = 1 / speed;
  const struct cut_interval *interval = tree->level[level];
  for (int k = 0; k < tree->count[level]; ++k, ++spot, ++interval) {
    spot->slope = (interval->center - q) * nodes->per_height;
    spot->place = (shift + (kappa * interval->center - spot->slope)) * per_step - 0.5;
    spot->size = interval->moment[0] * nodes->per_height;
    double reach = speed * interval->half, low = spot->place - reach, high = spot->place + reach;
    spot->seen = high > -0.5 && low < most;
    spot->whole = low >= -0.5 && high <= most;
    spot->cell = !(spot->place > 0)                   ? 0
                 : spot->place < along->far_count - 1 ? (int)spot->place
                                                      : along->far_count - 1;
    set_line(spot, reach, per_speed * interval->per_half, along->far_count);
    spot->taps = NULL;
  }
}

void cut_seen_prepare(struct cut_seen *nodes, int number) {
  struct cut_seen_level *level = &nodes->level[number];
  struct cut_spot *spots = nodes->spots;
  const struct cut_axis *axes = nodes->tree->axes;
  double spread = 0, width = cut_narrowest;
  if (level->spots[0]) return;
  for (int k = 0; k < number; ++k) spots += axes[0].count[k] + axes[1].count[k];
  level->samples = 1;
  for (int axis = 0; axis < 2; ++axis) {
    double wide = axes[axis].widest[number] * fabs(nodes->w);
    if (wide > spread) spread = wide;
    level->samples *= 2 + wide;
    level->reach[axis] = axes[axis].reach[number] * nodes->per_height;
    level->spots[axis] = spots;
    set_spots(nodes, number, axis, spots);
    spots += axes[axis].count[number];
  }
  level->wide = !(spread <= cut_widest);
  level->narrow = spread <= 1;
  level->across = spread / 2;
  level->spread = 0;
  for (; spread > 2 * width && level->spread < CUT_SPREADS - 2; width *= 2) ++level->spread;
}

/* The larger of the errors that were measured at widths on both sides of the wanted: between
 * them it can pass through 0. */
static double spread_error(const struct cut_seen *nodes, const struct cut_seen_level *level,
                           const struct cut_estimate *estimate) {
  const uint8_t *code = estimate->error[nodes->w < 0] + level->spread;
  return (double)nodes->tree->error[code[0] > code[1] ? code[0] : code[1]];
}

static double line_error(const struct cut_tree *tree, int level, const int at[2],
                         const struct cut_spot *const spot[2]) {
  const struct cut_estimate *estimates = cut_estimates(tree, level, at);
  const int width = tree->page->axes[0].far_count;
  double error = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const struct cut_spot *across = spot[1 - axis];
    const int step = axis ? 1 : width;
    const struct cut_estimate *at_line = estimates + spot[axis]->line * (axis ? width : 1);
    if (!(spot[axis]->per_curvature > 0)) continue;
    int code = at_line[across->cell * step].line[axis];
    /* Where it crosses a line of the other axis too, it is in the cells on both sides of that. */
    for (int side = across->line - 1; across->per_curvature > 0 && side <= across->line; ++side)
      if (side >= 0 && at_line[side * step].line[axis] > code)
        code = at_line[side * step].line[axis];
    error += spot[axis]->per_curvature * (double)tree->error[code];
  }
  return error;
}

static double largest_of(const float *rgb) {
  float most = rgb[0] > rgb[1] ? rgb[0] : rgb[1];
  return (double)(most > rgb[2] ? most : rgb[2]);
}

bool cut_seen_estimate(const struct cut_seen *nodes, int number, const int at[2],
                       struct cut_node *node) {
  const struct cut_tree *tree = nodes->tree;
  const struct cut_seen_level *level = &nodes->level[number];
  const struct cut_spot *const spot[2] = {&level->spots[0][at[0]], &level->spots[1][at[1]]};
  if (!spot[0]->seen || !spot[1]->seen) return false;
  const struct kernel *kernel = &nodes->seen->kernel;
  const bool whole = spot[0]->whole && spot[1]->whole;
  const double x = spot[0]->slope, y = spot[1]->slope, square = 1 + x * x + y * y;
  const double g = kernel_height(kernel, x, y), per = 1 / (g * square);
  const double per_square = per * g, per_g = per * square;
  const double value = g * per_square * per_square * spot[0]->size * spot[1]->size;
  const double reach = simd_max(level->reach[0], level->reach[1]), root = sqrt(square);
  const double flat = reach * reach * per_square, narrow = reach * root * per_square;
  const double tilt = 1 + nodes->tilt * root * per_g;
  const double mixed =
      8 * x * y * per_square * per_square - kernel->normal[0] * kernel->normal[1] * per_g * per_g;
  double part = 0;
  *node = (struct cut_node){.level = number, .at = {at[0], at[1]}};
  node->curvature_per_light =
      flat * ((whole ? third_order : cut_third_order) * narrow * tilt + fourth_order * flat) +
      (whole ? mixed_order : cut_mixed_order) * fabs(mixed) * level->reach[0] * level->reach[1];
  if (number == tree->levels - 1) {
    node->light =
        value * largest_of(cut_view(tree, at) + seen_page_offset(nodes->seen, 1, 0, spot[1]->cell) +
                           seen_page_offset(nodes->seen, 0, 0, spot[0]->cell));
  } else {
    const struct cut_estimate *estimate =
        cut_estimates(tree, number, at) +
        (size_t)spot[1]->cell * (size_t)tree->page->axes[0].far_count + (size_t)spot[0]->cell;
    double edge = whole ? 0 : (double)tree->error[estimate->edge];
    if (level->narrow)
      part = (double)tree->error[estimate->second] *
             (second_order * flat + first_order * narrow * level->across) * tilt;
    else
      part = (double)tree->error[estimate->part] * part_order * flat * tilt;
    node->light = value * cut_mean(estimate);
    double spread =
        level->narrow ? line_error(tree, number, at, spot) : spread_error(nodes, level, estimate);
    node->spread = value * simd_max(spread, edge);
  }
  node->curvature = fabs(node->light) * node->curvature_per_light + value * part;
  if (flat > steep) node->curvature += tree->hemisphere;
  return true;
}

/* ---- The light of a node ---- */

/* The kernel's relative derivatives along an axis at a node's center, the second one halved. */
struct derivatives {
  double first, second;
};

/* Returns the kernel there. */
static double expand_kernel(const struct kernel *kernel, const double at[2],
                            struct derivatives along[2]) {
  const double g = kernel_height(kernel, at[0], at[1]);
  const double square = 1 + at[0] * at[0] + at[1] * at[1], per = 1 / (g * square);
  const double per_g = per * square, per_square = per * g;
  for (int axis = 0; axis < 2; ++axis) {
    const double n = kernel->normal[axis] * per_g, p = at[axis] * per_square;
    along[axis] = (struct derivatives){n - 4 * p, -4 * n * p - 2 * per_square + 12 * p * p};
  }
  return g * per_square * per_square;
}

static const struct cut_taps *find_taps(struct cut_seen *nodes, int level, int axis, int at) {
  struct cut_spot *spot = &nodes->level[level].spots[axis][at];
  if (spot->taps) return spot->taps;
  const struct cut_sight sight = {.place = spot->place,
                                  .rate = nodes->rate[axis],
                                  .scale = nodes->per_height,
                                  .clipped = !spot->whole};
  spot->taps = &nodes->taps[nodes->taps_used++];
  if (!cut_taps_find(&nodes->tree->axes[axis].level[level][at], &sight,
                     nodes->seen->page->axes[axis].far_count, spot->taps))
    spot->taps->count = -1;
  return spot->taps;
}

/* What the st samples weigh along one axis: in M, and in the slope of this axis. */
struct factors {
  int first, count;
  float mean[CUT_TAPS], slope[CUT_TAPS];
};

static bool find_factors(struct cut_seen *nodes, const struct cut_node *node, int axis,
                         const struct derivatives *kernel, struct factors *factors) {
  const struct cut_taps *taps = find_taps(nodes, node->level, axis, node->at[axis]);
  if (taps->count < 0) return false;
  const double half =
      nodes->per_height * nodes->tree->axes[axis].level[node->level][node->at[axis]].half;
  const float first = (float)(kernel->first * half), second = (float)(kernel->second * half * half);
  factors->first = taps->first;
  factors->count = taps->count;
  for (int k = 0; k < taps->count; k += 4) {
    simd_float4 m[CUT_MOMENTS];
    for (int power = 0; power < CUT_MOMENTS; ++power)
      m[power] = SIMD_LOAD(simd_floats4, taps->moment[power] + k);
    simd_float4 mean = m[0] + m[1] * first + m[2] * second;
    simd_float4 slope = m[1] + m[2] * first + m[3] * second;
    memcpy(factors->mean + k, &mean, sizeof mean);
    memcpy(factors->slope + k, &slope, sizeof slope);
  }
  return true;
}

/* M and V side by side, and U and W: sums of mean and slope along v at once. */
SIMD_INLINE void node_light_body(const float *image, size_t row, const struct factors *u,
                                 const struct factors *v, float light[4]) {
  const float *from = image + row * (size_t)v->first + (size_t)(CUT_FLOATS * u->first);
  simd_float8 sum = {0};
  for (int l = 0; l < v->count; ++l, from += row) {
    const float *texel = from, mean = v->mean[l], slope = v->slope[l];
    simd_float8 both = {0};
    for (int k = 0; k < u->count; ++k, texel += CUT_FLOATS)
      both += SIMD_LOAD(simd_floats8, texel) * u->mean[k] +
              SIMD_LOAD(simd_floats8, texel + 6) * u->slope[k];
    sum += both * (simd_float8){mean, mean, mean, slope, slope, slope};
  }
  for (int c = 0; c < 3; ++c) light[c] = sum[c] + sum[3 + c];
}

SIMD_DISPATCH(node_light,
              (const float *image, size_t row, const struct factors *u, const struct factors *v,
               float light[4]),
              (image, row, u, v, light))

static simd_float4 view_light(const float *image, size_t row, const struct factors *u,
                              const struct factors *v) {
  const float *from = image + row * (size_t)v->first + (size_t)(3 * u->first);
  simd_float4 sum = {0};
  for (int l = 0; l < v->count; ++l, from += row) {
    simd_float4 mean = {0};
    for (int k = 0; k < u->count; ++k) mean += SIMD_LOAD(simd_floats4, from + 3 * k) * u->mean[k];
    sum += mean * v->mean[l];
  }
  return sum;
}

bool cut_seen_light(struct cut_seen *nodes, const struct cut_node *node, double rgb[3],
                    double *error) {
  const struct cut_tree *tree = nodes->tree;
  const struct cut_seen_level *level = &nodes->level[node->level];
  const double at[2] = {level->spots[0][node->at[0]].slope, level->spots[1][node->at[1]].slope};
  struct derivatives kernel[2];
  struct factors factors[2];
  double value = expand_kernel(&nodes->seen->kernel, at, kernel), most = 0;
  for (int axis = 0; axis < 2; ++axis)
    if (!find_factors(nodes, node, axis, &kernel[axis], &factors[axis])) return false;
  float light[4];
  if (node->level == tree->levels - 1) {
    simd_float4 sum =
        view_light(cut_view(tree, node->at), 3 * (size_t)slab_width(&tree->page->slab), &factors[0],
                   &factors[1]);
    memcpy(light, &sum, sizeof light);
  } else {
    node_light(cut_images(tree, node->level, node->at),
               (size_t)(CUT_FLOATS * tree->page->axes[0].far_count), &factors[0], &factors[1],
               light);
  }
  for (int c = 0; c < 3; ++c) {
    double more = value * (double)light[c];
    rgb[c] += more;
    most = simd_max(most, fabs(more));
  }
  if (most > fabs(node->light)) *error += node->curvature_per_light * (most - fabs(node->light));
  return true;
}
