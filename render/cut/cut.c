/* cut.c - see cut.h. */
#include "cut/cut.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cut/cut_seen.h"
#include "cut/cut_views.h"
#include "microlight/rule.h"

enum { NODES = 1024, ROUNDS = 4 };

/* Errors of nodes that hide in the views have either sign. Their sum is taken as this many times
 * the root of the sum of their squares, or as the sum, where that is less. */
static const double scatter = 1.6;

/* Costs in nanoseconds, of which only the ratios matter: of a node, of an st sample of a node, of
 * a micro light summed by the rule pi, of a strip of them; by Gauss rules instead of pi. */
static const double node_cost = 70, sample_cost = 3, light_cost = 8, strip_cost = 36, gauss = 3;

/* A cut must cost less than this share of the micro lights, and it is given up where what is
 * known of the errors makes it likely to cost more than the second. */
static const double worth = 0.7, hopeless = 12;

/* Light of a page below this share of the most that it sends to where the receiver is may err as
 * if it were that share; and what is aimed at, since all is estimated. */
static const double least_share = 1e-4, margin = 0.7, clipped_margin = 0.4;

/* Nodes are summed in single precision. */
static const double rounding = 5e-7;

struct cut_work {
  struct cut_seen seen;
  struct cut_views *views[CUT_TOGETHER]; /* owned */
  double *irradiance[CUT_TOGETHER];      /* of those that wait, */
  double least[CUT_TOGETHER];            /* and what it is at least */
  int waiting;
  struct cut_node heap[NODES]; /* of the cut; the largest error first */
  int count;
  double light, bent, spread, square, cost; /* of the cut: sums of its nodes' */
  double tolerance;
  int nodes;          /* of each view in a sum of all at once; 0: none is exact enough */
  double nodes_error; /* predicted of that sum */
  double budget;      /* 0: not known yet */
  uint64_t visited;
};

struct cut_work *cut_work_make(void) {
  struct cut_work *made = calloc(1, sizeof *made);
  for (int k = 0; made && k < CUT_TOGETHER; ++k)
    if (!(made->views[k] = cut_views_make())) {
      cut_work_free(made);
      return NULL;
    }
  return made;
}

void cut_work_free(struct cut_work *work) {
  if (!work) return;
  cut_seen_free(&work->seen);
  for (int k = 0; k < CUT_TOGETHER; ++k) cut_views_free(work->views[k]);
  free(work);
}

/* What it costs otherwise: all views at once, and with how many nodes; or, where these are not
 * exact enough, the micro lights, summed by pi or else by Gauss rules. */
static double find_budget(struct cut_work *work) {
  const struct cut_seen *sees = &work->seen;
  work->nodes = cut_views_nodes(sees->page, work->tolerance, &work->nodes_error);
  if (work->nodes > 0) return cut_views_price(sees->page, work->nodes);
  double strips[2], widest = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const struct light_axis *along = &sees->page->page->axes[axis];
    const double near = along->near_step * sees->per_height;
    const double far = along->far_step / fabs(along->kappa * sees->page->height - 1);
    const double cells = 2 * along->half / fabs(along->far_step) * fabs(sees->w);
    const double share = cells > along->far_count ? along->far_count / cells : 1;
    strips[axis] = 1 + cells * share + share * along->near_count;
    widest = fmax(widest, fmin(near, far));
  }
  const double error = rule_pi_error(widest, 0, 0);
  const double cost = light_cost * strips[0] * strips[1] + strip_cost * (strips[0] + strips[1]);
  return error <= work->tolerance ? cost : gauss * cost;
}

/* ---- The cut ---- */

static double error_of(const struct cut_node *node) {
  return node->bent + node->spread;
}

static double node_price(const struct cut_work *work, int level) {
  return node_cost + sample_cost * work->seen.level[level].samples;
}

static void count_node(struct cut_work *work, const struct cut_node *node, double sign) {
  work->light += sign * node->light;
  work->bent += sign * node->bent;
  work->spread += sign * node->spread;
  work->square += sign * node->spread * node->spread;
  work->cost += sign * node_price(work, node->level);
}

static void push(struct cut_work *work, const struct cut_node *node) {
  struct cut_node *heap = work->heap;
  const double error = error_of(node);
  int k = work->count++;
  for (; k > 0 && error_of(&heap[(k - 1) / 2]) < error; k = (k - 1) / 2)
    heap[k] = heap[(k - 1) / 2];
  heap[k] = *node;
  count_node(work, node, 1);
}

