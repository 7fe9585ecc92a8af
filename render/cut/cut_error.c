/* cut_error.c - how far the light of a node is from that of its views (cut_tree.h), for receivers
 * in front of each st sample. Either is a weighted sum over st samples, first along s, then along
 * t. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"
#include "cut/cut_tree.h"
#include "microlight/seen_page.h"

/* What the samples weigh for the receiver in front of one of them: integrals of the hat functions,
 * and of these times x (cut_tree.h). */
struct weights {
  int first, count;
  float weight[2][CUT_TAPS];
};

struct cut_error_scratch {
  struct cut_lines *lines; /* owned */
  simd_float4 *off;        /* node - views, for each sample */
  simd_float4 *along[2];   /* sums along s */
  struct weights *of[2];   /* along s and t */
  uint8_t *code;
  uint8_t *line;        /* of codes */
  simd_float4 memory[]; /* of all but the first */
};

struct cut_error_scratch *cut_error_scratch(const struct cut_tree *tree) {
  const size_t texels = cut_texels(tree), width = (size_t)tree->page->axes[0].far_count;
  const size_t height = (size_t)tree->page->axes[1].far_count;
  struct cut_error_scratch *made =
      calloc(1, sizeof *made + 3 * texels * sizeof(simd_float4) +
                    (width + height) * sizeof(struct weights) + 2 * texels);
  if (!made) return NULL;
  made->off = made->memory;
  made->along[0] = made->off + texels;
  made->along[1] = made->along[0] + texels;
  made->of[0] = (struct weights *)(made->along[1] + texels);
  made->of[1] = made->of[0] + width;
  made->code = (uint8_t *)(made->of[1] + height);
  made->line = made->code + texels;
  if ((made->lines = cut_lines_make(tree))) return made;
  free(made);
  return NULL;
}

void cut_error_scratch_free(struct cut_error_scratch *scratch) {
  if (scratch) free(scratch->lines);
  free(scratch);
}

/* Whether weights, moved by so many samples, stay in the window: where a place rounds otherwise
 * than another they may have a sample more, which weighs next to nothing. */
static bool fit(const struct weights *weights, int by, int far_count) {
  return weights->first + by >= 0 && weights->first + weights->count + by <= far_count;
}

/* The weights of `part`, as shares of `node`. */
static void find_weights(const struct light_axis *axis, const struct cut_interval *node,
                         const struct cut_interval *part, double rate, double offset,
                         struct weights *weights) {
  const double scale = 1 / node->half, unit = node->half / node->moment[0];
  bool same = true; /* as in the middle */
  struct cut_sight sight = {.rate = rate, .scale = scale, .clipped = true};
  const double reach = fabs(rate) * part->half,
               shift = offset + rate * (part->center - node->center);
  const int middle = axis->far_count / 2;
  for (int n = 0; n < axis->far_count; ++n) {
    const int k = n == 0 ? middle : n <= middle ? n - 1 : n;
    struct cut_taps taps;
    sight.place = k + shift;
    bool inside = sight.place - reach >= 0 && sight.place + reach < axis->far_count - 1;
    if (n > 0 && inside && same && fit(&weights[middle], k - middle, axis->far_count)) {
      weights[k] = weights[middle];
      weights[k].first += k - middle;
      continue;
    }
    sight.clipped = !inside;
    same = same && (n > 0 || inside);
    if (!cut_taps_find(part, &sight, axis->far_count, &taps)) taps.count = 0;
    weights[k].first = taps.first;
    weights[k].count = taps.count;
    for (int tap = 0; tap < taps.count; ++tap)
      for (int m = 0; m < 2; ++m)
        weights[k].weight[m][tap] = (float)((double)taps.moment[m][tap] * unit);
  }
}

/* along[l][k] += sum of samples of a row. */
static void add_row(const float *row, const struct weights *weights, int count,
                    simd_float4 *along) {
  for (int k = 0; k < count; ++k) {
    const float *from = row + 3 * weights[k].first;
    simd_float4 sum = along[k];
    for (int tap = 0; tap < weights[k].count; ++tap)
      sum += SIMD_LOAD(simd_floats4, from + 3 * tap) * weights[k].weight[0][tap];
    along[k] = sum;
  }
}

static void add_node_row(const float *row, const struct weights *weights, int count,
                         simd_float4 *along, simd_float4 *slope) {
  for (int k = 0; k < count; ++k) {
    const float *from = row + CUT_FLOATS * weights[k].first;
    simd_float4 sum = {0}, other = {0};
    for (int tap = 0; tap < weights[k].count; ++tap, from += CUT_FLOATS) {
      float weight = weights[k].weight[0][tap];
      sum += SIMD_LOAD(simd_floats4, from) * weight +
             SIMD_LOAD(simd_floats4, from + 6) * weights[k].weight[1][tap];
      other += SIMD_LOAD(simd_floats4, from + 3) * weight +
               SIMD_LOAD(simd_floats4, from + 9) * weights[k].weight[1][tap];
    }
    along[k] = sum;
    slope[k] = other;
  }
}

