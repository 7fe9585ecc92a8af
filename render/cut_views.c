/* cut_views.c - see cut_views.h. */
#include "cut_views.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "simd.h"

enum { MOST = 64, PAIRS = 4 * MOST, ROWS = 4 * MOST };

/* Two st samples beside each other in one view along u; weights for RGB RGB and two floats more. */
struct cut_views {
  simd_float8 weight[PAIRS];
  float slope[PAIRS + SIMD_LANES], kernel[PAIRS + SIMD_LANES];
  size_t offset[PAIRS];
  int pairs;
  int row_count[MOST]; /* of each view along v */
  size_t row[ROWS];
  float row_weight[ROWS];
  double row_slope[MOST];
  int rows;
  float normal[3]; /* of the receiver, relative to the kernel at the center */
};

struct cut_views *cut_views_make(void) {
  return aligned_alloc(sizeof(simd_float8), (sizeof(struct cut_views) + sizeof(simd_float8) - 1) /
                                                sizeof(simd_float8) * sizeof(simd_float8));
}

void cut_views_free(struct cut_views *views) {
  free(views);
}

/* One axis, as the receiver sees it. */
struct sees {
  const struct light_axis *axis;
  double foot, per_height, shift, rate, per_step, speed;
  double first[2], second; /* the kernel's slope: at x it is first[0] + first[1] x */
};

/* Relative derivatives of the kernel along an axis, the second one halved. */
static void find_bend(const struct kernel *kernel, const double at[2], int axis, double bend[2]) {
  const double g = kernel_height(kernel, at[0], at[1]);
  const double per_square = 1 / (1 + at[0] * at[0] + at[1] * at[1]);
  const double n = kernel->normal[axis] / g, p = at[axis] * per_square;
  bend[0] = n - 4 * p;
  bend[1] = -4 * n * p - 2 * per_square + 12 * p * p;
}

static struct sees look_along(const struct view *view, int axis, const double middle[2]) {
  const struct light_axis *along = &view->page->axes[axis];
  struct sees sees = {.axis = along, .foot = view->foot[axis], .per_height = 1 / view->height};
  const double reach = along->half * sees.per_height / 2;
  double bends[2][2], at[2] = {middle[0], middle[1]};
  sees.shift = along->kappa * sees.foot - along->far_low;
  sees.rate = along->kappa * view->height - 1;
  sees.per_step = 1 / along->far_step;
  sees.speed = sees.rate * sees.per_step * sees.per_height;
  for (int side = 0; side < 2; ++side) {
    at[axis] = middle[axis] + (side ? reach : -reach);
    find_bend(&view->kernel, at, axis, bends[side]);
  }
  sees.first[1] = (bends[1][0] - bends[0][0]) / (2 * reach);
  sees.first[0] = (bends[1][0] + bends[0][0]) / 2 - sees.first[1] * middle[axis];
  sees.second = (bends[0][1] + bends[1][1]) / 2;
  return sees;
}

/* What the st samples weigh in a view: relative to its spacing. */
struct weights {
  int first, count;
  float weight[CUT_TAPS];
};

/* A whole hat function. A product with a hat function of st is linear in cells of st, and bends
 * where a sample of st is in the view: by the integrals of a hat function twice and three times. */
static bool weigh_hat(double place, double width, double slope, double all, struct weights *out) {
  const int cell = (int)place, low = (int)(place - width), high = (int)(place + width);
  const int first = low < high ? low : cell, count = high - first + 2;
  const double up = place - cell, per = 1 / width, turn = slope * width / 6;
  float *sum = out->weight;
  if (count > CUT_TAPS) return false;
  out->first = first;
  out->count = count;
  for (int k = 0; k < count; ++k) sum[k] = 0;
  sum[cell - first] = (float)(all * (1 - up) - turn);
  sum[cell - first + 1] = (float)(all * up + turn);
  for (int line = low + 1; line <= high; ++line) {
    const double d = place - line, q = 1 - fabs(d) * per, cube = q * q * q / 6 * width;
    const double odd = slope * cube * (1 - q / 2);
    const float bend = (float)(all * cube + (line <= cell ? -odd : odd));
    sum[line - 1 - first] += bend;
    sum[line - first] -= 2 * bend;
    sum[line + 1 - first] += bend;
  }
  return true;
}

