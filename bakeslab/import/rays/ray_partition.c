/* ray_partition.c - a Bayesian mean over recursive partitions, by dynamic programming.
 *
 * The rays are a Poisson process, of even density in each box of a partition that is not known. A
 * density is 0 with the chance DARK; else its logarithm is spread evenly over RANGE nats (Jeffreys'
 * prior of a scale), so that the mean of what may be is the count over the exposure. A box is
 * halved with the chance HALVED, along each axis that it has alike.
 * 1. The nodes of each axis' tree are numbered so that halves come before what they are halves of,
 *    and a box by the numbers of its four nodes.
 * 2. Upwards: the evidence of a box is that of its even density, or that of the product of two
 *    halves' evidence, weighted by the chances.
 * 3. Downwards: the chance that a box is reached passes on to its halves in proportion to their
 *    evidence; what is left is the chance that it is a box of the partition. Its density then
 *    counts with that weight, and is handed down to its cells by way of its first axis.
 * Boxes without rays, and those that are hardly ever reached, are not halved.
 *
 * W. H. Wong and L. Ma, "Optional Polya tree and Bayesian inference", Annals of Statistics 38,
 * 2010, section 3, with a Poisson process instead of a probability; R. M. Willett and R. D. Nowak,
 * "Multiscale Poisson intensity and density estimation", IEEE Trans. Information Theory 53, 2007,
 * take the likeliest partition alone, and average it over shifts. */
#include "import/rays/ray_partition.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const double DARK = 0.25, HALVED = 0.5, RANGE = 20;
static const float HARDLY = 1e-5F; /* the chance of a box that is not looked into */
static const double MANY = 1e4;    /* rays for which a logarithm in single precision is too rough */

enum { AXES = SLAB_AXES, MOST_GIB = 4 };
/* The axes in the order of the raster, which is that of the boxes, too. */
static const int order[AXES] = {SLAB_V, SLAB_T, SLAB_U, SLAB_S};

/* An interval of cells; a single cell has no halves: left is -1. */
struct node {
  int low, left, right, size;
};

struct tree {
  int cells, count;
  struct node *nodes; /* owned */
};

struct box {
  float count, exposure;
};

struct work {
  const struct ray_cells *cells;
  struct tree trees[AXES];  /* in the order of the raster */
  size_t boxes, step[AXES]; /* between boxes whose node differs by 1 */
  size_t cell_step[AXES];   /* between cells */
  struct box *box;
  float *evidence; /* of each box: its logarithm, less what all partitions share */
  double scale;    /* exposures are multiplied by it, so that the mean density is 1 */
  double *density;
  struct ray_posterior posterior;
};

/* ---- Step 1 ---- */

/* Cuts [low, end) at the multiple of the largest power of two, up to `size`, less `before`. Returns
 * its number. */
static int cut(struct tree *tree, int low, int end, int before, int size) {
  struct node node = {.low = low, .left = -1, .right = -1, .size = end - low};
  if (node.size > 1) {
    int middle = end;
    while (middle >= end && size > 1) {
      size /= 2;
      middle = ((low + before) / size + 1) * size - before;
    }
    node.left = cut(tree, low, middle, before, size);
    node.right = cut(tree, middle, end, before, size);
  }
  tree->nodes[tree->count] = node;
  return tree->count++;
}

static bool grow(struct tree *tree, int cells, int before) {
  int size = 2;
  while (size / 2 < cells + before) size *= 2;
  tree->cells = cells;
  tree->nodes = malloc((2 * (size_t)cells - 1) * sizeof *tree->nodes);
  if (tree->nodes) cut(tree, 0, cells, before, size);
  return tree->nodes != NULL;
}

/* A box on its way through all of them. */
struct place {
  int at[AXES];
  const struct node *node[AXES];
};

static void stand(const struct work *work, struct place *place, int axis, int at) {
  place->at[axis] = at;
  place->node[axis] = &work->trees[axis].nodes[at];
}