/* off += sign * the sum along t. */
static void add_columns(const simd_float4 *along, const struct weights *weights, int moment,
                        float sign, int width, int height, simd_float4 *off) {
  for (int l = 0; l < height; ++l, off += width)
    for (int tap = 0; tap < weights[l].count; ++tap) {
      const simd_float4 *from = along + (weights[l].first + tap) * width;
      float weight = sign * weights[l].weight[moment][tap];
      for (int k = 0; k < width; ++k) off[k] += from[k] * weight;
    }
}

static void find_off(const struct cut_tree *tree, int level, const int at[2], double w,
                     double offset, struct cut_error_scratch *scratch) {
  const struct light_axis *axes = tree->page->axes;
  const int width = axes[0].far_count, height = axes[1].far_count, leaves = tree->levels - 1;
  const size_t stride = 3 * (size_t)slab_width(&tree->page->slab);
  const struct cut_interval *node[2];
  cut_intervals(tree, level, at, node);
  const double rate[2] = {-w / axes[0].far_step, -w / axes[1].far_step};
  size_t texels = cut_texels(tree);
  const float *image = cut_images(tree, level, at);
  for (int k = 0; k < 2; ++k)
    find_weights(&axes[k], node[k], node[k], rate[k], offset, scratch->of[k]);
  for (int l = 0; l < height; ++l)
    add_node_row(image + (size_t)l * (size_t)width * CUT_FLOATS, scratch->of[0], width,
                 scratch->along[0] + l * width, scratch->along[1] + l * width);
  for (size_t k = 0; k < texels; ++k) scratch->off[k] = (simd_float4){0};
  for (int m = 0; m < 2; ++m)
    add_columns(scratch->along[m], scratch->of[1], m, 1, width, height, scratch->off);
  for (int j = node[1]->first; j <= node[1]->last; ++j) {
    for (size_t k = 0; k < texels; ++k) scratch->along[0][k] = (simd_float4){0};
    for (int i = node[0]->first; i <= node[0]->last; ++i) {
      find_weights(&axes[0], node[0], &tree->axes[0].level[leaves][i], rate[0], offset,
                   scratch->of[0]);
      const float *from = cut_view(tree, (int[2]){i, j});
      for (int l = 0; l < height; ++l, from += stride)
        add_row(from, scratch->of[0], width, scratch->along[0] + l * width);
    }
    find_weights(&axes[1], node[1], &tree->axes[1].level[leaves][j], rate[1], offset,
                 scratch->of[1]);
    add_columns(scratch->along[0], scratch->of[1], 0, -1, width, height, scratch->off);
  }
}

/* The exponent and 3 bits of the mantissa, rounded up, relative to the largest sample: the inverse
 * of the table that set_scale makes (cut_build.c). */
static uint8_t encode(const struct cut_tree *tree, simd_float4 off) {
  simd_float4 size = simd_magnitude(off);
  float most = size[0] > size[1] ? size[0] : size[1];
  most = most > size[2] ? most : size[2];
  if (!(most > tree->error[1])) return most > 0;
  float share = most / tree->error[CUT_CODES - 1];
  if (!(share < 1)) return CUT_CODES - 1;
  uint32_t bits, top = 127u << 23;
  memcpy(&bits, &share, sizeof bits);
  uint32_t down = (top - bits) >> CUT_CODE_SHIFT;
  return (uint8_t)(down < CUT_CODES - 2 ? CUT_CODES - 1 - down : 1);
}

/* The largest code of the corners of each cell. */
static uint8_t largest(const uint8_t *corner, int across, int up) {
  uint8_t first = corner[0] > corner[across] ? corner[0] : corner[across];
  uint8_t second = corner[up] > corner[up + across] ? corner[up] : corner[up + across];
  return first > second ? first : second;
}

/* Encodes what is in `off`, where that is more than what is there. */
static void encode_all(const struct cut_tree *tree, struct cut_error_scratch *scratch) {
  size_t texels = cut_texels(tree);
  for (size_t k = 0; k < texels; ++k) {
    uint8_t code = encode(tree, scratch->off[k]);
    if (code > scratch->code[k]) scratch->code[k] = code;
  }
}

/* Stores codes; `out` is that of the first cell. */
static void store(const struct cut_tree *tree, struct cut_error_scratch *scratch, bool across,
                  bool up, uint8_t *out) {
  const int width = tree->page->axes[0].far_count, height = tree->page->axes[1].far_count;
  for (int l = 0; l < height; ++l)
    for (int k = 0; k < width; ++k, out += sizeof(struct cut_estimate))
      *out = largest(scratch->code + l * width + k, across && k + 1 < width,
                     up && l + 1 < height ? width : 0);
  memset(scratch->code, 0, cut_texels(tree));
}

