/* cut.c - the error-driven cut through the quadtree of (u, v) blocks.
 *
 * Lightcuts (Walter et al., "Lightcuts: a scalable approach to illumination", SIGGRAPH 2005) sum
 * over a cut through a tree of point lights, which for each receiver is refined where its error
 * bound is largest. Here the tree is the paper's hierarchy (section 4.2): a node is a block of
 * views, radiance linear in u and v. Errors are not bounded but estimated, from what was measured
 * when the tree was built (cut_error.c) and from what the kernel's expansion leaves out.
 *
 *   1. Start with the root, or with the first level whose nodes are seen as at most 8 st samples
 *      wide.
 *   2. Estimate the light and the error of its nodes (cut_seen.h).
 *   3. While the error of the sum is more than the tolerance, replace the node with the largest
 *      error by its children.
 *   4. Sum the nodes. Where they are brighter than was estimated, and the kernel's part of the
 *      error with them, go on with 3, at most 4 times.
 *   5. Give up once the cut costs, or is likely to cost, more than what it replaces. That is the
 *      sum over all views at once (cut_views.h), as near the aperture, where this is exact enough.
 *      Otherwise cut_sum returns false, and the micro lights do it: for glossy receivers, where
 *      the tangent plane cuts the aperture, and at the aperture.
 * Where the root alone is exact enough, cut_roots.c does the same for four receivers at once.
 * All of these keep the tolerance, so nothing is seen where one hands over to another. Giving up
 * costs a few percent of the micro lights. */
#include "cut/cut.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cut/cut_allowed.h"
#include "cut/cut_seen.h"
#include "cut/cut_views.h"
#include "microlight/rule.h"

enum { NODES = 1024, ROUNDS = 4 };

/* Costs in nanoseconds, of which only the ratios matter: of a node, of an st sample of a node, of
 * a micro light summed by the rule pi, of a strip of them; by Gauss rules instead of pi. */
static const double node_cost = 70, sample_cost = 3, light_cost = 8, strip_cost = 36, gauss = 3;

/* Shares of the cost of what it replaces: a cut must cost less than `worth`, and is given up where
 * its estimated cost is more than `hopeless`. */
static const double worth = 0.7, hopeless = 12;

/* Where the window cuts nodes: of what is aimed at. */
static const double clipped_margin = 0.4;

struct ranked {
  double error;
  int node; /* its place in cut_work.node */
};

struct cut_work {
  struct cut_seen seen;
  struct cut_views *views;         /* owned */
  struct cut_node node[NODES + 4]; /* of the cut, and free places */
  struct ranked heap[NODES + 4]; /* of the cut, the largest error first; beyond `count`, of the free
                                  places */
  int count;
  double light, curvature, spread, square, cost; /* of the cut: sums of its nodes' */
  double error;                                  /* of these sums */
  double tolerance;
  double budget;      /* cost of what the cut replaces; 0: not known yet */
  int view_nodes;     /* a side, in a sum over all views; 0: no number is exact enough */
  double views_error; /* predicted of that sum */
  uint64_t visited;   /* nodes that were estimated */
};

struct cut_work *cut_work_make(void) {
  struct cut_work *made = calloc(1, sizeof *made);
  for (int k = 0; made && k < NODES + 4; ++k) made->heap[k].node = k;
  if (!made || (made->views = cut_views_make())) return made;
  free(made);
  return NULL;
}

void cut_work_free(struct cut_work *work) {
  if (!work) return;
  cut_seen_free(&work->seen);
  cut_views_free(work->views);
  free(work);
}

/* The cost of all views at once, and with how many nodes; or, where these are not exact enough, of
 * the micro lights, summed by pi or else by Gauss rules. */
static double find_budget(struct cut_work *work) {
  const struct seen_page *seen = work->seen.seen;
  work->view_nodes = cut_views_nodes(seen, work->tolerance, &work->views_error);
  if (work->view_nodes > 0) return cut_views_price(seen, work->view_nodes);
  double strips[2], widest = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const struct light_axis *along = &seen->page->axes[axis];
    const double near = along->near_step * work->seen.per_height;
    const double far = along->far_step / fabs(along->kappa * seen->height - 1);
    const double cells = 2 * along->half / fabs(along->far_step) * fabs(work->seen.w);
    const double share = cells > along->far_count ? along->far_count / cells : 1;
    strips[axis] = 1 + cells * share + share * along->near_count;
    widest = fmax(widest, fmin(near, far));
  }
  const double error = rule_pi_error(widest, 0, 0);
  const double cost = light_cost * strips[0] * strips[1] + strip_cost * (strips[0] + strips[1]);
  return error <= work->tolerance ? cost : gauss * cost;
}

/* ---- The nodes of the cut ---- */

static double error_of(const struct cut_node *node) {
  return node->curvature + node->spread;
}

