/* cut_build.c - builds the tree of cut_tree.h, from the views up. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/tiles.h"
#include "cut/cut.h"
#include "cut/cut_tree.h"
#include "microlight/seen_page.h"

void cut_free(struct cut_tree *tree) {
  if (!tree) return;
  for (int level = 0; level < CUT_LEVELS; ++level) {
    free(tree->level[level].images);
    free(tree->level[level].estimates);
  }
  for (int axis = 0; axis < 2; ++axis) cut_axis_free(&tree->axes[axis]);
  free(tree);
}

static enum result allocate(struct cut_tree *tree, struct error *error) {
  for (int level = 0; level < tree->levels - 1; ++level) {
    size_t nodes = (size_t)tree->axes[0].count[level] * (size_t)tree->axes[1].count[level];
    size_t texels = nodes * cut_texels(tree);
    struct cut_level *made = &tree->level[level];
    made->images = calloc(texels * CUT_FLOATS + CUT_PADDING, sizeof *made->images);
    made->estimates = calloc(texels, sizeof *made->estimates);
    if (!made->images || !made->estimates) return result_no_memory(error);
  }
  return RESULT_OK;
}

/* ---- Images ---- */

/* One child's share in a node, along each axis: of its radiance in the node's mean and slope, and
 * of its own slope in the node's. */
struct share {
  float mean[2], slope[2], own[2];
};

static struct share find_share(const struct cut_interval *node[2],
                               const struct cut_interval *child[2]) {
  struct share share;
  for (int axis = 0; axis < 2; ++axis) {
    const struct cut_interval *n = node[axis], *c = child[axis];
    double per = n->half / n->moment[2];
    share.mean[axis] = (float)(c->moment[0] / n->moment[0]);
    share.slope[axis] = (float)(per * (c->center - n->center) * c->moment[0]);
    share.own[axis] = (float)(per * c->moment[2] / c->half);
  }
  return share;
}

/* Adds a child with images of its own. */
static void add_node(const float *child, size_t texels, const struct share *share, float *out) {
  for (size_t k = 0; k < texels; ++k, child += CUT_FLOATS, out += CUT_FLOATS)
    for (int c = 0; c < 3; ++c) {
      float mean[2] = {share->mean[0] * child[c], share->mean[0] * child[3 + c]};
      float slope[2] = {share->slope[0] * child[c] + share->own[0] * child[6 + c],
                        share->slope[0] * child[3 + c] + share->own[0] * child[9 + c]};
      out[c] += share->mean[1] * mean[0];
      out[3 + c] += share->slope[1] * mean[0] + share->own[1] * mean[1];
      out[6 + c] += share->mean[1] * slope[0];
      out[9 + c] += share->slope[1] * slope[0] + share->own[1] * slope[1];
    }
}

/* Adds a single view. */
static void add_view(const struct cut_tree *tree, const int at[2], const struct share *share,
                     float *out) {
  const size_t stride = 3 * (size_t)slab_width(&tree->page->slab);
  const float *row = cut_view(tree, at);
  for (int l = 0; l < tree->page->axes[1].far_count; ++l, row += stride) {
    const float *from = row;
    for (int k = 0; k < tree->page->axes[0].far_count; ++k, from += 3, out += CUT_FLOATS)
      for (int c = 0; c < 3; ++c) {
        float mean = share->mean[0] * from[c], slope = share->slope[0] * from[c];
        out[c] += share->mean[1] * mean;
        out[3 + c] += share->slope[1] * mean;
        out[6 + c] += share->mean[1] * slope;
        out[9 + c] += share->slope[1] * slope;
      }
  }
}

struct build {
  struct cut_tree *tree;
  int level;
  struct cut_error_scratch **scratch; /* one for each thread */
};

static enum result make_images(void *context, int tile, int worker, struct error *error) {
  (void)worker;
  (void)error;
  const struct build *build = context;
  const struct cut_tree *tree = build->tree;
  int level = build->level, along = tree->axes[0].count[level];
  int at[2] = {tile % along, tile / along};
  const struct cut_interval *node[2], *child[2];
  cut_intervals(tree, level, at, node);
  float *out = cut_images(tree, level, at);
  for (int q = 0; q < node[1]->children; ++q)
    for (int p = 0; p < node[0]->children; ++p) {
      int from[2] = {node[0]->child + p, node[1]->child + q};
      cut_intervals(tree, level + 1, from, child);
      struct share share = find_share(node, child);
      if (level + 1 == tree->levels - 1)
        add_view(tree, from, &share, out);
      else
        add_node(cut_images(tree, level + 1, from), cut_texels(tree), &share, out);
    }
  return RESULT_OK;
}

/* ---- Errors ---- */

static float largest_of(const float *rgb) {
  return fmaxf(fmaxf(rgb[0], rgb[1]), rgb[2]);
}