/* The largest code within `reach` samples. */
static void spread_codes(const struct cut_tree *tree, struct cut_error_scratch *scratch,
                         int reach) {
  const int size[2] = {tree->page->axes[0].far_count, tree->page->axes[1].far_count};
  for (int axis = 0; axis < 2; ++axis) {
    int step = axis ? size[0] : 1, other = axis ? 1 : size[0];
    for (int m = 0; m < size[1 - axis]; ++m) {
      uint8_t *first = scratch->code + m * other;
      uint8_t *copy = scratch->line;
      for (int k = 0; k < size[axis]; ++k) copy[k] = first[k * step];
      for (int k = 0; k < size[axis]; ++k)
        for (int n = k > reach ? k - reach : 0; n <= k + reach && n < size[axis]; ++n)
          if (copy[n] > first[k * step]) first[k * step] = copy[n];
    }
  }
}

/* off = mean over the node's views of |view - node|. */
static void find_part(const struct cut_tree *tree, int level, const int at[2],
                      struct cut_error_scratch *scratch) {
  const struct light_axis *axes = tree->page->axes;
  const int width = axes[0].far_count, height = axes[1].far_count;
  const size_t texels = cut_texels(tree), stride = 3 * (size_t)slab_width(&tree->page->slab);
  const struct cut_interval *node[2];
  cut_intervals(tree, level, at, node);
  for (size_t k = 0; k < texels; ++k) scratch->off[k] = (simd_float4){0};
  for (int j = node[1]->first; j <= node[1]->last; ++j)
    for (int i = node[0]->first; i <= node[0]->last; ++i) {
      const struct cut_interval *u = &tree->axes[0].level[tree->levels - 1][i];
      const struct cut_interval *v = &tree->axes[1].level[tree->levels - 1][j];
      const float x = (float)((u->center - node[0]->center) / node[0]->half);
      const float y = (float)((v->center - node[1]->center) / node[1]->half);
      const float share =
          (float)(u->moment[0] * v->moment[0] / (node[0]->moment[0] * node[1]->moment[0]));
      const float *from = cut_images(tree, level, at), *view = cut_view(tree, (int[2]){i, j});
      simd_float4 *off = scratch->off;
      for (int l = 0; l < height; ++l, view += stride) {
        const float *rgb = view;
        for (int k = 0; k < width; ++k, from += CUT_FLOATS, rgb += 3, ++off) {
          simd_float4 d = SIMD_LOAD(simd_floats4, rgb) - SIMD_LOAD(simd_floats4, from) -
                          SIMD_LOAD(simd_floats4, from + 6) * x -
                          SIMD_LOAD(simd_floats4, from + 3) * y -
                          SIMD_LOAD(simd_floats4, from + 9) * (x * y);
          *off += simd_magnitude(d) * share;
        }
      }
    }
}

/* Errors of a node that is seen more than one st sample wide. */
static void measure_wide(struct cut_tree *tree, int level, const int at[2],
                         struct cut_error_scratch *scratch, struct cut_estimate *out) {
  const double widest = fmax(tree->axes[0].widest[level], tree->axes[1].widest[level]);
  for (int side = 0; side < (tree->page->axes[0].kappa > 0 ? 2 : 1); ++side)
    for (int spread = 0; spread < CUT_SPREADS; ++spread) {
      const double width = cut_narrowest * exp2(spread), aside = fmin(width / 4, 0.5);
      for (int place = 0; place < (width < 2 ? 3 : 2); ++place) {
        find_off(tree, level, at, (side ? -width : width) / widest,
                 place == 2 ? -aside : place * aside, scratch);
        encode_all(tree, scratch);
      }
      store(tree, scratch, true, true, &out->error[side][spread]);
    }
}

/* Errors of a node that is seen no wider. */
static void measure_narrow(struct cut_tree *tree, int level, const int at[2],
                           struct cut_error_scratch *scratch, struct cut_estimate *out) {
  simd_float4 *second = scratch->along[0];
  const size_t texels = cut_texels(tree);
  memset(second, 0, texels * sizeof *second);
  for (int axis = 0; axis < 2; ++axis) {
    cut_lines_measure(tree, level, at, axis, scratch->lines, scratch->off, second);
    encode_all(tree, scratch);
    store(tree, scratch, axis == 1, axis == 0, &out->line[axis]);
  }
  memcpy(scratch->off, second, texels * sizeof *second);
  encode_all(tree, scratch);
  store(tree, scratch, true, true, &out->second);
}

void cut_error_measure(struct cut_tree *tree, int level, const int at[2],
                       struct cut_error_scratch *scratch) {
  struct cut_estimate *out = cut_estimates(tree, level, at);
  measure_wide(tree, level, at, scratch, out);
  measure_narrow(tree, level, at, scratch, out);
  find_part(tree, level, at, scratch);
  encode_all(tree, scratch);
  store(tree, scratch, true, true, &out->part);
  encode_all(tree, scratch);
  spread_codes(tree, scratch, (int)cut_widest / 2);
  store(tree, scratch, true, true, &out->edge);
}
