/* ray_boxes.c - steps 1 and 2 of ray_partition.c. Layers whose nodes are of one height do not
 * depend on each other: threads share them. */
#include "import/rays/ray_boxes.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/tiles.h"

static const double DARK = 0.25, HALVED = 0.5, RANGE = 20;
static const double MANY = 1e4; /* rays for which a logarithm in single precision is too rough */

enum { AXES = SLAB_AXES, LAST = RAY_BOXES_LAST, MOST_GIB = 4 };
/* T first: of the axes that are not rows it has the most nodes for threads to share. */
static const int order[AXES] = {SLAB_T, SLAB_V, SLAB_U, SLAB_S};

/* ---- Step 1 ---- */

/* Cuts [low, end) at the multiple of the largest power of two, up to `size`, less `before`. Returns
 * its number. */
static int cut(struct ray_tree *tree, int low, int end, int before, int size) {
  struct ray_node node = {.low = low, .left = -1, .right = -1, .size = end - low};
  if (node.size > 1) {
    int middle = end;
    while (middle >= end && size > 1) {
      size /= 2;
      middle = ((low + before) / size + 1) * size - before;
    }
    node.left = cut(tree, low, middle, before, size);
    node.right = cut(tree, middle, end, before, size);
    int left = tree->nodes[node.left].height, right = tree->nodes[node.right].height;
    node.height = 1 + (left > right ? left : right);
  }
  tree->nodes[tree->count] = node;
  return tree->count++;
}

static void grow(struct ray_tree *tree, int cells, int before) {
  int size = 2;
  while (size / 2 < cells + before) size *= 2;
  tree->count = 0;
  cut(tree, 0, cells, before, size);
}

/* Multiples of an odd number, so that the passes' cuts differ within boxes of every size. */
static int shift(int samples, int pass) {
  return pass * ((int)(0.36 * samples) | 1) % samples;
}

struct ray_row ray_boxes_row(const struct ray_boxes *boxes, size_t first) {
  struct ray_row row = {.first = first};
  size_t left = first;
  for (int axis = 0; axis < LAST; ++axis) {
    row.node[axis] = &boxes->trees[axis].nodes[left / boxes->step[axis]];
    row.cell += (size_t)row.node[axis]->low * boxes->cell_step[axis];
    left %= boxes->step[axis];
  }
  for (int axis = LAST - 1; axis >= 0; --axis) {
    const struct ray_node *node = row.node[axis];
    size_t at = (size_t)(node - boxes->trees[axis].nodes);
    if (node->left < 0) continue;
    row.halves[row.across][0] = first - (at - (size_t)node->left) * boxes->step[axis];
    row.halves[row.across++][1] = first - (at - (size_t)node->right) * boxes->step[axis];
  }
  return row;
}

/* ---- Step 2 ---- */

/* The logarithm of the evidence of an even density in a box with rays: that of
 * Gamma(count) / exposure^count / RANGE, with Stirling's series, less that of e^-count, which all
 * partitions share. Less than one ray counts as Gamma(1). */
static double even_evidence(double count, double exposure) {
  const double constant = log((1 - DARK) / RANGE), half_log_two_pi = 0.91893853320467274;
  if (count < 1) return constant + count * (1 - log(exposure));
  double part = 1 / (count * count), ratio = count / exposure;
  double log_ratio = count < MANY ? (double)logf((float)ratio) : log(ratio);
  return constant + count * log_ratio - 0.5 * (double)logf((float)count) + half_log_two_pi +
         (1.0 / 12 - part * (1.0 / 360 - part / 1260)) / count;
}

/* e^x, or 0 where that is lost beside 1. */
static double exponential(double x) {
  return x > -20 ? (double)expf((float)x) : 0;
}

/* That of the sum of exp(even) * (1 - HALVED) and the mean of exp(halves[]) * HALVED. */
double ray_boxes_evidence(const struct ray_box *box, const double *halves, int pairs, double *even,
                          double *shares) {
  double all = even_evidence((double)box->count, (double)box->exposure), most = all, parts[AXES];
  if (pairs == 0) return all;
  for (int n = 0; n < pairs; ++n) most = halves[n] > most ? halves[n] : most;
  double kept = (1 - HALVED) * exponential(all - most), sum = kept, each = HALVED / pairs;
  for (int n = 0; n < pairs; ++n) sum += parts[n] = each * exponential(halves[n] - most);
  if (even) {
    *even = kept / sum;
    for (int n = 0; n < pairs; ++n) shares[n] = parts[n] / sum;
  }
  return most + (double)logf((float)sum);
}