/* Any view, and its slope. False: too many samples. */
static bool weigh(const struct sees *sees, const struct cut_interval *view, double *x,
                  struct weights *out) {
  const struct light_axis *axis = sees->axis;
  const int last = axis->far_count - 1;
  *x = (view->center - sees->foot) * sees->per_height;
  const double place = (sees->shift + sees->rate * *x) * sees->per_step - 0.5;
  const double reach = fabs(sees->speed) * view->half;
  const double first = (sees->first[0] + sees->first[1] * *x) * view->half * sees->per_height;
  const double second =
      sees->second * view->half * view->half * sees->per_height * sees->per_height;
  const bool inner = view->first > 0 && view->last < axis->near_count - 1;
  if (inner && place - reach >= 0 && place + reach < last)
    return weigh_hat(place, reach, sees->speed < 0 ? -first : first, 1 + second / 6, out);
  const struct cut_sight sight = {.place = place,
                                  .rate = sees->speed,
                                  .scale = 1 / axis->near_step,
                                  .clipped =
                                      !(place - reach >= -0.5 && place + reach <= last + 0.5)};
  struct cut_taps taps;
  if (!cut_taps_find(view, &sight, axis->far_count, &taps)) return false;
  out->first = taps.first;
  out->count = taps.count;
  for (int k = 0; k < taps.count; ++k)
    out->weight[k] =
        taps.moment[0][k] + taps.moment[1][k] * (float)first + taps.moment[2][k] * (float)second;
  return true;
}

static bool weigh_columns(const struct cut_tree *tree, const struct view *view,
                          const struct sees *sees, struct cut_views *out) {
  const struct cut_interval *interval = tree->axes[0].level[tree->levels - 1];
  out->pairs = 0;
  for (int i = 0; i < sees->axis->near_count; ++i) {
    struct weights weights;
    double x;
    if (!weigh(sees, &interval[i], &x, &weights)) return false;
    const size_t from = view_offset(view, 0, i, weights.first);
    for (int k = 0; k < weights.count; k += 2) {
      if (out->pairs == PAIRS) return false;
      const float a = weights.weight[k], b = k + 1 < weights.count ? weights.weight[k + 1] : 0;
      out->weight[out->pairs] = (simd_float8){a, a, a, b, b, b};
      out->slope[out->pairs] = (float)x;
      out->offset[out->pairs++] = from + 3 * (size_t)k;
    }
  }
  for (int k = out->pairs; k < out->pairs + SIMD_LANES; ++k) out->slope[k] = 0;
  return true;
}

static bool weigh_rows(const struct cut_tree *tree, const struct view *view,
                       const struct sees *sees, struct cut_views *out) {
  const struct cut_interval *interval = tree->axes[1].level[tree->levels - 1];
  const size_t stride = 3 * (size_t)slab_width(&view->page->slab);
  out->rows = 0;
  for (int j = 0; j < sees->axis->near_count; ++j) {
    struct weights weights;
    if (!weigh(sees, &interval[j], &out->row_slope[j], &weights)) return false;
    if (out->rows + weights.count > ROWS) return false;
    const size_t from = stride * (size_t)(j * sees->axis->far_count + weights.first);
    out->row_count[j] = weights.count;
    for (int l = 0; l < weights.count; ++l) {
      out->row[out->rows] = from + stride * (size_t)l;
      out->row_weight[out->rows++] = weights.weight[l];
    }
  }
  return true;
}

/* `count` rows of one view along v: a constant where it matters. */
SIMD_INLINE void sum_rows(const struct cut_views *views, const float *rgb, int first, int count,
                          simd_float8 *sum) {
  for (int k = 0; k < views->pairs; ++k) {
    simd_float8 here = {0};
    for (int l = 0; l < count; ++l)
      here += SIMD_LOAD(simd_floats8, rgb + views->row[first + l] + views->offset[k]) *
              views->row_weight[first + l];
    *sum += here * (views->weight[k] * views->kernel[k]);
  }
}

