#include "cut/cut_views.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"

enum {
  PAIRS = 4 * CUT_VIEWS_MOST,
  ROWS = 4 * CUT_VIEWS_MOST,
  SLOPES = CUT_VIEWS_NODES * CUT_VIEWS_MOST
};

/* Along u, samples are taken in pairs: two st samples beside each other in one view, as RGB RGB and
 * two floats of no weight. Along v they are rows of the raster. The slopes of a view's nodes are
 * beside each other. */
struct cut_views {
  simd_float8 sum;
  int nodes;
  int count; /* of views along v */
  const float *rgb;
  float normal[3]; /* of the receiver, relative to the kernel at the center */
  int pairs, slopes, rows;
  int view[PAIRS]; /* number of its first slope */
  size_t offset[PAIRS];
  int first[CUT_VIEWS_MOST + 1]; /* rows of each view along v */
  size_t row[ROWS];
  float row_weight[CUT_VIEWS_NODES][ROWS];
  float row_slope[SLOPES];
  float slope[SLOPES + SIMD_LANES];
  float kernel[CUT_VIEWS_NODES][SLOPES + SIMD_LANES];
  simd_float8 weight[CUT_VIEWS_NODES][PAIRS];
};

struct cut_views *cut_views_make(void) {
  return aligned_alloc(sizeof(simd_float8), (sizeof(struct cut_views) + sizeof(simd_float8) - 1) /
                                                sizeof(simd_float8) * sizeof(simd_float8));
}

void cut_views_free(struct cut_views *views) {
  free(views);
}

/* Where the nodes of a view are, in halves of it: the zeros of the polynomials that are orthogonal
 * over a hat function. The kernel in between is the polynomial through them. */
static const double nodes_at[CUT_VIEWS_NODES + 1][CUT_VIEWS_NODES] = {
    [1] = {0},
    [2] = {-0.40824829, 0.40824829},
    [3] = {-0.63245553, 0, 0.63245553},
    [4] = {-0.75092533, -0.26222806, 0.26222806, 0.75092533}};

/* One axis, as the receiver sees it. */
struct sees {
  const struct light_axis *axis;
  double foot, per_height, per_step, speed, per_speed;
  int nodes;
  double first[2], second; /* one node: the kernel's slope; at x it is first[0] + first[1] x */
  double share[CUT_VIEWS_NODES][CUT_MOMENTS]; /* more: each node's polynomial */
};

/* Relative derivatives of the kernel along an axis, the second one halved. */
static void find_derivatives(const struct kernel *kernel, const double at[2], int axis,
                             double by[2]) {
  const double g = kernel_height(kernel, at[0], at[1]);
  const double per_square = 1 / (1 + at[0] * at[0] + at[1] * at[1]);
  const double n = kernel->normal[axis] / g, p = at[axis] * per_square;
  by[0] = n - 4 * p;
  by[1] = -4 * n * p - 2 * per_square + 12 * p * p;
}

static void find_slope(const struct seen_page *seen, int axis, const double middle[2],
                       struct sees *sees) {
  const double reach = sees->axis->half * sees->per_height / 2;
  double ends[2][2], at[2] = {middle[0], middle[1]};
  for (int side = 0; side < 2; ++side) {
    at[axis] = middle[axis] + (side ? reach : -reach);
    find_derivatives(&seen->kernel, at, axis, ends[side]);
  }
  sees->first[1] = (ends[1][0] - ends[0][0]) / (2 * reach);
  sees->first[0] = (ends[1][0] + ends[0][0]) / 2 - sees->first[1] * middle[axis];
  sees->second = (ends[0][1] + ends[1][1]) / 2;
}

/* Lagrange's polynomials, ascending. */
static void find_shares(struct sees *sees) {
  const double *at = nodes_at[sees->nodes];
  for (int node = 0; node < sees->nodes; ++node) {
    double *share = sees->share[node];
    memset(share, 0, sizeof sees->share[node]);
    share[0] = 1;
    for (int other = 0; other < sees->nodes; ++other) {
      if (other == node) continue;
      const double per = 1 / (at[node] - at[other]);
      for (int power = sees->nodes - 1; power >= 0; --power)
        share[power] = ((power ? share[power - 1] : 0) - at[other] * share[power]) * per;
    }
  }
}

static struct sees look_along(const struct seen_page *seen, int axis, int nodes,
                              const double middle[2]) {
  const struct light_axis *along = &seen->page->axes[axis];
  struct sees sees = {.axis = along,
                      .foot = seen->foot[axis],
                      .per_height = 1 / seen->height,
                      .per_step = 1 / along->far_step,
                      .nodes = nodes};
  sees.speed = (along->kappa * seen->height - 1) * sees.per_step * sees.per_height;
  sees.per_speed = 1 / fabs(sees.speed);
  if (nodes == 1)
    find_slope(seen, axis, middle, &sees);
  else
    find_shares(&sees);
  return sees;
}

/* What the st samples weigh in a view, for each node: relative to its spacing. */
struct weights {
  int first, count;
  float weight[CUT_VIEWS_NODES][CUT_TAPS];
};

