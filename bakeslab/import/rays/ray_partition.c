/* ray_partition.c - a Bayesian mean over recursive partitions, by dynamic programming.
 *
 * The rays are a Poisson process, of even density in each box of a partition that is not known. A
 * density is 0 with the chance DARK; else its logarithm is spread evenly over RANGE nats (Jeffreys'
 * prior of a scale), so that the mean of what may be is the count over the exposure. A box is
 * halved with the chance HALVED, along each axis that it has alike.
 * 1. The nodes of each axis' tree are numbered so that halves come before what they are halves of,
 *    and a box by the numbers of its four nodes (ray_boxes.c).
 * 2. Upwards: the evidence of a box is that of its even density, or that of the product of two
 *    halves' evidence, weighted by the chances.
 * 3. Downwards: the chance that a box is reached passes on to its halves in proportion to their
 *    evidence; what is left is the chance that it is a box of the partition. Its density then
 *    counts with that weight, and is handed down to its cells by way of its first axis.
 * 4. The mean of RAY_PASSES such densities is taken.
 * Boxes without rays, and those that are hardly ever reached, are not halved. On its way down a
 * layer is given something by one other layer alone, so that threads share those of one depth.
 *
 * W. H. Wong and L. Ma, "Optional Polya tree and Bayesian inference", Annals of Statistics 38,
 * 2010, section 3, with a Poisson process instead of a probability; R. M. Willett and R. D. Nowak,
 * "Multiscale Poisson intensity and density estimation", IEEE Trans. Information Theory 53, 2007,
 * take the likeliest partition alone, and average it over shifts. */
#include "import/rays/ray_partition.h"

#include <stdlib.h>
#include <string.h>

#include "base/tiles.h"

static const float HARDLY = 1e-5F; /* the chance of a box that is not looked into */

enum { LAST = RAY_BOXES_LAST, SUBTREES = 16 /* of the first axis, for threads */ };

/* What a box is given on the way down: its chance, and the density of the boxes that it is in. */
struct share {
  float chance, density;
};

/* One way down. */
struct work {
  struct ray_boxes boxes;
  double *density;
  /* Of each node of the first axis: */
  struct share **waiting;          /* its layer, once that was given something; owned */
  struct ray_posterior *posterior; /* sums over passes; owned */
};

/* A layer on its way, and those of its node's halves. */
struct layer {
  size_t first; /* its first box */
  struct share *here, *half[2];
  struct ray_posterior *posterior;
};

/* ---- Step 3 ---- */

/* The density of a single cell, its box, is known. Variances are of densities less the mean one, so
 * that little is lost where all are nearly that. */
static void settle(const struct work *work, const struct layer *layer, size_t cell,
                   const struct ray_box *box, double density) {
  double scale = work->boxes.scale, square = (density - scale) * (density - scale);
  layer->posterior->variance -= square * (double)box->exposure / scale;
  layer->posterior->view_variance -= square;
  work->density[cell] += density / RAY_PASSES;
}

/* A box with the chance `kept` of being one of the partition. */
static void keep(const struct work *work, const struct layer *layer, const struct ray_row *row,
                 int at, double kept, struct share *share) {
  const struct ray_node *t = row->node[0], *v = row->node[1], *u = row->node[2];
  const struct ray_box *box = &work->boxes.box[row->first + (size_t)at];
  double scale = work->boxes.scale, count = (double)box->count;
  double density = count / (double)box->exposure * scale, off = density - scale;
  double alike = count > 0 ? kept * density * density / count : 0;
  double squares = kept * off * off + alike;
  share->density += (float)(kept * density);
  layer->posterior->variance += squares * (double)box->exposure / scale;
  /* Cells of a box err alike: the mean over its views errs no less than each. */
  double views = (double)u->size * v->size;
  double size = views * t->size * work->boxes.trees[LAST].nodes[at].size;
  layer->posterior->view_variance += size * (squares + (views - 1) * alike);
}

/* A box of the layer: what it keeps, and what its halves get. */
static void hand_down(const struct work *work, struct layer *layer, const struct ray_row *row,
                      int at) {
  const struct ray_boxes *boxes = &work->boxes;
  size_t number = row->first + (size_t)at, halves[SLAB_AXES][2];
  struct share *share = &layer->here[number - layer->first];
  const struct ray_box *box = &boxes->box[number];
  double evidence[SLAB_AXES], shares[SLAB_AXES], even = 1, chance = (double)share->chance;
  bool looked_into = box->count > 0 && share->chance > HARDLY;
  int pairs = ray_boxes_halves(boxes, row, at, looked_into ? SLAB_AXES : 1, halves, evidence);
  looked_into &= pairs > 0;
  if (looked_into) ray_boxes_evidence(box, evidence, pairs, &even, shares);
  if (share->chance > 0) keep(work, layer, row, at, chance * even, share);
  for (int n = 0; n < pairs; ++n)
    for (int side = 0; side < 2; ++side) {
      /* halves along the first axis are in other layers, with lower numbers */
      bool out = layer->half[side] && halves[n][side] < layer->first;
      struct share *to = out ? &layer->half[side][number - layer->first]
                             : &layer->here[halves[n][side] - layer->first];
      if (looked_into) to->chance += (float)(chance * shares[n]);
      if (n == 0) to->density += share->density;
    }
  if (pairs == 0) settle(work, layer, ray_boxes_cell(boxes, row, at), box, (double)share->density);
}

