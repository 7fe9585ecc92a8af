/* cut_lines.c - the error of a node that is seen across one line of st samples (cut_tree.h).
 *
 * Radiance along s has a kink at a sample, the second difference D of the samples there, its
 * curvature. What is beyond the line adds the integral of D (a - a0) to a linear radiance: a node
 * knows the views' mean D and its first moment, the rest is its error. It is proportional to the
 * width of the node in st samples, and measured for lines at all views. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"
#include "cut/cut_tree.h"
#include "microlight/seen_page.h"

/* How the views along the other axis are summed: their mean and their first moment. The second
 * counts as much as half a cell's change of weight makes of it. */
enum { SUMS = 2, RING = 3, FINE = 8 };
static const float first_moment = 0.75f;

struct cut_lines {
  size_t floats;    /* of a row of st samples, padded */
  float *rows;      /* [RING][SUMS][view] sums over views along the other axis */
  float *curvature; /* [SUMS][view] second differences */
  float *most;      /* one row */
  float *second;    /* one row, and weights of the views */
  float *share[2];  /* [view] */
  float *weights;   /* [line][view] */
  float memory[];   /* of all of these */
};

struct cut_lines *cut_lines_make(const struct cut_tree *tree) {
  const struct light_axis *axes = tree->page->axes;
  const size_t views =
      (size_t)(axes[0].near_count > axes[1].near_count ? axes[0].near_count : axes[1].near_count);
  const size_t floats = (3 * (size_t)axes[0].far_count + 3) / 4 * 4;
  const size_t rows = (RING * SUMS + SUMS) * views + 2, others = (views + FINE + 3) * views;
  struct cut_lines *made = calloc(1, sizeof *made + (rows * floats + others) * sizeof(float));
  if (!made) return NULL;
  made->floats = floats;
  made->rows = made->memory;
  made->curvature = made->rows + RING * SUMS * views * floats;
  made->most = made->curvature + SUMS * views * floats;
  made->second = made->most + floats;
  made->share[0] = made->second + floats + views;
  made->share[1] = made->share[0] + views;
  made->weights = made->share[1] + views;
  return made;
}

/* Integrals of H (a - crossing) and of that times (a - center), over a > crossing; distances are
 * from `center`. */
static void find_hinge(const struct cut_interval *part, double center, double crossing,
                       double hinge[2]) {
  const double shift = part->center - center;
  hinge[0] = hinge[1] = 0;
  for (int k = 0; k < part->pieces; ++k) {
    const struct cut_piece *piece = &part->piece[k];
    const double low = fmax(piece->low, crossing - shift), width = piece->high - low;
    const double rise = (piece->to - piece->from) / (piece->high - piece->low);
    for (int g = 0; width > 0 && g < 3; ++g) {
      double d = low + cut_gauss_at[g] * width;
      double h = piece->from + rise * (d - piece->low);
      double more = cut_gauss_weight[g] * width * h * (d + shift - crossing);
      hinge[0] += more;
      hinge[1] += more * (d + shift);
    }
  }
}

/* Weights of the views in the node's error for each line, in half widths of the node; relative to
 * 1 - x^2, about what a line at x, in half widths from the center, does. Returns the number of
 * lines. */
static int find_lines(const struct cut_interval *node, const struct cut_interval *views,
                      float *weights) {
  const int count = node->last - node->first + 1, per_view = count <= FINE ? 2 : 1;
  const int lines = per_view * (count - 1) + 1;
  const double unit = 1 / (node->half * node->moment[0]);
  for (int line = 0; line < lines; ++line) {
    const struct cut_interval *first = &views[node->first + line / per_view];
    double at = line % per_view ? (first[0].center + first[1].center) / 2 : first->center;
    at -= node->center;
    double x = at * node->per_half, scale = unit / (1 - x * x), all[2], own[2];
    find_hinge(node, node->center, at, all);
    for (int i = 0; i < count; ++i, ++weights) {
      const struct cut_interval *view = &views[node->first + i];
      find_hinge(view, node->center, at, own);
      double mean = view->moment[0] / node->moment[0];
      double slope = (view->center - node->center) * view->moment[0] / node->moment[2];
      *weights = (float)((own[0] - mean * all[0] - slope * all[1]) * scale);
    }
  }
  return lines;
}

/* The same for the integral of (a - a0)^2 over the whole node: what a slope of the kernel makes of
 * one of radiance, and the kernel's second order. */
static void find_second(const struct cut_interval *node, const struct cut_interval *views,
                        float *weights) {
  const double unit = node->per_half * node->per_half / node->moment[0];
  for (int i = 0; i <= node->last - node->first; ++i) {
    const struct cut_interval *view = &views[node->first + i];
    double d = view->center - node->center, own = view->moment[2] + d * d * view->moment[0];
    double mean = view->moment[0] / node->moment[0], slope = d * view->moment[0] / node->moment[2];
    weights[i] = (float)((own - mean * node->moment[2] - slope * node->moment[3]) * unit);
  }
}

static void find_shares(const struct cut_interval *node, const struct cut_interval *views,
                        float *const share[2]) {
  for (int j = 0; j <= node->last - node->first; ++j) {
    const struct cut_interval *view = &views[node->first + j];
    share[0][j] = (float)(view->moment[0] / node->moment[0]);
    share[1][j] =
        (float)((view->center - node->center) * view->moment[0] / (node->moment[0] * node->half)) *
        first_moment;
  }
}