static void set_scale(struct cut_tree *tree) {
  float most = 0, least = 0;
  size_t floats = 3 * slab_sample_count(&tree->page->slab);
  for (size_t k = 0; k < floats; ++k) {
    most = fmaxf(most, fabsf(tree->page->slab.rgb[k]));
    least = fminf(least, tree->page->slab.rgb[k]);
  }
  tree->least = least < 0 ? -INFINITY : 0;
  for (int code = 1; code < CUT_CODES; ++code) {
    uint32_t bits = (127u << 23) - ((uint32_t)(CUT_CODES - 1 - code) << CUT_CODE_SHIFT);
    float share;
    memcpy(&share, &bits, sizeof share);
    tree->error[code] = most * share;
  }
  tree->brightest = tree->levels < 2 ? most : 0;
  for (size_t k = 0; tree->levels > 1 && k < cut_texels(tree); ++k)
    tree->brightest = fmax(tree->brightest, largest_of(tree->level[0].images + k * CUT_FLOATS));
  tree->hemisphere = M_PI * tree->brightest;
  tree->brightest *= tree->axes[0].level[0]->moment[0] * tree->axes[1].level[0]->moment[0];
}

/* The mean of M over cells. */
static void make_means(struct cut_tree *tree, int level, const int at[2]) {
  int width = tree->page->axes[0].far_count, height = tree->page->axes[1].far_count;
  const float *image = cut_images(tree, level, at);
  struct cut_estimate *out = cut_estimates(tree, level, at);
  for (int l = 0; l < height; ++l)
    for (int k = 0; k < width; ++k, ++out) {
      size_t across = k + 1 < width, up = l + 1 < height ? (size_t)width : 0;
      const float *corner = image + CUT_FLOATS * ((size_t)l * (size_t)width + (size_t)k);
      float sum = largest_of(corner) + largest_of(corner + CUT_FLOATS * across) +
                  largest_of(corner + CUT_FLOATS * up) +
                  largest_of(corner + CUT_FLOATS * (up + across));
      uint32_t bits;
      sum /= 4;
      memcpy(&bits, &sum, sizeof bits);
      out->mean = (uint16_t)(bits >> 16);
    }
}

static enum result make_errors(void *context, int tile, int worker, struct error *error) {
  const struct build *build = context;
  struct cut_tree *tree = build->tree;
  int level = 0;
  for (;; ++level) {
    int nodes = tree->axes[0].count[level] * tree->axes[1].count[level];
    if (tile < nodes) break;
    tile -= nodes;
  }
  struct cut_error_scratch **scratch = &build->scratch[worker];
  if (!*scratch) *scratch = cut_error_scratch(tree);
  if (!*scratch) return result_no_memory(error);
  int along = tree->axes[0].count[level];
  int at[2] = {tile % along, tile / along};
  make_means(tree, level, at);
  cut_error_measure(tree, level, at, *scratch);
  return RESULT_OK;
}

static enum result build_tree(struct cut_tree *tree, int threads, struct error *error) {
  const struct light_axis *axes = tree->page->axes;
  int counts[2] = {cut_axis_levels(axes[0].near_count), cut_axis_levels(axes[1].near_count)};
  tree->levels = counts[0] > counts[1] ? counts[0] : counts[1];
  if (tree->levels > CUT_LEVELS)
    return result_fail(error, RESULT_BAD,
                       "more than %d views along an edge: method cut has no tree",
                       1 << (CUT_LEVELS - 1));
  enum result result = RESULT_OK;
  for (int axis = 0; axis < 2 && result == RESULT_OK; ++axis)
    result = cut_axis_make(&axes[axis], tree->levels, &tree->axes[axis], error);
  for (int level = 0; level < tree->levels; ++level)
    for (int axis = 0; axis < 2; ++axis) tree->fours += (tree->axes[axis].count[level] + 3) / 4;
  if (result == RESULT_OK) result = allocate(tree, error);
  struct build build = {.tree = tree};
  int nodes = 0;
  for (int level = tree->levels - 2; level >= 0 && result == RESULT_OK; --level) {
    int here = tree->axes[0].count[level] * tree->axes[1].count[level];
    build.level = level;
    result = tiles_run(threads, here, make_images, NULL, &build, error);
    nodes += here;
  }
  if (result != RESULT_OK) return result;
  set_scale(tree);
  build.scratch = calloc((size_t)threads, sizeof *build.scratch);
  if (!build.scratch) return result_no_memory(error);
  result = tiles_run(threads, nodes, make_errors, NULL, &build, error);
  for (int k = 0; k < threads; ++k) cut_error_scratch_free(build.scratch[k]);
  free(build.scratch);
  return result;
}

static void set_page(struct cut_tree *tree, const struct light_page *page) {
  const int exponent = ilogb(2 * fmax(page->axes[0].half, page->axes[1].half));
  tree->own = *page;
  tree->page = &tree->own;
  tree->per_unit = ldexp(1, -exponent);
  for (int k = 0; k < 2; ++k) {
    struct light_axis *axis = &tree->own.axes[k];
    axis->half = ldexp(axis->half, -exponent);
    axis->near_step = ldexp(axis->near_step, -exponent);
    axis->kappa = ldexp(axis->kappa, exponent);
  }
}

enum result cut_build(const struct light_page *page, int threads, struct cut_tree **made,
                      struct error *error) {
  struct cut_tree *tree = calloc(1, sizeof *tree);
  if (!tree) return result_no_memory(error);
  set_page(tree, page);
  enum result result = build_tree(tree, threads, error);
  if (result != RESULT_OK) {
    cut_free(tree);
    tree = NULL;
  }
  *made = tree;
  return result;
}
