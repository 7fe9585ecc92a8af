#include "cut/cut_node.h"

#include <math.h>

/* From this square of a node's reach over its distance on, the kernel at its center says nothing
 * of its light: it may bring all that there is. */
static const double steep = 0.25;

struct cut_width cut_width_of(double samples, double w) {
  struct cut_width made = {.across = samples / 2,
                           .narrow = samples <= cut_narrowest,
                           .wide = !(samples <= cut_widest),
                           .side = w < 0};
  for (double width = cut_narrowest; samples > 2 * width && made.spread < CUT_SPREADS - 2;
       width *= 2)
    ++made.spread;
  return made;
}

/* ---- The estimate ---- */

/* The larger of the errors that were measured at widths on both sides of the wanted: between
 * them it can pass through 0. */
static double spread_error(const struct cut_tree *tree, const struct cut_width *width,
                           const struct cut_estimate *estimate) {
  const uint8_t *code = estimate->error[width->side] + width->spread;
  return (double)tree->error[code[0] > code[1] ? code[0] : code[1]];
}

/* Along one axis. */
struct spot {
  double per_curvature;
  int cell, line;
};

static struct spot spot_of(const struct cut_spots *spots, int lane) {
  return (struct spot){spots->per_curvature[lane], spots->cell[lane], spots->line[lane]};
}

static double line_error(const struct cut_tree *tree, const struct cut_estimate *estimates,
                         const struct spot spot[2]) {
  const int width = tree->page->axes[0].far_count;
  double error = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const struct spot *across = &spot[1 - axis];
    const int step = axis ? 1 : width;
    const struct cut_estimate *at_line = estimates + spot[axis].line * (axis ? width : 1);
    if (!(spot[axis].per_curvature > 0)) continue;
    int code = at_line[across->cell * step].line[axis];
    /* Where it crosses a line of the other axis too, it is in the cells on both sides of that. */
    for (int side = across->line - 1; across->per_curvature > 0 && side <= across->line; ++side)
      if (side >= 0 && at_line[side * step].line[axis] > code)
        code = at_line[side * step].line[axis];
    error += spot[axis].per_curvature * (double)tree->error[code];
  }
  return error;
}

static double largest_of(const float *rgb) {
  float most = rgb[0] > rgb[1] ? rgb[0] : rgb[1];
  return (double)(most > rgb[2] ? most : rgb[2]);
}

void cut_node_estimate(const struct cut_tree *tree, const struct cut_width *width,
                       const struct cut_spots *const spots[2], const int lane[2],
                       const struct cut_worth *worth, int k, struct cut_node *node) {
  const struct spot spot[2] = {spot_of(spots[0], lane[0]), spot_of(spots[1], lane[1])};
  const int columns = tree->page->axes[0].far_count;
  const double value = worth->value[k], flat = worth->flat[k], tilt = worth->tilt[k];
  double part = 0, spread = 0;
  if (node->level == tree->levels - 1) {
    const struct seen_page seen = {.page = tree->page};
    node->light =
        value * largest_of(cut_view(tree, node->at) + seen_page_offset(&seen, 1, 0, spot[1].cell) +
                           seen_page_offset(&seen, 0, 0, spot[0].cell));
  } else {
    const struct cut_estimate *estimates = cut_estimates(tree, node->level, node->at);
    const struct cut_estimate *estimate = estimates + spot[1].cell * columns + spot[0].cell;
    if (width->narrow) {
      spread = line_error(tree, estimates, spot);
      part = (double)tree->error[estimate->second] * worth->second[k] * tilt;
    } else {
      spread = spread_error(tree, width, estimate);
      part = (double)tree->error[estimate->part] * cut_part_order * flat * tilt;
    }
    if (!(spots[0]->whole[lane[0]] && spots[1]->whole[lane[1]]))
      spread = simd_max(spread, (double)tree->error[estimate->edge]);
    node->light = value * cut_mean(estimate);
  }
  node->spread = value * spread;
  node->curvature_per_light = worth->per_light[k];
  node->curvature = fabs(node->light) * node->curvature_per_light + value * part;
  if (flat > steep) node->curvature += tree->hemisphere;
  node->kernel = worth->kernel[k];
  node->per_g = worth->per_g[k];
  node->per_square = worth->per_square[k];
}

/* ---- Its light ---- */

/* What the st samples weigh along one axis: in M, and in the slope of this axis. */
struct factors {
  int first, count;
  float mean[CUT_TAPS], slope[CUT_TAPS];
};

SIMD_INLINE void find_factors(const struct cut_node *node, double normal, double at, double half,
                              const struct cut_taps *taps, struct factors *factors) {
  /* The kernel's relative derivatives, the second one halved. */
  const double n = normal * node->per_g, p = at * node->per_square;
  const float first = (float)((n - 4 * p) * half);
  const float second = (float)((-4 * n * p - 2 * node->per_square + 12 * p * p) * half * half);
  factors->first = taps->first;
  factors->count = taps->count;
  for (int k = 0; k < taps->count; k += 4) {
    simd_float4 m[CUT_MOMENTS];
    for (int power = 0; power < CUT_MOMENTS; ++power)
      m[power] = SIMD_LOAD(simd_floats4, taps->moment[power] + k);
    *(simd_floats4 *)(factors->mean + k) = m[0] + m[1] * first + m[2] * second;
    *(simd_floats4 *)(factors->slope + k) = m[1] + m[2] * first + m[3] * second;
  }
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

void cut_node_light(const struct cut_tree *tree, const struct cut_node *node,
                    const double normal[3], const struct cut_spots *const spots[2],
                    const int lane[2], const struct cut_taps *const taps[2], double rgb[3],
                    double *error) {
  struct factors u, v;
  float light[4];
  find_factors(node, normal[0], spots[0]->slope[lane[0]], spots[0]->half[lane[0]], taps[0], &u);
  find_factors(node, normal[1], spots[1]->slope[lane[1]], spots[1]->half[lane[1]], taps[1], &v);
  if (node->level == tree->levels - 1) {
    const simd_float4 sum =
        view_light(cut_view(tree, node->at), 3 * (size_t)slab_width(&tree->page->slab), &u, &v);
    memcpy(light, &sum, sizeof light);
  } else {
    node_light(cut_images(tree, node->level, node->at),
               (size_t)(CUT_FLOATS * tree->page->axes[0].far_count), &u, &v, light);
  }
  double most = fabs(node->light);
  for (int c = 0; c < 3; ++c) {
    const double more = node->kernel * (double)light[c];
    rgb[c] += more;
    most = simd_max(most, fabs(more));
  }
  *error += node->curvature_per_light * (most - fabs(node->light));
}