SIMD_INLINE void sum_views_body(struct cut_views *views, int count, const float *rgb,
                                float light[3]) {
  const float *n = views->normal;
  simd_float8 sum = {0};
  for (int j = 0, row = 0; j < count; row += views->row_count[j++]) {
    const float y = (float)views->row_slope[j], rest = n[1] * y - n[2], square = 1 + y * y;
    for (int k = 0; k < views->pairs; k += 8) {
      simd_float8 x = SIMD_LOAD(simd_floats8, views->slope + k), value = x * x + square;
      value = (x * n[0] + rest) / (value * value);
      memcpy(views->kernel + k, &value, sizeof value);
    }
    if (views->row_count[j] == 2)
      sum_rows(views, rgb, row, 2, &sum);
    else
      sum_rows(views, rgb, row, views->row_count[j], &sum);
  }
  for (int c = 0; c < 3; ++c) light[c] = sum[c] + sum[3 + c];
}

SIMD_DISPATCH(sum_views, (struct cut_views * views, int count, const float *rgb, float light[3]),
              (views, count, rgb, light))

static void find_middle(const struct view *view, double middle[2]) {
  for (int axis = 0; axis < 2; ++axis) middle[axis] = -view->foot[axis] / view->height;
}

bool cut_views_sum(const struct cut_tree *tree, const struct view *view, struct cut_views *views,
                   double rgb[3]) {
  const struct light_axis *axes = view->page->axes;
  double middle[2], spacing = 1 / (view->height * view->height);
  find_middle(view, middle);
  const struct sees u = look_along(view, 0, middle), v = look_along(view, 1, middle);
  if (!weigh_columns(tree, view, &u, views) || !weigh_rows(tree, view, &v, views)) return false;
  const double g = kernel_height(&view->kernel, middle[0], middle[1]);
  for (int c = 0; c < 3; ++c) views->normal[c] = (float)(view->kernel.normal[c] / g);
  float light[3];
  sum_views(views, axes[1].near_count, view->page->slab.rgb, light);
  spacing *= axes[0].near_step * axes[1].near_step;
  for (int c = 0; c < 3; ++c) rgb[c] = (double)light[c] * g * spacing;
  return true;
}

/* ---- What it costs and how exact it is ---- */

/* What the kernel's slope leaves out, in units of its change over a view and over the aperture. */
static const double view_order = 0.5, aperture_order = 0.15, rounding = 3e-6;

double cut_views_error(const struct view *view) {
  const struct light_axis *axes = view->page->axes;
  const double *n = view->kernel.normal;
  double middle[2], error = rounding;
  if (axes[0].near_count > MOST || axes[1].near_count > MOST || !(view->height > 0))
    return INFINITY;
  find_middle(view, middle);
  const double square = 1 + middle[0] * middle[0] + middle[1] * middle[1];
  const double tilt =
      sqrt(n[0] * n[0] + n[1] * n[1]) / kernel_height(&view->kernel, middle[0], middle[1]);
  const double bend = tilt + 2 / sqrt(square);
  for (int axis = 0; axis < 2; ++axis) {
    const double step = axes[axis].near_step / view->height, half = axes[axis].half / view->height;
    const double wide = fabs(axes[axis].kappa * view->height - 1) * step / axes[axis].far_step;
    error += bend * bend * step * (view_order * step + aperture_order * half * fmin(wide, 1));
  }
  return error;
}

double cut_views_price(const struct view *view) {
  static const double fixed = 200, view_price = 20, pair_price = 1.2;
  const struct light_axis *axes = view->page->axes;
  double samples = 1, views = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const double wide = fabs(axes[axis].kappa * view->height - 1) / view->height *
                        axes[axis].near_step / axes[axis].far_step;
    samples *= (2 + 2 * wide) * axes[axis].near_count;
    views += axes[axis].near_count;
  }
  return fixed + view_price * views + pair_price * samples / 2;
}