static double node_price(const struct cut_work *work, int level) {
  return node_cost + sample_cost * work->seen.level[level].samples;
}

/* The node is in the first free place. */
static void push(struct cut_work *work, double price) {
  struct ranked *heap = work->heap;
  int k = work->count++;
  const int place = heap[k].node;
  const struct cut_node *node = &work->node[place];
  const double error = error_of(node);
  for (; k > 0 && heap[(k - 1) / 2].error < error; k = (k - 1) / 2) heap[k] = heap[(k - 1) / 2];
  heap[k] = (struct ranked){error, place};
  work->light += node->light;
  work->curvature += node->curvature;
  work->spread += node->spread;
  work->square += node->spread * node->spread;
  work->cost += price;
}

static void pop(struct cut_work *work) {
  struct ranked *heap = work->heap, top = heap[0], last = heap[--work->count];
  const struct cut_node *node = &work->node[top.node];
  int k = 0;
  for (int child = 1; child < work->count; child = 2 * k + 1) {
    if (child + 1 < work->count && heap[child + 1].error > heap[child].error) ++child;
    if (!(heap[child].error > last.error)) break;
    heap[k] = heap[child];
    k = child;
  }
  heap[k] = last;
  heap[work->count].node = top.node;
  work->light -= node->light;
  work->curvature -= node->curvature;
  work->spread -= node->spread;
  work->square -= node->spread * node->spread;
  work->cost -= node_price(work, node->level);
}

static void add_four(struct cut_work *work, int level, const int (*at)[2], int count) {
  const double price = node_price(work, level);
  struct cut_node *free[4];
  for (int k = 0; k < 4; ++k) free[k] = &work->node[work->heap[work->count + k].node];
  const int seen = cut_seen_estimate(&work->seen, level, at, count, free);
  for (int k = 0; k < seen; ++k) push(work, price);
  work->visited += (uint64_t)seen;
}

static void add_block(struct cut_work *work, int level, const int from[2], const int to[2]) {
  int at[4][2], count = 0;
  for (int q = from[1]; q < to[1]; ++q)
    for (int p = from[0]; p < to[0]; ++p) {
      at[count][0] = p;
      at[count][1] = q;
      if (++count < 4) continue;
      add_four(work, level, (const int(*)[2])at, count);
      count = 0;
    }
  if (count > 0) add_four(work, level, (const int(*)[2])at, count);
}

/* Is a cut likely to cost too much? Twice the nodes halve the error, at best. `weight`: the square
 * of the number of nodes among which the error is shared: one that stands out is soon split,
 * errors all over the cut are those of a rough lamp. */
static bool is_hopeless(const struct cut_work *work, double weight, double error, double allowed) {
  return weight * (node_cost + 16 * sample_cost) * error > hopeless * work->budget * allowed;
}

/* ---- Steps 1 to 3 ---- */

/* Estimates a cut of the whole block by four of its nodes. False: too expensive. */
static bool estimate_block(const struct cut_work *work, int level, const int from[2],
                           const int to[2], double tolerance) {
  const double count = (to[0] - from[0]) * (to[1] - from[1]);
  double error = 0, light = 0;
  struct cut_node node[4], *const nodes[4] = {&node[0], &node[1], &node[2], &node[3]};
  int at[4][2];
  for (int k = 0; k < 4; ++k)
    for (int axis = 0; axis < 2; ++axis)
      at[k][axis] = from[axis] + (to[axis] - from[axis]) * (k >> axis & 1 ? 3 : 1) / 4;
  const int seen = cut_seen_estimate(&work->seen, level, (const int(*)[2])at, 4, nodes);
  for (int k = 0; k < seen; ++k) {
    error += error_of(&node[k]);
    light += fabs(node[k].light);
  }
  return !is_hopeless(work, 3 * count, error / sqrt(count), tolerance * light);
}

/* The first cut: the first level whose nodes are narrow enough. False: too expensive. */
static bool start(struct cut_work *work, double tolerance) {
  const struct cut_tree *tree = work->seen.tree;
  int number = 0, from[2], to[2];
  for (cut_seen_prepare(&work->seen, 0); work->seen.level[number].width.wide;) {
    if (++number == tree->levels) return false;
    cut_seen_prepare(&work->seen, number);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const int most = tree->axes[axis].count[number];
    int k = 0;
    while (k < most && !cut_seen_any(&work->seen, number, axis, k)) ++k;
    from[axis] = k;
    while (k < most && cut_seen_any(&work->seen, number, axis, k)) ++k;
    to[axis] = k;
  }
  int count = (to[0] - from[0]) * (to[1] - from[1]);
  if (count > NODES) return false;
  if (count > 1) {
    work->budget = find_budget(work);
    if (count * node_price(work, number) > worth * work->budget) return false;
  }
  if (count >= 16 && !estimate_block(work, number, from, to, tolerance)) return false;
  add_block(work, number, from, to);
  return true;
}

