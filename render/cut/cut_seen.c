/* cut_seen.c - see cut_seen.h. */
#include "cut/cut_seen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"

/* What the expansion of the kernel leaves out, relative to a node's light. Its third and fourth
 * order, in units of the node's reach over its distance: odd orders nearly cancel over a node,
 * unless the window's edge cuts it. Its mixed second order, in units of the product of the
 * reaches: it cancels for radiance that is the same all over the node. And what the kernel's
 * second order makes of views that differ from the node: of any part of it, where it is seen wide;
 * in a narrow view of their second moments, with the kernel's slope times the width too. Measured
 * to be enough on smooth, rough and cut lamps. */
static const double third_order = 0.5, cut_third_order = 8, fourth_order = 0.3;
static const double mixed_order = 0.16, cut_mixed_order = 0.6, part_order = 1;
static const double second_order = 2, first_order = 2;

/* From so much of a node's reach over its distance on, squared, the kernel in its center says
 * nothing of its light: it may bring all that there is. */
static const double steep = 0.25;

void cut_seen_free(struct cut_seen *seen) {
  free(seen->spots);
  free(seen->taps);
  *seen = (struct cut_seen){0};
}

bool cut_seen_begin(const struct cut_tree *tree, const struct seen_page *page,
                    struct cut_seen *made) {
  const struct light_axis *axes = page->page->axes;
  const double *n = page->kernel.normal;
  size_t count = 0;
  for (int level = 0; level < tree->levels; ++level) {
    count += (size_t)tree->axes[0].count[level] + (size_t)tree->axes[1].count[level];
    made->level[level].spots[0] = NULL;
  }
  if (count > made->room) {
    cut_seen_free(made);
    made->spots = malloc(count * sizeof *made->spots);
    made->taps = malloc(count * sizeof *made->taps);
    if (!made->spots || !made->taps) return false;
    made->room = count;
  }
  made->tree = tree;
  made->page = page;
  made->taps_used = 0;
  made->per_height = 1 / page->height;
  made->w = made->per_height - axes[0].kappa;
  made->tilt = sqrt(n[0] * n[0] + n[1] * n[1]);
  for (int axis = 0; axis < 2; ++axis) made->rate[axis] = -made->w / axes[axis].far_step;
  return true;
}

/* At most one st sample is within a narrow view. */
static void set_line(struct cut_spot *spot, double reach, double per_reach, int far_count) {
  spot->line = spot->cell + (spot->place - spot->cell > 0.5 && spot->cell < far_count - 1);
  double off = fabs(spot->place - spot->line);
  spot->bend = off < reach ? reach - off * off * per_reach : 0;
}