/* At the row of boxes that begins with this number: only the last axis differs in it. */
static void stand_at_row(const struct work *work, struct place *place, size_t number) {
  for (int axis = 0; axis < AXES - 1; ++axis) {
    stand(work, place, axis, (int)(number / work->step[axis]));
    number %= work->step[axis];
  }
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

/* The logarithm of the sum of exp(even) * (1 - HALVED) and the mean of exp(halved[]) * HALVED.
 * Fills in, unless NULL, what share of that sum each is. */
static double weigh(double even, const double *halved, int axes, double *even_share,
                    double *shares) {
  double most = even, parts[AXES], kept = 1 - HALVED, each = HALVED / axes;
  for (int n = 0; n < axes; ++n) most = halved[n] > most ? halved[n] : most;
  double even_part = kept * (double)expf((float)(even - most)), sum = even_part;
  for (int n = 0; n < axes; ++n) sum += parts[n] = each * (double)expf((float)(halved[n] - most));
  if (even_share) {
    *even_share = even_part / sum;
    for (int n = 0; n < axes; ++n) shares[n] = parts[n] / sum;
  }
  return most + (double)logf((float)sum);
}

/* The halves of a box, along an axis that has any. */
static size_t half(const struct work *work, const struct place *place, size_t number, int axis,
                   int node) {
  return number - (size_t)(place->at[axis] - node) * work->step[axis];
}

/* The evidence of its halvings, `most` at most. Returns their number; the last axis comes first. */
static int halvings(const struct work *work, const struct place *place, size_t number, int most,
                    size_t halves[AXES][2], double *evidence) {
  int count = 0;
  for (int axis = AXES - 1; axis >= 0 && count < most; --axis) {
    const struct node *node = place->node[axis];
    if (node->left < 0) continue;
    size_t left = half(work, place, number, axis, node->left);
    size_t right = half(work, place, number, axis, node->right);
    halves[count][0] = left;
    halves[count][1] = right;
    evidence[count++] = (double)work->evidence[left] + (double)work->evidence[right];
  }
  return count;
}

static size_t cell_at(const struct work *work, const struct place *place) {
  size_t cell = 0;
  for (int axis = 0; axis < AXES; ++axis)
    cell += (size_t)place->node[axis]->low * work->cell_step[axis];
  return cell;
}

static void weigh_box(struct work *work, const struct place *place, size_t number) {
  struct box *box = &work->box[number];
  size_t halves[AXES][2];
  double evidence[AXES];
  int axes = halvings(work, place, number, 1, halves, evidence);
  if (axes > 0) {
    const struct box *left = &work->box[halves[0][0]], *right = &work->box[halves[0][1]];
    box->count = left->count + right->count;
    box->exposure = left->exposure + right->exposure;
  } else {
    size_t cell = cell_at(work, place);
    box->count = work->cells->count[cell];
    box->exposure = (float)((double)work->cells->exposure[cell] * work->scale);
  }
  if (!(box->count > 0)) {
    work->evidence[number] = (float)log(DARK);
    return;
  }
  double all = even_evidence((double)box->count, (double)box->exposure);
  if (axes > 0) {
    axes = halvings(work, place, number, AXES, halves, evidence);
    all = weigh(all, evidence, axes, NULL, NULL);
  }
  work->evidence[number] = (float)all;
}

static void weigh_boxes(struct work *work) {
  int row = work->trees[AXES - 1].count;
  for (size_t n = 0; n < work->boxes; n += (size_t)row) {
    struct place place;
    stand_at_row(work, &place, n);
    for (int at = 0; at < row; ++at) {
      stand(work, &place, AXES - 1, at);
      weigh_box(work, &place, n + (size_t)at);
    }
  }
}

/* ---- Step 3 ---- */

/* The boxes of one node of the first axis, on the way down. */
struct share {
  float chance, density;
};

struct layers {
  struct share *here, *half[2];
};

/* The density of a single cell, its box, is known. Variances are of densities less the mean one, so
 * that little is lost where all are nearly that. */
static void settle(struct work *work, const struct place *place, const struct box *box,
                   double density) {
  double square = (density - work->scale) * (density - work->scale);
  work->posterior.variance -= square * (double)box->exposure / work->scale;
  work->posterior.view_variance -= square;
  work->density[cell_at(work, place)] += density;
}

/* A box of the layer: what it keeps, and what its halves get. `inside` is its number there. */
static void hand_down(struct work *work, const struct place *place, struct layers *layers,
                      size_t first, size_t inside) {
  struct share *share = &layers->here[inside];
  const struct box *box = &work->box[first + inside];
  size_t halves[AXES][2];
  double evidence[AXES], shares[AXES], even_share = 1;
  double chance = (double)share->chance, count = (double)box->count;
  bool looked_into = count > 0 && share->chance > HARDLY;
  int axes = halvings(work, place, first + inside, looked_into ? AXES : 1, halves, evidence);
  looked_into &= axes > 0;
  if (looked_into)
    weigh(even_evidence(count, (double)box->exposure), evidence, axes, &even_share, shares);
  if (share->chance > 0) {
    double density = count / (double)box->exposure * work->scale, kept = chance * even_share;
    double off = density - work->scale, size = 1;
    double alike = count > 0 ? kept * density * density / count : 0;
    double squares = kept * off * off + alike;
    for (int axis = 0; axis < AXES; ++axis) size *= place->node[axis]->size;
    share->density += (float)(kept * density);
    work->posterior.variance += squares * (double)box->exposure / work->scale;
    /* Cells of a box err alike: the mean over its views errs no less than each. */
    double views = (double)place->node[0]->size * place->node[2]->size; /* V, U: see order[] */
    work->posterior.view_variance += size * (squares + (views - 1) * alike);
  }
  for (int n = 0; n < axes; ++n)
    for (int side = 0; side < 2; ++side) {
      /* halves along the first axis are in other layers, with lower numbers */
      bool out = layers->half[side] && halves[n][side] < first;
      struct share *to = out ? &layers->half[side][inside] : &layers->here[halves[n][side] - first];
      if (looked_into) to->chance += (float)(chance * shares[n]);
      if (n == 0) to->density += share->density;
    }
  if (axes == 0) settle(work, place, box, (double)share->density);
}

/* Takes the layer, which it frees. False without memory. */
static bool descend(struct work *work, int number, struct share *here) {
  const struct node *node = &work->trees[0].nodes[number];
  size_t size = work->step[0], first = (size_t)number * size;
  struct layers layers = {.here = here};
  bool split = node->left >= 0, good = here != NULL;
  for (int side = 0; side < 2 && split && good; ++side) {
    layers.half[side] = calloc(size, sizeof *here);
    good = layers.half[side] != NULL;
  }
  size_t row = (size_t)work->trees[AXES - 1].count;
  for (size_t n = size; n > 0 && good; n -= row) {
    struct place place;
    stand_at_row(work, &place, first + n - row);
    for (size_t at = row; at-- > 0;) {
      stand(work, &place, AXES - 1, (int)at);
      hand_down(work, &place, &layers, first, n - row + at);
    }
  }
  free(here);
  if (split && good) {
    good = descend(work, node->left, layers.half[0]);
    layers.half[0] = NULL;
  }
  if (split && good) {
    good = descend(work, node->right, layers.half[1]);
    layers.half[1] = NULL;
  }
  free(layers.half[0]);
  free(layers.half[1]);
  return good;
}

/* ---- All of it ---- */

/* Multiples of an odd number, so that the passes' cuts differ within boxes of every size. */
static int shift(int samples, int pass) {
  return pass * ((int)(0.36 * samples) | 1) % samples;
}

enum result ray_partition_check(const int samples[SLAB_AXES], struct error *error) {
  double boxes = 1, each = sizeof(struct box) + sizeof(float), gib = 1 << 30;
  for (int axis = 0; axis < AXES; ++axis) boxes *= 2.0 * samples[axis] - 1;
  if (boxes * each <= MOST_GIB * gib) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "%dx%d x %dx%d samples by rays need %.1f GiB of memory, more than the %d that "
                     "are allowed: take fewer by --uv and --st",
                     samples[SLAB_U], samples[SLAB_V], samples[SLAB_S], samples[SLAB_T],
                     boxes * each / gib, MOST_GIB);
}