/* Refines until the error is allowed. `more` is how much more light there is than the nodes'
 * estimates say. False: too expensive. */
static bool refine(struct cut_work *work, double tolerance, double least, double more) {
  const struct cut_tree *tree = work->seen.tree;
  for (;;) {
    const double light = work->light + more,
                 error = work->error = cut_allowed_sum(work->curvature, work->spread, work->square);
    const double allowed = tolerance * (light > least ? light : least);
    if (error <= allowed || work->count == 0) return true;
    if (work->budget == 0) work->budget = find_budget(work);
    const struct cut_node *top = &work->node[work->heap[0].node];
    const int level = top->level;
    if (level == tree->levels - 1 || work->count + 4 > NODES) return false;
    const double sharing = work->spread * work->spread / work->square;
    if (work->visited > 4 && work->square > 0 &&
        is_hopeless(work, sharing * sharing, error, allowed))
      return false;
    const struct cut_interval *u = &tree->axes[0].level[level][top->at[0]];
    const struct cut_interval *v = &tree->axes[1].level[level][top->at[1]];
    pop(work);
    cut_seen_prepare(&work->seen, level + 1);
    add_block(work, level + 1, (int[2]){u->child, v->child},
              (int[2]){u->child + u->children, v->child + v->children});
    if (work->cost > worth * work->budget) return false;
  }
}

/* ---- Steps 4 and 5 ---- */

/* Near the aperture, where the st window hides a part of it: what is left may be slivers of views,
 * of which the estimates know little. */
static bool is_clipped(const struct cut_seen *nodes) {
  return nodes->level[0].width.wide &&
         !(cut_seen_whole(nodes, 0, 0, 0) && cut_seen_whole(nodes, 0, 1, 0));
}

/* A cut's sum. False: it is too expensive. */
static bool sum_cut(struct cut_work *work, double irradiance[3], double *predicted) {
  const struct cut_tree *tree = work->seen.tree;
  const double least = cut_allowed_least(tree, work->seen.per_height);
  double aim = cut_allowed_share(work->tolerance), more = 0, error = 0, most = 0;
  if (!(aim > 0) || !start(work, aim)) return false;
  if (is_clipped(&work->seen)) aim *= clipped_margin;
  for (int round = 0; round < ROUNDS; ++round) {
    double rgb[3] = {0}, brighter = 0; /* the error of light that was not estimated */
    if (!refine(work, aim, least, more)) return false;
    for (int k = 0; k < work->count; ++k)
      if (!cut_seen_light(&work->seen, &work->node[work->heap[k].node], rgb, &brighter))
        return false;
    most = least;
    for (int c = 0; c < 3; ++c) {
      most = simd_max(rgb[c], most);
      irradiance[c] = simd_max(rgb[c], tree->least);
    }
    error = work->error + brighter;
    *predicted = cut_rounding + (most > 0 ? error / most : 0);
    if (error <= aim * most) return true;
    if (brighter > aim * most) return false;
    more = most - brighter / aim - work->light;
  }
  return false;
}

/* Is all of the aperture above the tangent plane? */
static bool is_above(const struct seen_page *seen) {
  double low[2], high[2], range[2];
  seen_page_aperture(seen, low, high);
  kernel_heights(&seen->kernel, low, high, range);
  return range[0] > 0 && isfinite(range[1]);
}

bool cut_sum(const struct cut_tree *tree, const struct seen_page *seen, double tolerance,
             struct cut_work *work, double irradiance[3], struct cut_counts *counts) {
  const struct seen_page scaled = cut_tree_seen(tree, seen);
  if (scaled.kernel.shininess > 0 || !(scaled.height > 0) || !is_above(&scaled)) return false;
  if (!cut_seen_begin(tree, &scaled, &work->seen)) {
    counts->no_memory = true;
    return false;
  }
  work->count = 0;
  work->light = work->curvature = work->spread = work->square = work->cost = 0;
  work->visited = 0;
  work->tolerance = tolerance;
  work->budget = 0;
  if (sum_cut(work, irradiance, &counts->error)) {
    counts->nodes += (uint64_t)work->count;
    return true;
  }
  if (work->budget == 0) find_budget(work);
  const int nodes = work->view_nodes;
  if (nodes == 0 || !cut_views_light(tree, &scaled, nodes, work->views, irradiance)) return false;
  for (int c = 0; c < 3; ++c) irradiance[c] = fmax(irradiance[c], tree->least);
  counts->views += (uint64_t)(nodes * scaled.page->axes[0].near_count) *
                   (uint64_t)(nodes * scaled.page->axes[1].near_count);
  counts->error = work->views_error;
  return true;
}