static struct cut_node pop(struct cut_work *work) {
  struct cut_node *heap = work->heap, top = heap[0], last = heap[--work->count];
  int k = 0;
  for (int child = 1; child < work->count; child = 2 * k + 1) {
    if (child + 1 < work->count && error_of(&heap[child + 1]) > error_of(&heap[child])) ++child;
    if (!(error_of(&heap[child]) > error_of(&last))) break;
    heap[k] = heap[child];
    k = child;
  }
  heap[k] = last;
  count_node(work, &top, -1);
  return top;
}

static void add_block(struct cut_work *work, int level, const int from[2], const int to[2]) {
  struct cut_node node;
  for (int q = from[1]; q < to[1]; ++q)
    for (int p = from[0]; p < to[0]; ++p) {
      if (!cut_seen_estimate(&work->seen, level, (int[2]){p, q}, &node)) continue;
      push(work, &node);
      ++work->visited;
    }
}

static double error_sum(const struct cut_work *work) {
  double scattered = scatter * sqrt(work->square > 0 ? work->square : 0);
  return work->bent + (scattered < work->spread ? scattered : work->spread);
}

/* Twice the nodes halve the error, at best. `matter`: how many nodes bring most of it, squared:
 * one that stands out is soon split, errors all over the cut are those of a rough lamp. */
static bool no_hope(const struct cut_work *work, double matter, double error, double allowed) {
  return matter * (node_cost + 16 * sample_cost) * error > hopeless * work->budget * allowed;
}

/* Refines until the error is allowed. `more` is how much more light there is than the nodes'
 * estimates say. False: too expensive. */
static bool refine(struct cut_work *work, double tolerance, double least, double more) {
  const struct cut_tree *tree = work->seen.tree;
  while (work->count > 0) {
    const double light = work->light + more, error = error_sum(work);
    const double allowed = tolerance * (light > least ? light : least);
    if (error <= allowed) break;
    if (work->budget == 0) work->budget = find_budget(work);
    const struct cut_node top = work->heap[0];
    if (top.level == tree->levels - 1 || work->count + 4 > NODES) return false;
    const double matter = work->spread * work->spread / work->square;
    if (work->visited > 4 && work->square > 0 && no_hope(work, matter * matter, error, allowed))
      return false;
    pop(work);
    cut_seen_prepare(&work->seen, top.level + 1);
    const struct cut_interval *u = &tree->axes[0].level[top.level][top.at[0]];
    const struct cut_interval *v = &tree->axes[1].level[top.level][top.at[1]];
    add_block(work, top.level + 1, (int[2]){u->child, v->child},
              (int[2]){u->child + u->children, v->child + v->children});
    if (work->cost > worth * work->budget) return false;
  }
  return true;
}

/* Looks at four nodes of a block. */
static bool sample_hope(const struct cut_work *work, int level, const int from[2], const int to[2],
                        double tolerance) {
  const double count = (to[0] - from[0]) * (to[1] - from[1]);
  double error = 0, light = 0;
  for (int k = 0; k < 4; ++k) {
    struct cut_node node;
    int at[2];
    for (int axis = 0; axis < 2; ++axis)
      at[axis] = from[axis] + (to[axis] - from[axis]) * (k >> axis & 1 ? 3 : 1) / 4;
    if (!cut_seen_estimate(&work->seen, level, at, &node)) continue;
    error += error_of(&node);
    light += fabs(node.light);
  }
  return !no_hope(work, 3 * count, error / sqrt(count), tolerance * light);
}

/* The first cut: the first level whose nodes are narrow enough. False: no hope. */
static bool start(struct cut_work *work, double tolerance) {
  const struct cut_tree *tree = work->seen.tree;
  int number = 0, from[2], to[2];
  for (cut_seen_prepare(&work->seen, 0); work->seen.level[number].wide;) {
    if (++number == tree->levels) return false;
    cut_seen_prepare(&work->seen, number);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const struct cut_spot *spots = work->seen.level[number].spots[axis];
    int count = tree->axes[axis].count[number];
    for (from[axis] = 0; from[axis] < count && !spots[from[axis]].seen;) ++from[axis];
    for (to[axis] = from[axis]; to[axis] < count && spots[to[axis]].seen;) ++to[axis];
  }
  int count = (to[0] - from[0]) * (to[1] - from[1]);
  if (count > NODES) return false;
  if (count > 1) {
    work->budget = find_budget(work);
    if (count * node_price(work, number) > worth * work->budget) return false;
  }
  if (count >= 16 && !sample_hope(work, number, from, to, tolerance)) return false;
  add_block(work, number, from, to);
  return true;
}