/* One row of st samples, for every view along the axis: sums over those along the other. */
static void sum_row(const struct cut_tree *tree, const struct cut_interval *const node[2], int axis,
                    int row, struct cut_lines *lines) {
  const size_t floats = lines->floats, used = 3 * (size_t)tree->page->axes[0].far_count;
  const int count = node[axis]->last - node[axis]->first + 1;
  const int others = node[1 - axis]->last - node[1 - axis]->first + 1;
  float *out = lines->rows + (size_t)(row % RING * SUMS * count) * floats;
  memset(out, 0, (size_t)(SUMS * count) * floats * sizeof *out);
  for (int i = 0; i < count; ++i, out += floats) {
    float *first = out + (size_t)count * floats;
    for (int j = 0; j < others; ++j) {
      int at[2] = {node[0]->first + (axis ? j : i), node[1]->first + (axis ? i : j)};
      const float *from =
          cut_view(tree, at) + 3 * (size_t)row * (size_t)slab_width(&tree->page->slab);
      const float share[2] = {lines->share[0][j], lines->share[1][j]};
      size_t k = 0;
      for (; k + 4 <= used; k += 4) {
        simd_float4 rgb = SIMD_LOAD(simd_floats4, from + k);
        *(simd_floats4 *)(out + k) += rgb * share[0];
        *(simd_floats4 *)(first + k) += rgb * share[1];
      }
      for (; k < used; ++k) {
        out[k] += from[k] * share[0];
        first[k] += from[k] * share[1];
      }
    }
  }
}

/* Second differences along s or t; beyond the ends radiance is constant. */
static void find_curvature(const struct cut_tree *tree, int axis, int rows, int row,
                           struct cut_lines *lines) {
  const struct light_axis *axes = tree->page->axes;
  const size_t floats = lines->floats, ring = (size_t)rows * floats;
  const float *at = lines->rows + (size_t)(row % RING) * ring;
  const int low = row > 0 ? row - 1 : row, high = row + 1 < axes[1].far_count ? row + 1 : row;
  const float *before = axis ? lines->rows + (size_t)(low % RING) * ring : at;
  const float *after = axis ? lines->rows + (size_t)(high % RING) * ring : at;
  float *out = lines->curvature;
  if (axis) {
    for (size_t k = 0; k < ring; ++k) out[k] = before[k] + after[k] - 2 * at[k];
    return;
  }
  const size_t used = 3 * (size_t)axes[0].far_count;
  for (int r = 0; r < rows; ++r, at += floats, out += floats)
    for (size_t k = 0; k < used; ++k)
      out[k] = at[k < 3 ? k : k - 3] + at[k + 3 < used ? k + 3 : k] - 2 * at[k];
}

/* The largest error of any line. */
static void find_most(int views, int count, struct cut_lines *lines) {
  const size_t floats = lines->floats;
  for (size_t k = 0; k < floats; k += 4) {
    const float *weight = lines->weights, *curvature = lines->curvature + k;
    simd_float4 most = {0};
    for (int line = 0; line < count; ++line, weight += views) {
      simd_float4 mean = {0}, first = {0};
      for (int i = 0; i < views; ++i) {
        mean += SIMD_LOAD(simd_floats4, curvature + (size_t)i * floats) * weight[i];
        first += SIMD_LOAD(simd_floats4, curvature + (size_t)(views + i) * floats) * weight[i];
      }
      most = simd_larger(most, simd_magnitude(mean) + simd_magnitude(first));
    }
    *(simd_floats4 *)(lines->most + k) = most;
  }
}

/* The same of the second moments. */
static void sum_second(const float *rows, int views, struct cut_lines *lines) {
  const size_t floats = lines->floats;
  const float *weight = lines->second + floats;
  for (size_t k = 0; k < floats; k += 4) {
    simd_float4 sum = {0};
    for (int i = 0; i < views; ++i)
      sum += SIMD_LOAD(simd_floats4, rows + (size_t)i * floats + k) * weight[i];
    *(simd_floats4 *)(lines->second + k) = simd_magnitude(sum);
  }
}

void cut_lines_measure(const struct cut_tree *tree, int level, const int at[2], int axis,
                       struct cut_lines *lines, simd_float4 *off, simd_float4 *second) {
  const struct cut_interval *node[2];
  cut_intervals(tree, level, at, node);
  const int views = node[axis]->last - node[axis]->first + 1, last = tree->levels - 1;
  const int width = tree->page->axes[0].far_count, height = tree->page->axes[1].far_count;
  memset(off, 0, cut_texels(tree) * sizeof *off);
  if (views == 1) return;
  int count = find_lines(node[axis], tree->axes[axis].level[last], lines->weights);
  find_second(node[axis], tree->axes[axis].level[last], lines->second + lines->floats);
  find_shares(node[1 - axis], tree->axes[1 - axis].level[last], lines->share);
  if (axis) sum_row(tree, node, axis, 0, lines);
  for (int l = 0; l < height; ++l) {
    if (!axis) sum_row(tree, node, axis, l, lines);
    if (axis && l + 1 < height) sum_row(tree, node, axis, l + 1, lines);
    find_curvature(tree, axis, SUMS * views, l, lines);
    find_most(views, count, lines);
    sum_second(lines->rows + (size_t)(l % RING * SUMS * views) * lines->floats, views, lines);
    for (int k = 0; k < width; ++k, ++off, ++second)
      for (int c = 0; c < 3; ++c) {
        (*off)[c] = lines->most[3 * k + c];
        (*second)[c] += lines->second[3 * k + c];
      }
  }
}