/* A whole hat function, `width` wide to each side, per = 1/width. Its product with a hat function
 * of st is linear in cells of st, and has a kink where a sample of st is in the view: by the
 * integrals of a hat function twice and three times. */
static bool weigh_hat(double place, double width, double per, const double by[2], int node,
                      struct weights *out) {
  const int cell = (int)place, low = (int)(place - width), high = (int)(place + width);
  const int first = low < high ? low : cell, count = high - first + 2;
  const double up = place - cell, all = by[0], slope = by[1], turn = slope * width / 6;
  float *sum = out->weight[node];
  if (count > CUT_TAPS) return false;
  out->first = first;
  out->count = count;
  memset(sum, 0, sizeof out->weight[node]);
  sum[cell - first] = (float)(all * (1 - up) - turn);
  sum[cell - first + 1] = (float)(all * up + turn);
  for (int line = low + 1; line <= high; ++line) {
    const double d = place - line, q = 1 - fabs(d) * per, cube = q * q * q / 6 * width;
    const double odd = slope * cube * (1 - q / 2);
    const float kink = (float)(all * cube + (line <= cell ? -odd : odd));
    sum[line - 1 - first] += kink;
    sum[line - first] -= 2 * kink;
    sum[line + 1 - first] += kink;
  }
  return true;
}

/* Any view, and the slopes of its nodes. False: too many samples. */
static bool weigh(const struct sees *sees, const struct cut_interval *view, float *slopes,
                  struct weights *out) {
  const struct light_axis *axis = sees->axis;
  const int last = axis->far_count - 1;
  const double x = (view->center - sees->foot) * sees->per_height;
  const double width = view->half * sees->per_height;
  const double place = (axis->kappa * view->center - x - axis->far_low) * sees->per_step - 0.5;
  const double reach = fabs(sees->speed) * view->half;
  const double expanded[CUT_MOMENTS] = {1, (sees->first[0] + sees->first[1] * x) * width,
                                        sees->second * width * width};
  const bool inner = view->first > 0 && view->last < axis->near_count - 1;
  const bool hat = inner && sees->nodes <= 2 && place - reach >= 0 && place + reach < last;
  struct cut_taps taps;
  const struct cut_sight sight = {.place = place,
                                  .rate = sees->speed,
                                  .scale = 1 / axis->near_step,
                                  .clipped =
                                      !(place - reach >= -0.5 && place + reach <= last + 0.5)};
  if (!hat && !cut_taps_find(view, &sight, axis->far_count, &taps)) return false;
  for (int node = 0; node < sees->nodes; ++node) {
    const double *by = sees->nodes == 1 ? expanded : sees->share[node];
    slopes[node] = (float)(x + nodes_at[sees->nodes][node] * width);
    const double hats[2] = {by[0] + by[2] / 6, sees->speed < 0 ? -by[1] : by[1]};
    if (hat && !weigh_hat(place, reach, sees->per_speed * view->per_half, hats, node, out))
      return false;
    if (hat) continue;
    out->first = taps.first;
    out->count = taps.count;
    for (int k = 0; k < taps.count; ++k)
      out->weight[node][k] = taps.moment[0][k] * (float)by[0] + taps.moment[1][k] * (float)by[1] +
                             taps.moment[2][k] * (float)by[2] + taps.moment[3][k] * (float)by[3];
  }
  return true;
}

static bool weigh_columns(const struct cut_tree *tree, const struct seen_page *seen,
                          const struct sees *sees, struct cut_views *out) {
  const struct cut_interval *interval = tree->axes[0].level[tree->levels - 1];
  struct weights weights = {0};
  out->pairs = out->slopes = 0;
  for (int i = 0; i < sees->axis->near_count; ++i, out->slopes += sees->nodes) {
    if (!weigh(sees, &interval[i], out->slope + out->slopes, &weights)) return false;
    const size_t from = seen_page_offset(seen, 0, i, weights.first);
    for (int k = 0; k < weights.count; k += 2, ++out->pairs) {
      if (out->pairs == PAIRS) return false;
      for (int node = 0; node < sees->nodes; ++node) {
        const float *weight = weights.weight[node] + k, a = weight[0];
        const float b = k + 1 < weights.count ? weight[1] : 0;
        out->weight[node][out->pairs] = (simd_float8){a, a, a, b, b, b};
      }
      out->view[out->pairs] = out->slopes;
      out->offset[out->pairs] = from + 3 * (size_t)k;
    }
  }
  if (out->pairs % 2) {
    out->view[out->pairs] = 0;
    out->offset[out->pairs] = 0;
    for (int node = 0; node < sees->nodes; ++node) out->weight[node][out->pairs] = (simd_float8){0};
    ++out->pairs;
  }
  for (int k = 0; k < SIMD_LANES; ++k) out->slope[out->slopes + k] = 0;
  return true;
}