static bool prepare(struct work *work, int pass) {
  size_t boxes = 1, cells = 1;
  double count = 0, exposure = 0;
  bool good = true;
  for (int axis = AXES - 1; axis >= 0 && good; --axis) {
    int samples = work->cells->samples[order[axis]];
    good = grow(&work->trees[axis], samples, shift(samples, pass));
    work->step[axis] = boxes;
    work->cell_step[axis] = cells;
    cells *= (size_t)samples;
    good &= !__builtin_mul_overflow(boxes, (size_t)(2 * samples - 1), &boxes);
  }
  for (size_t n = 0; n < cells && good; ++n) {
    count += (double)work->cells->count[n];
    exposure += (double)work->cells->exposure[n];
  }
  work->scale = count / exposure;
  work->boxes = boxes;
  good = good && boxes < SIZE_MAX / sizeof *work->box;
  work->box = good ? malloc(boxes * sizeof *work->box) : NULL;
  work->evidence = good ? malloc(boxes * sizeof *work->evidence) : NULL;
  return work->box && work->evidence;
}

enum result ray_partition_add(const struct ray_cells *cells, int pass, double *density,
                              struct ray_posterior *posterior, struct error *error) {
  struct work work = {.cells = cells, .density = density};
  bool good = prepare(&work, pass);
  if (good && work.scale > 0) {
    weigh_boxes(&work);
    struct share *top = calloc(work.step[0], sizeof *top);
    if (top) top[work.step[0] - 1].chance = 1;
    good = descend(&work, work.trees[0].count - 1, top);
  }
  *posterior = work.posterior;
  for (int axis = 0; axis < AXES; ++axis) free(work.trees[axis].nodes);
  free(work.box);
  free(work.evidence);
  return good ? RESULT_OK : result_no_memory(error);
}