/* ---- The sum ---- */

/* Whether all of the aperture is above the tangent plane. */
static bool above(const struct seen_page *seen) {
  const double per_height = 1 / seen->height;
  double low[2], high[2], range[2];
  for (int axis = 0; axis < 2; ++axis) {
    low[axis] = (-seen->page->axes[axis].half - seen->foot[axis]) * per_height;
    high[axis] = (seen->page->axes[axis].half - seen->foot[axis]) * per_height;
  }
  kernel_heights(&seen->kernel, low, high, range);
  return range[0] > 0 && isfinite(range[1]);
}

/* Near the aperture, where the st window hides a part of it: what is left may be slivers of views,
 * of which the estimates know little. */
static bool is_clipped(const struct cut_seen *sees) {
  const struct cut_seen_level *root = &sees->level[0];
  return root->wide && !(root->spots[0]->whole && root->spots[1]->whole);
}

/* A cut's sum. False: it is too expensive. */
static bool sum_cut(struct cut_work *work, double floor, double irradiance[3], double *predicted) {
  const struct cut_tree *tree = work->seen.tree;
  const double per_height = work->seen.per_height;
  const double sent = fmin(tree->brightest * per_height * per_height, tree->hemisphere);
  const double least = fmax(floor, least_share * sent);
  double aim = margin * work->tolerance - rounding, more = 0, error = 0, most = 0;
  if (!(aim > 0) || !start(work, aim)) return false;
  if (is_clipped(&work->seen)) aim *= clipped_margin;
  for (int round = 0; round < ROUNDS; ++round) {
    double rgb[3] = {0}, bent = 0;
    if (!refine(work, aim, least, more)) return false;
    for (int k = 0; k < work->count; ++k)
      if (!cut_seen_light(&work->seen, &work->heap[k], rgb, &bent)) return false;
    most = fmax(fmax(fmax(rgb[0], rgb[1]), rgb[2]), least);
    error = error_sum(work) + bent;
    for (int c = 0; c < 3; ++c) irradiance[c] = fmax(rgb[c], tree->least);
    *predicted = rounding + (most > 0 ? error / most : 0);
    if (error <= aim * most) return true;
    if (bent > aim * most) return false;
    more = most - bent / aim - work->light;
  }
  return false;
}

void cut_finish(struct cut_work *work) {
  cut_views_sum(work->views, work->waiting);
  for (int k = 0; k < work->waiting; ++k) {
    double *rgb = work->irradiance[k];
    cut_views_light(work->views[k], rgb);
    for (int c = 0; c < 3; ++c) rgb[c] = fmax(rgb[c], work->least[k]);
  }
  work->waiting = 0;
}

bool cut_sum(const struct cut_tree *tree, const struct seen_page *from, double tolerance,
             double floor, struct cut_work *work, double irradiance[3], struct cut_counts *counts) {
  const struct seen_page scaled = cut_tree_view(tree, from), *view = &scaled;
  if (view->kernel.shininess > 0 || !(view->height > 0) || !above(view)) return false;
  if (!cut_seen_begin(tree, view, &work->seen)) {
    counts->no_memory = true;
    return false;
  }
  work->count = 0;
  work->light = work->bent = work->spread = work->square = work->cost = 0;
  work->visited = 0;
  work->tolerance = tolerance;
  work->budget = 0;
  if (sum_cut(work, floor, irradiance, &counts->error)) {
    counts->nodes += (uint64_t)work->count;
    counts->visited += work->visited;
    return true;
  }
  if (work->budget == 0) find_budget(work);
  if (work->waiting == CUT_TOGETHER) cut_finish(work);
  if (work->nodes == 0 || !cut_views_prepare(tree, view, work->nodes, work->views[work->waiting]))
    return false;
  work->least[work->waiting] = tree->least;
  work->irradiance[work->waiting++] = irradiance;
  counts->views += (uint64_t)(work->nodes * view->page->axes[0].near_count) *
                   (uint64_t)(work->nodes * view->page->axes[1].near_count);
  counts->error = work->nodes_error;
  return true;
}