static void set_spots(const struct cut_seen *seen, int level, int axis, struct cut_spot *spot) {
  const struct light_axis *along = &seen->page->page->axes[axis];
  const struct cut_axis *tree = &seen->tree->axes[axis];
  const double q = seen->page->foot[axis], most = along->far_count - 0.5;
  const double kappa = along->kappa, shift = -along->far_low;
  const double per_step = 1 / along->far_step, speed = fabs(seen->rate[axis]);
  const double per_speed = 1 / speed;
  const struct cut_interval *interval = tree->level[level];
  for (int k = 0; k < tree->count[level]; ++k, ++spot, ++interval) {
    spot->slope = (interval->center - q) * seen->per_height;
    spot->place = (shift + (kappa * interval->center - spot->slope)) * per_step - 0.5;
    spot->size = interval->moment[0] * seen->per_height;
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

void cut_seen_prepare(struct cut_seen *seen, int number) {
  struct cut_seen_level *level = &seen->level[number];
  struct cut_spot *spots = seen->spots;
  const struct cut_axis *axes = seen->tree->axes;
  double spread = 0, width = cut_narrowest;
  if (level->spots[0]) return;
  for (int k = 0; k < number; ++k) spots += axes[0].count[k] + axes[1].count[k];
  level->samples = 1;
  for (int axis = 0; axis < 2; ++axis) {
    double wide = axes[axis].widest[number] * fabs(seen->w);
    if (wide > spread) spread = wide;
    level->samples *= 2 + wide;
    level->reach[axis] = axes[axis].reach[number] * seen->per_height;
    level->spots[axis] = spots;
    set_spots(seen, number, axis, spots);
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
static double spread_error(const struct cut_seen *seen, const struct cut_seen_level *level,
                           const struct cut_estimate *estimate) {
  const uint8_t *code = estimate->error[seen->w < 0] + level->spread;
  return (double)seen->tree->error[code[0] > code[1] ? code[0] : code[1]];
}

static double line_error(const struct cut_tree *tree, int level, const int at[2],
                         const struct cut_spot *const spot[2]) {
  const struct cut_estimate *estimates =
      tree->level[level].estimates + cut_texels(tree) * cut_node_number(tree, level, at);
  const int width = tree->page->axes[0].far_count;
  double error = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const struct cut_spot *across = spot[1 - axis];
    const int step = axis ? 1 : width;
    const struct cut_estimate *at_line = estimates + spot[axis]->line * (axis ? width : 1);
    if (!(spot[axis]->bend > 0)) continue;
    int code = at_line[across->cell * step].line[axis];
    /* Where it crosses a line of the other axis too, it is in the cells on both sides of that. */
    for (int side = across->line - 1; across->bend > 0 && side <= across->line; ++side)
      if (side >= 0 && at_line[side * step].line[axis] > code)
        code = at_line[side * step].line[axis];
    error += spot[axis]->bend * (double)tree->error[code];
  }
  return error;
}

static double largest_of(const float *rgb) {
  float most = rgb[0] > rgb[1] ? rgb[0] : rgb[1];
  return (double)(most > rgb[2] ? most : rgb[2]);
}

static double larger(double a, double b) {
  return a > b ? a : b;
}

bool cut_seen_estimate(const struct cut_seen *seen, int number, const int at[2],
                       struct cut_node *node) {
  const struct cut_tree *tree = seen->tree;
  const struct cut_seen_level *level = &seen->level[number];
  const struct cut_spot *const spot[2] = {&level->spots[0][at[0]], &level->spots[1][at[1]]};
  if (!spot[0]->seen || !spot[1]->seen) return false;
  const struct kernel *kernel = &seen->page->kernel;
  const bool whole = spot[0]->whole && spot[1]->whole;
  const double x = spot[0]->slope, y = spot[1]->slope, square = 1 + x * x + y * y;
  const double g = kernel_height(kernel, x, y), per = 1 / (g * square);
  const double per_square = per * g, per_g = per * square;
  const double value = g * per_square * per_square * spot[0]->size * spot[1]->size;
  const double reach = larger(level->reach[0], level->reach[1]), root = sqrt(square);
  const double flat = reach * reach * per_square, narrow = reach * root * per_square;
  const double tilt = 1 + seen->tilt * root * per_g;
  const double mixed =
      8 * x * y * per_square * per_square - kernel->normal[0] * kernel->normal[1] * per_g * per_g;
  double part = 0;
  *node = (struct cut_node){.level = number, .at = {at[0], at[1]}};
  node->bend =
      flat * ((whole ? third_order : cut_third_order) * narrow * tilt + fourth_order * flat) +
      (whole ? mixed_order : cut_mixed_order) * fabs(mixed) * level->reach[0] * level->reach[1];
  if (number == tree->levels - 1) {
    node->light = value * largest_of(tree->page->slab.rgb +
                                     seen_page_offset(seen->page, 1, at[1], spot[1]->cell) +
                                     seen_page_offset(seen->page, 0, at[0], spot[0]->cell));
  } else {
    const struct cut_estimate *estimate =
        tree->level[number].estimates + cut_texels(tree) * cut_node_number(tree, number, at) +
        (size_t)spot[1]->cell * (size_t)tree->page->axes[0].far_count + (size_t)spot[0]->cell;
    double edge = whole ? 0 : (double)tree->error[estimate->edge];
    if (level->narrow)
      part = (double)tree->error[estimate->second] *
             (second_order * flat + first_order * narrow * level->across) * tilt;
    else
      part = (double)tree->error[estimate->part] * part_order * flat * tilt;
    node->light = value * cut_mean(estimate);
    double spread =
        level->narrow ? line_error(tree, number, at, spot) : spread_error(seen, level, estimate);
    node->spread = value * larger(spread, edge);
  }
  node->bent = fabs(node->light) * node->bend + value * part;
  if (flat > steep) node->bent += tree->hemisphere;
  return true;
}

/* ---- The light of a node ---- */

/* The kernel's relative derivatives along an axis at a node's center, the second one halved. */
struct bend {
  double first, second;
};

static double find_bends(const struct kernel *kernel, const double at[2], struct bend bends[2]) {
  const double g = kernel_height(kernel, at[0], at[1]);
  const double square = 1 + at[0] * at[0] + at[1] * at[1], per = 1 / (g * square);
  const double per_g = per * square, per_square = per * g;
  for (int axis = 0; axis < 2; ++axis) {
    const double n = kernel->normal[axis] * per_g, p = at[axis] * per_square;
    bends[axis] = (struct bend){n - 4 * p, -4 * n * p - 2 * per_square + 12 * p * p};
  }
  return g * per_square * per_square;
}

static const struct cut_taps *find_taps(struct cut_seen *seen, int level, int axis, int at) {
  struct cut_spot *spot = &seen->level[level].spots[axis][at];
  if (spot->taps) return spot->taps;
  const struct cut_sight sight = {.place = spot->place,
                                  .rate = seen->rate[axis],
                                  .scale = seen->per_height,
                                  .clipped = !spot->whole};
  spot->taps = &seen->taps[seen->taps_used++];
  if (!cut_taps_find(&seen->tree->axes[axis].level[level][at], &sight,
                     seen->page->page->axes[axis].far_count, spot->taps))
    spot->taps->count = -1;
  return spot->taps;
}

/* What the st samples weigh along one axis: in M, and in the slope of this axis. */
struct factors {
  int first, count;
  float mean[CUT_TAPS], slope[CUT_TAPS];
};

static bool find_factors(struct cut_seen *seen, const struct cut_node *node, int axis,
                         const struct bend *bend, struct factors *factors) {
  const struct cut_taps *taps = find_taps(seen, node->level, axis, node->at[axis]);
  if (taps->count < 0) return false;
  const double half =
      seen->per_height * seen->tree->axes[axis].level[node->level][node->at[axis]].half;
  const float first = (float)(bend->first * half), second = (float)(bend->second * half * half);
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

static simd_float4 viewer_light(const float *image, size_t row, const struct factors *u,
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

bool cut_seen_light(struct cut_seen *seen, const struct cut_node *node, double rgb[3],
                    double *error) {
  const struct cut_tree *tree = seen->tree;
  const struct light_page *page = tree->page;
  const struct cut_seen_level *level = &seen->level[node->level];
  const double at[2] = {level->spots[0][node->at[0]].slope, level->spots[1][node->at[1]].slope};
  struct bend bends[2];
  struct factors factors[2];
  double value = find_bends(&seen->page->kernel, at, bends), most = 0;
  for (int axis = 0; axis < 2; ++axis)
    if (!find_factors(seen, node, axis, &bends[axis], &factors[axis])) return false;
  float light[4];
  if (node->level == tree->levels - 1) {
    simd_float4 sum =
        viewer_light(page->slab.rgb + seen_page_offset(seen->page, 1, node->at[1], 0) +
                         seen_page_offset(seen->page, 0, node->at[0], 0),
                     3 * (size_t)slab_width(&page->slab), &factors[0], &factors[1]);
    memcpy(light, &sum, sizeof light);
  } else
    node_light(tree->level[node->level].images +
                   CUT_FLOATS * cut_texels(tree) * cut_node_number(tree, node->level, node->at),
               (size_t)(CUT_FLOATS * page->axes[0].far_count), &factors[0], &factors[1], light);
  for (int c = 0; c < 3; ++c) {
    double more = value * (double)light[c];
    rgb[c] += more;
    most = larger(most, fabs(more));
  }
  if (most > fabs(node->light)) *error += node->bend * (most - fabs(node->light));
  return true;
}