/* Hands down the waiting layer of a node, and frees it; those of its halves then wait. */
static enum result hand_down_layer(struct work *work, int number, struct error *error) {
  const struct ray_node *node = &work->boxes.trees[0].nodes[number];
  size_t size = work->boxes.step[0], boxes = (size_t)work->boxes.trees[LAST].count;
  struct layer layer = {.first = (size_t)number * size,
                        .here = work->waiting[number],
                        .posterior = &work->posterior[number]};
  for (int side = 0; side < 2 && node->left >= 0; ++side) {
    layer.half[side] = calloc(size, sizeof *layer.here);
    work->waiting[side ? node->right : node->left] = layer.half[side];
    if (!layer.half[side]) return result_no_memory(error);
  }
  for (size_t n = layer.first + size; n > layer.first; n -= boxes) {
    struct ray_row row = ray_boxes_row(&work->boxes, n - boxes);
    for (size_t at = boxes; at-- > 0;) hand_down(work, &layer, &row, (int)at);
  }
  free(layer.here);
  work->waiting[number] = NULL;
  return RESULT_OK;
}

static enum result hand_down_one(void *work, int tile, int worker, struct error *error) {
  (void)worker;
  return hand_down_layer(work, ((struct work *)work)->boxes.list[tile], error);
}

/* With all below it. */
static enum result descend(struct work *work, int number, struct error *error) {
  const struct ray_node *node = &work->boxes.trees[0].nodes[number];
  enum result result = hand_down_layer(work, number, error);
  if (result == RESULT_OK && node->left >= 0) result = descend(work, node->left, error);
  if (result == RESULT_OK && node->left >= 0) result = descend(work, node->right, error);
  return result;
}

static enum result descend_one(void *work, int tile, int worker, struct error *error) {
  (void)worker;
  return descend(work, ((struct work *)work)->boxes.list[tile], error);
}

/* Lists the nodes whose layers wait. */
static int list_waiting(struct work *work) {
  int listed = 0;
  for (int n = 0; n < work->boxes.trees[0].count; ++n)
    if (work->waiting[n]) work->boxes.list[listed++] = n;
  return listed;
}

static enum result hand_down_layers(struct work *work, struct error *error) {
  int root = work->boxes.trees[0].count - 1, threads = work->boxes.cells->threads, listed = 1;
  size_t size = work->boxes.step[0];
  struct share *top = work->waiting[root] = calloc(size, sizeof *top);
  enum result result = top ? RESULT_OK : result_no_memory(error);
  if (top) top[size - 1].chance = 1;
  while (listed > 0 && listed < SUBTREES && result == RESULT_OK) {
    listed = list_waiting(work);
    result = tiles_run(threads, listed, listed < SUBTREES ? hand_down_one : descend_one, NULL, work,
                       error);
  }
  for (int n = 0; n <= root; ++n) {
    free(work->waiting[n]);
    work->waiting[n] = NULL;
  }
  return result;
}

/* ---- All of it ---- */

static enum result add_passes(struct work *work, struct error *error) {
  size_t nodes = 2 * (size_t)work->boxes.cells->samples[SLAB_T];
  work->waiting = calloc(nodes, sizeof *work->waiting);
  work->posterior = calloc(nodes, sizeof *work->posterior);
  if (!work->waiting || !work->posterior) return result_no_memory(error);
  enum result result = RESULT_OK;
  for (int pass = 0; pass < RAY_PASSES && result == RESULT_OK; ++pass) {
    result = ray_boxes_weigh(&work->boxes, pass, error);
    if (result == RESULT_OK) result = hand_down_layers(work, error);
  }
  return result;
}

enum result ray_partition(const struct ray_cells *cells, double *density,
                          struct ray_posterior *posterior, struct error *error) {
  struct work work = {.density = density};
  size_t count = 1;
  for (int axis = 0; axis < SLAB_AXES; ++axis) count *= (size_t)cells->samples[axis];
  memset(density, 0, count * sizeof *density);
  *posterior = (struct ray_posterior){0};
  enum result result = ray_boxes_new(cells, &work.boxes, error);
  if (result == RESULT_OK && work.boxes.scale > 0) result = add_passes(&work, error);
  for (int n = 0; work.posterior && n < work.boxes.trees[0].count; ++n) {
    posterior->variance += work.posterior[n].variance / RAY_PASSES;
    posterior->view_variance += work.posterior[n].view_variance / RAY_PASSES;
  }
  ray_boxes_free(&work.boxes);
  free(work.waiting);
  free(work.posterior);
  return result;
}