static bool weigh_rows(const struct cut_tree *tree, const struct seen_page *seen,
                       const struct sees *sees, struct cut_views *out) {
  const struct cut_interval *interval = tree->axes[1].level[tree->levels - 1];
  const size_t stride = 3 * (size_t)slab_width(&seen->page->slab);
  struct weights weights = {0};
  out->rows = out->first[0] = 0;
  for (int j = 0; j < sees->axis->near_count; ++j) {
    if (!weigh(sees, &interval[j], out->row_slope + sees->nodes * j, &weights)) return false;
    if (out->rows + weights.count > ROWS) return false;
    const size_t from = stride * (size_t)(j * sees->axis->far_count + weights.first);
    for (int l = 0; l < weights.count; ++l, ++out->rows) {
      out->row[out->rows] = from + stride * (size_t)l;
      for (int node = 0; node < sees->nodes; ++node)
        out->row_weight[node][out->rows] = weights.weight[node][l];
    }
    out->first[j + 1] = out->rows;
  }
  return true;
}

/* The kernel at a row of views: at all nodes. */
SIMD_INLINE void find_kernel(struct cut_views *views, int view) {
  const float *n = views->normal;
  for (int node = 0; node < views->nodes; ++node) {
    const float y = views->row_slope[views->nodes * view + node];
    const float rest = n[1] * y - n[2], square = 1 + y * y;
    for (int k = 0; k < views->slopes; k += SIMD_LANES) {
      simd_float8 x = SIMD_LOAD(simd_floats8, views->slope + k), value = x * x + square;
      value = (x * n[0] + rest) / (value * value);
      memcpy(views->kernel[node] + k, &value, sizeof value);
    }
  }
}

/* sum += what is seen of a pair, at one node along v. */
SIMD_INLINE void add_pair(const struct cut_views *views, int pair, int node, int nodes,
                          const simd_float8 *seen, simd_float8 *sum) {
  const float *kernel = views->kernel[node] + views->view[pair];
  simd_float8 weight = views->weight[0][pair] * kernel[0];
  for (int other = 1; other < nodes; ++other) weight += views->weight[other][pair] * kernel[other];
  *sum += *seen * weight;
}

/* `count` rows of st samples of a row of views: like `nodes`, a constant where it matters. Two
 * pairs at a time. */
SIMD_INLINE void sum_rows(struct cut_views *views, int first, int count, int nodes) {
  simd_float8 sum = views->sum;
  for (int k = 0; k < views->pairs; k += 2) {
    simd_float8 one[CUT_VIEWS_NODES] = {{0}}, two[CUT_VIEWS_NODES] = {{0}};
    for (int l = first; l < first + count; ++l) {
      const float *row = views->rgb + views->row[l];
      const simd_float8 a = SIMD_LOAD(simd_floats8, row + views->offset[k]);
      const simd_float8 b = SIMD_LOAD(simd_floats8, row + views->offset[k + 1]);
      for (int node = 0; node < nodes; ++node) {
        one[node] += a * views->row_weight[node][l];
        two[node] += b * views->row_weight[node][l];
      }
    }
    for (int node = 0; node < nodes; ++node) {
      add_pair(views, k, node, nodes, &one[node], &sum);
      add_pair(views, k + 1, node, nodes, &two[node], &sum);
    }
  }
  views->sum = sum;
}

SIMD_INLINE void sum_views_body(struct cut_views *views) {
  for (int view = 0; view < views->count; ++view) {
    const int first = views->first[view], count = views->first[view + 1] - first;
    find_kernel(views, view);
    if (views->nodes == 1 && count == 2)
      sum_rows(views, first, 2, 1);
    else if (views->nodes == 1)
      sum_rows(views, first, count, 1);
    else if (views->nodes == 2)
      sum_rows(views, first, count, 2);
    else if (views->nodes == 3)
      sum_rows(views, first, count, 3);
    else
      sum_rows(views, first, count, 4);
  }
}

SIMD_DISPATCH(sum_views, (struct cut_views * views), (views))

bool cut_views_light(const struct cut_tree *tree, const struct seen_page *seen, int nodes,
                     struct cut_views *views, double rgb[3]) {
  const struct light_axis *axes = seen->page->axes;
  double middle[2];
  seen_page_middle(seen, middle);
  const struct sees u = look_along(seen, 0, nodes, middle), v = look_along(seen, 1, nodes, middle);
  if (!weigh_columns(tree, seen, &u, views) || !weigh_rows(tree, seen, &v, views)) return false;
  const double g = kernel_height(&seen->kernel, middle[0], middle[1]);
  const double scale = g * axes[0].near_step * axes[1].near_step * u.per_height * u.per_height;
  for (int c = 0; c < 3; ++c) views->normal[c] = (float)(seen->kernel.normal[c] / g);
  views->nodes = nodes;
  views->count = axes[1].near_count;
  views->rgb = seen->page->slab.rgb;
  views->sum = (simd_float8){0};
  sum_views(views);
  for (int c = 0; c < 3; ++c) rgb[c] = (double)(views->sum[c] + views->sum[3 + c]) * scale;
  return true;
}