static void weigh(struct ray_boxes *boxes, const struct ray_row *row, int at) {
  size_t number = row->first + (size_t)at, halves[AXES][2];
  struct ray_box *box = &boxes->box[number];
  double evidence[AXES];
  int pairs = ray_boxes_halves(boxes, row, at, 1, halves, evidence);
  if (pairs > 0) {
    const struct ray_box *left = &boxes->box[halves[0][0]], *right = &boxes->box[halves[0][1]];
    box->count = left->count + right->count;
    box->exposure = left->exposure + right->exposure;
  } else {
    size_t cell = ray_boxes_cell(boxes, row, at);
    box->count = boxes->cells->count[cell];
    box->exposure = (float)((double)boxes->cells->exposure[cell] * boxes->scale);
  }
  double all = log(DARK);
  if (box->count > 0) {
    pairs = ray_boxes_halves(boxes, row, at, AXES, halves, evidence);
    all = ray_boxes_evidence(box, evidence, pairs, NULL, NULL);
  }
  boxes->evidence[number] = (float)all;
}

static enum result weigh_layer(void *context, int tile, int worker, struct error *error) {
  struct ray_boxes *boxes = context;
  size_t first = (size_t)boxes->list[tile] * boxes->step[0], end = first + boxes->step[0];
  int count = boxes->trees[LAST].count;
  (void)worker, (void)error;
  for (size_t n = first; n < end; n += (size_t)count) {
    struct ray_row row = ray_boxes_row(boxes, n);
    for (int at = 0; at < count; ++at) weigh(boxes, &row, at);
  }
  return RESULT_OK;
}

enum result ray_boxes_weigh(struct ray_boxes *boxes, int pass, struct error *error) {
  const struct ray_tree *tree = &boxes->trees[0];
  enum result result = RESULT_OK;
  for (int axis = 0; axis < AXES; ++axis) {
    int samples = boxes->cells->samples[order[axis]];
    grow(&boxes->trees[axis], samples, shift(samples, pass));
  }
  int most = tree->nodes[tree->count - 1].height;
  for (int height = 0; height <= most && result == RESULT_OK; ++height) {
    int listed = 0;
    for (int n = 0; n < tree->count; ++n)
      if (tree->nodes[n].height == height) boxes->list[listed++] = n;
    result = tiles_run(boxes->cells->threads, listed, weigh_layer, NULL, boxes, error);
  }
  return result;
}

/* ---- Memory ---- */

enum result ray_boxes_check(const int samples[SLAB_AXES], struct error *error) {
  double boxes = 1, each = sizeof(struct ray_box) + sizeof(float), gib = 1 << 30;
  for (int axis = 0; axis < SLAB_AXES; ++axis) boxes *= 2.0 * samples[axis] - 1;
  if (boxes * each <= MOST_GIB * gib) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "%dx%d x %dx%d samples by rays need %.1f GiB of memory, more than the %d that "
                     "are allowed: take fewer by --uv and --st",
                     samples[SLAB_U], samples[SLAB_V], samples[SLAB_S], samples[SLAB_T],
                     boxes * each / gib, MOST_GIB);
}

/* Fills the steps, and counts cells. */
static size_t find_steps(struct ray_boxes *boxes) {
  static const int raster[AXES] = {3, 2, 0, 1}; /* numbers of S, U, T and V in order[] */
  size_t cells = 1;
  boxes->boxes = 1;
  for (int n = 0; n < AXES; ++n) {
    boxes->cell_step[raster[n]] = cells;
    cells *= (size_t)boxes->cells->samples[order[raster[n]]];
  }
  for (int axis = LAST; axis >= 0; --axis) {
    boxes->step[axis] = boxes->boxes;
    boxes->boxes *= 2 * (size_t)boxes->cells->samples[order[axis]] - 1;
  }
  return cells;
}

enum result ray_boxes_new(const struct ray_cells *cells, struct ray_boxes *boxes,
                          struct error *error) {
  double count = 0, exposure = 0;
  *boxes = (struct ray_boxes){.cells = cells};
  enum result result = ray_boxes_check(cells->samples, error);
  if (result != RESULT_OK) return result;
  size_t all = find_steps(boxes);
  for (size_t n = 0; n < all; ++n) {
    count += (double)cells->count[n];
    exposure += (double)cells->exposure[n];
  }
  boxes->scale = count / exposure;
  boxes->box = malloc(boxes->boxes * sizeof *boxes->box);
  boxes->evidence = malloc(boxes->boxes * sizeof *boxes->evidence);
  boxes->list = malloc(2 * (size_t)cells->samples[order[0]] * sizeof *boxes->list);
  bool good = boxes->box && boxes->evidence && boxes->list;
  for (int axis = 0; axis < AXES; ++axis) {
    size_t nodes = 2 * (size_t)cells->samples[order[axis]] - 1;
    boxes->trees[axis].nodes = malloc(nodes * sizeof *boxes->trees[axis].nodes);
    good &= boxes->trees[axis].nodes != NULL;
  }
  return good ? RESULT_OK : result_no_memory(error);
}

void ray_boxes_free(struct ray_boxes *boxes) {
  for (int axis = 0; axis < AXES; ++axis) free(boxes->trees[axis].nodes);
  free(boxes->box);
  free(boxes->evidence);
  free(boxes->list);
  *boxes = (struct ray_boxes){0};
}
