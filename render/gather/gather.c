/* gather.c - for each page of each light:
 *   1. Can anything stand between the receivers and the aperture (occlusion_between)? If not, no
 *      shadow rays are traced. Then for each receiver:
 *   2. The page, or the level of it that its distance calls for, as the receiver sees it
 *      (seen_page.h); nothing is summed where it is turned away or below the tangent plane.
 *   3. If there are trees and nothing hides a part of the aperture: the cut (cut.h); for four
 *      receivers at once, where these are so far away that the tree's root is enough.
 *   4. Else the strips of micro lights (strips.h), the parts of the aperture that are visible
 *      past occluders (visible.h), and the predicted error, by which the rule is chosen.
 *   5. The sum over the micro lights of each visible part (row_sum.h, paper.h, closed_form.h).
 * Summing neighbouring receivers together, row by row of the page, was measured and left out: it
 * was 3 % faster for slabs larger than the cache (64 x 64 x 64 x 64 samples, method pi, 32 MB of
 * cache) and up to 30 % slower for all others. */
#include "gather/gather.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/simd.h"
#include "cut/cut.h"
#include "microlight/closed_form.h"
#include "microlight/levels.h"
#include "microlight/paper.h"
#include "microlight/row_sum.h"
#include "shadow/occlusion.h"
#include "shadow/visible.h"

/* The order rule bounds a micro light's error by its own light. Sums of samples of both signs
 * can be smaller than their parts, and users compare digits: the reference aims lower. */
static const double reference_margin = 1e-3;
static const double least_tolerance = 1e-14; /* rounding is larger */

struct gather {
  const struct gather_settings *settings;
  const struct method *method;
  struct gather_counts counts;
  struct rule_orders orders;
  struct strips whole[2], part[2]; /* what a receiver sees of a page; of one visible part */
  struct visible visible;
  struct cut_work *cut; /* NULL until it is needed; owned */
  bool no_memory;       /* for a cut */
  struct row_sum sum;
  struct rule_nodes nodes[2]; /* of METHOD_CLOSED */
};

enum result gather_create(const struct gather_settings *settings, struct gather **gather,
                          struct error *error) {
  struct gather *made = calloc(1, sizeof *made);
  if (!made) return result_no_memory(error);
  made->settings = settings;
  made->method = &gather_methods[settings->method];
  double margin = made->method->sum == METHOD_GAUSS ? reference_margin : 1;
  made->orders = rule_orders(fmax(settings->tolerance * margin, least_tolerance));
  made->sum.skip_black = !settings->all_effects;
  *gather = made;
  return RESULT_OK;
}

void gather_free(struct gather *gather) {
  if (!gather) return;
  for (int axis = 0; axis < 2; ++axis) {
    strips_free(&gather->whole[axis]);
    strips_free(&gather->part[axis]);
    rule_nodes_free(&gather->nodes[axis]);
  }
  row_sum_free(&gather->sum);
  visible_free(&gather->visible);
  cut_work_free(gather->cut);
  free(gather);
}

const struct gather_counts *gather_counts(const struct gather *gather) {
  return &gather->counts;
}

enum result gather_create_all(const struct gather_settings *settings, int threads,
                              struct gather **all, struct error *error) {
  enum result result = RESULT_OK;
  for (int k = 0; k < threads && result == RESULT_OK; ++k)
    result = gather_create(settings, &all[k], error);
  return result;
}

void gather_free_all(struct gather **all, int threads, struct gather_counts *counts) {
  for (int k = 0; k < threads; ++k) {
    if (all[k]) gather_counts_add(counts, &all[k]->counts);
    gather_free(all[k]);
    all[k] = NULL;
  }
}

/* One receiver, one page. */
struct look {
  const struct light *light;
  const struct light_page *page;
  int page_number; /* of gather_prepared */
  bool shadows;    /* something may stand between */
  const struct receiver *receiver;
  struct gathered *gathered;
};

static void add(const struct look *look, const double light[3], double sum[3]) {
  for (int c = 0; c < 3; ++c) sum[c] += look->light->gain[c] * look->page->gain * light[c];
}

static void note_error(struct gather *gather, const struct look *look, double error) {
  look->gathered->error = simd_max(error, look->gathered->error);
  gather->counts.error = simd_max(error, gather->counts.error);
}

/* ---- What a receiver sees of a page ---- */

/* May it see any of the page: is any of the aperture above its tangent plane, and seen through
 * the window? */
static bool may_see(const struct seen_page *seen) {
  double low[2], high[2], range[2];
  if (!(seen->height > 0)) return true;
  seen_page_aperture(seen, low, high);
  for (int axis = 0; axis < 2; ++axis) {
    const struct light_axis *along = &seen->page->axes[axis];
    const double across = along->kappa * along->half;
    const double ends[2] = {-across - low[axis], across - high[axis]};
    if ((ends[0] < along->far_low && ends[1] < along->far_low) ||
        (ends[0] > along->far_high && ends[1] > along->far_high))
      return false;
  }
  kernel_heights(&seen->kernel, low, high, range);
  return range[1] > 0;
}

/* The page as the receiver sees it, or the level that its distance calls for; false where it is
 * turned away. */
static bool find_page(const struct gather *gather, const struct look *look,
                      struct seen_page *seen) {
  const struct gather_settings *settings = gather->settings;
  if (!seen_page_find(look->page, look->receiver, seen) || !may_see(seen)) return false;
  if (!settings->prepared || !settings->prepared->levels) return true;
  const struct levels *levels = &settings->prepared->levels[look->page_number];
  int level = settings->level < 0 ? levels_choose(levels, seen) : settings->level;
  if (level > levels->count) level = levels->count;
  if (level > 0) seen->page = &levels->page[level - 1];
  return true;
}

/* Finds the strips. Does it see any of them above its tangent plane? */
static enum result find_strips(struct gather *gather, const struct seen_page *seen, bool *sees,
                               struct error *error) {
  struct strips *whole = gather->whole;
  double range[2];
  *sees = false;
  enum result result = seen_page_strips(seen, gather->method->sum == METHOD_VIEWS, whole, error);
  if (result != RESULT_OK || whole[0].count == 0 || whole[1].count == 0) return result;
  seen_page_heights(seen, whole, range);
  *sees = range[1] > 0;
  return RESULT_OK;
}

static enum result find_visible(struct gather *gather, const struct seen_page *seen,
                                const struct receiver *receiver, struct error *error) {
  const struct strips *whole = gather->whole;
  struct visible_query query = {.occlusion = gather->settings->occlusion,
                                .grid = gather->settings->shadow_grid,
                                .edge = gather->settings->shadow_edge};
  occlusion_lift(query.occlusion, receiver->position, receiver->lift, query.lifted);
  for (int axis = 0; axis < 2; ++axis) {
    query.whole.low[axis] = whole[axis].strip[0].low;
    query.whole.high[axis] = whole[axis].strip[whole[axis].count - 1].high;
    for (int c = 0; c < 3; ++c) query.along[axis][c] = seen->height * seen->page->frame[axis][c];
  }
  for (int c = 0; c < 3; ++c)
    query.origin[c] = receiver->position[c] - seen->height * seen->page->frame[2][c];
  return visible_find(&query, &gather->visible, error);
}

/* Is nothing hidden of what there is to see? */
static bool all_visible(const struct gather *gather) {
  const struct visible_rectangle *only = gather->visible.rectangles;
  if (gather->visible.count != 1) return false;
  for (int axis = 0; axis < 2; ++axis) {
    const struct strips *whole = &gather->whole[axis];
    if (only->low[axis] != whole->strip[0].low ||
        only->high[axis] != whole->strip[whole->count - 1].high)
      return false;
  }
  return true;
}

/* The strips within a visible rectangle; of views, those whose middle is. */
static enum result clip(struct gather *gather, const struct visible_rectangle *rectangle,
                        struct error *error) {
  bool views = gather->method->sum == METHOD_VIEWS;
  enum result result = RESULT_OK;
  for (int axis = 0; axis < 2 && result == RESULT_OK; ++axis) {
    struct strips *part = &gather->part[axis];
    const struct strips *whole = &gather->whole[axis];
    double low = rectangle->low[axis], high = rectangle->high[axis];
    part->count = 0;
    if (!views) result = strips_clip(whole, low, high, part, error);
    for (int k = 0; views && k < whole->count && result == RESULT_OK; ++k) {
      double middle = (whole->strip[k].low + whole->strip[k].high) / 2;
      if (middle >= low && middle < high) result = strips_append(part, &whole->strip[k], error);
    }
  }
  return result;
}

/* ---- The sum ---- */

/* By the cut, if there are trees and it takes this receiver. */
static bool take_cut(struct gather *gather, const struct look *look, const struct seen_page *seen) {
  const struct gather_prepared *prepared = gather->settings->prepared;
  struct cut_counts counts = {0};
  double irradiance[3];
  if (!prepared || !prepared->trees) return false;
  if (!gather->cut) gather->cut = cut_work_make();
  bool taken =
      gather->cut && cut_sum(prepared->trees[look->page_number], seen, gather->settings->tolerance,
                             gather->cut, irradiance, &counts);
  gather->no_memory |= !gather->cut || counts.no_memory;
  if (!taken) return false;
  gather->counts.nodes += counts.nodes + counts.views;
  add(look, irradiance, look->gathered->irradiance);
  note_error(gather, look, counts.error);
  return true;
}

/* By the tree's root alone, for up to CUT_ROOTS receivers. Marks those whose light it added. */
static void take_roots(struct gather *gather, const struct look *looks, int count, bool *done) {
  const struct gather_prepared *prepared = gather->settings->prepared;
  struct seen_page seen[CUT_ROOTS];
  struct cut_root roots[CUT_ROOTS];
  int number[CUT_ROOTS], facing = 0;
  for (int k = 0; k < count; ++k) {
    number[facing] = k;
    facing += seen_page_find(looks[k].page, looks[k].receiver, &seen[facing]);
  }
  for (int k = facing; facing > 0 && k < CUT_ROOTS; ++k) seen[k] = seen[0];
  cut_roots(prepared->trees[looks->page_number], seen, facing, gather->settings->tolerance, roots);
  for (int k = 0; k < facing; ++k) {
    const struct look *look = &looks[number[k]];
    if (!roots[k].done) continue;
    done[number[k]] = true;
    add(look, roots[k].irradiance, look->gathered->irradiance);
    note_error(gather, look, roots[k].error);
    ++gather->counts.nodes;
    gather->counts.open_views += gather->settings->occlusion != NULL;
  }
}

static double pi_error(const struct seen_page *seen, const struct strips strips[2]) {
  double widest = 0, change = 0, range[2];
  for (int axis = 0; axis < 2; ++axis) {
    double wide = 0;
    for (int k = 0; k < strips[axis].count; ++k) wide = fmax(wide, strips[axis].strip[k].width);
    widest = fmax(widest, wide);
    change += fabs(seen->kernel.normal[axis]) * wide;
  }
  seen_page_heights(seen, strips, range);
  const double rise = change > 0 ? change / (fmax(range[0], 0) + change / 2) : 0;
  return rule_pi_error(widest, rise, seen->kernel.shininess);
}

/* How the page is summed for this receiver, and the relative error that is predicted: INFINITY
 * where none is known. */
static enum method_sum choose(const struct gather *gather, const struct look *look,
                              const struct seen_page *seen, double *error) {
  enum method_sum sum = gather->method->sum;
  *error = gather->settings->tolerance;
  if (sum == METHOD_CHEAPEST || sum == METHOD_MEANS) {
    double predicted = pi_error(seen, gather->whole);
    if (sum == METHOD_CHEAPEST) sum = predicted <= *error ? METHOD_MEANS : METHOD_GAUSS;
    if (sum == METHOD_MEANS) *error = predicted;
  }
  if (!gather->method->predicts || seen->page != look->page) *error = INFINITY;
  return sum;
}

static uint64_t seed_of(const struct gather *gather, const struct look *look) {
  return gather->settings->seed ^ (look->receiver->index * 0xd1342543de82ef95u +
                                   (uint64_t)look->page_number * 0x9fb21c651e98df25u);
}

/* Adds the light of the micro lights of the strips. */
static enum result sum_strips(struct gather *gather, const struct look *look,
                              const struct seen_page *seen, const struct strips strips[2],
                              enum method_sum sum, struct error *error) {
  double irradiance[3] = {0}, gloss[3] = {0};
  enum result result = RESULT_OK;
  if (sum == METHOD_RANDOM) {
    paper_sum(seen, look->page, strips, seed_of(gather, look), irradiance, gloss, &gather->counts);
  } else if (sum == METHOD_CLOSED) {
    result = closed_form_sum(seen, strips, gather->nodes, irradiance, &gather->counts, error);
  } else {
    enum rule rule = sum == METHOD_GAUSS   ? RULE_GAUSS
                     : sum == METHOD_MEANS ? RULE_PI
                     : sum == METHOD_VIEWS ? RULE_VIEWS
                                           : RULE_MIDPOINT;
    result = row_sum_light(&gather->sum, seen, strips, rule, &gather->orders, irradiance, gloss,
                           &gather->counts, error);
  }
  if (result == RESULT_OK) add(look, irradiance, look->gathered->irradiance);
  if (result == RESULT_OK) add(look, gloss, look->gathered->gloss);
  return result;
}

static enum result take_look(struct gather *gather, const struct look *look, struct error *error) {
  struct seen_page seen;
  const bool faces = find_page(gather, look, &seen);
  const bool open = gather->settings->occlusion && !look->shadows;
  bool sees = faces;
  if (faces && !look->shadows && take_cut(gather, look, &seen)) {
    gather->counts.open_views += open;
    return RESULT_OK;
  }
  enum result result = faces ? find_strips(gather, &seen, &sees, error) : RESULT_OK;
  if (result != RESULT_OK) return result;
  if (!sees) {
    ++gather->counts.pages_behind;
    /* There may be light between the views. */
    if (faces && gather->method->sum == METHOD_VIEWS) note_error(gather, look, INFINITY);
    return RESULT_OK;
  }
  gather->counts.open_views += open;
  if (look->shadows) {
    result = find_visible(gather, &seen, look->receiver, error);
    if (result != RESULT_OK) return result;
    if (all_visible(gather) && take_cut(gather, look, &seen)) return RESULT_OK;
  }
  double predicted;
  enum method_sum sum = choose(gather, look, &seen, &predicted);
  note_error(gather, look, predicted);
  if (!look->shadows) return sum_strips(gather, look, &seen, gather->whole, sum, error);
  for (int k = 0; k < gather->visible.count && result == RESULT_OK; ++k) {
    result = clip(gather, &gather->visible.rectangles[k], error);
    if (result == RESULT_OK && gather->part[0].count > 0 && gather->part[1].count > 0)
      result = sum_strips(gather, look, &seen, gather->part, sum, error);
  }
  return result;
}

/* May anything stand between the receivers that face the page, and the page? */
static bool find_shadows(struct gather *gather, const struct light_page *page,
                         const struct receiver *receivers, int count) {
  enum { MOST = 64 }; /* receivers of a tile */
  const struct occlusion *occlusion = gather->settings->occlusion;
  if (!occlusion || gather->settings->all_effects) return occlusion != NULL;
  double lifted[MOST][3], corners[4][3];
  struct seen_page seen;
  int facing = 0;
  for (int k = 0; k < count; ++k) {
    if (!seen_page_find(page, &receivers[k], &seen)) continue;
    if (facing == MOST) return true;
    occlusion_lift(occlusion, receivers[k].position, receivers[k].lift, lifted[facing++]);
  }
  light_page_corners(page, corners);
  return occlusion_between(occlusion, (const double(*)[3])lifted, facing,
                           (const double(*)[3])corners);
}

/* `like` is the first of `count` receivers: takes up to CUT_ROOTS of them. */
static enum result take_four(struct gather *gather, const struct look *like, int count,
                             struct error *error) {
  const struct gather_prepared *prepared = gather->settings->prepared;
  struct look looks[CUT_ROOTS];
  bool done[CUT_ROOTS] = {false};
  enum result result = RESULT_OK;
  if (count > CUT_ROOTS) count = CUT_ROOTS;
  for (int k = 0; k < count; ++k) {
    looks[k] = *like;
    looks[k].receiver += k;
    looks[k].gathered += k;
  }
  if (prepared && prepared->trees && !like->shadows) take_roots(gather, looks, count, done);
  for (int k = 0; k < count && result == RESULT_OK; ++k)
    if (!done[k]) result = take_look(gather, &looks[k], error);
  return result;
}

enum result gather_light(struct gather *gather, const struct receiver *receivers, int count,
                         struct gathered *gathered, struct error *error) {
  const struct gather_settings *settings = gather->settings;
  enum result result = RESULT_OK;
  memset(gathered, 0, (size_t)count * sizeof *gathered);
  for (int l = 0, number = 0; l < settings->light_count; ++l) {
    const struct light *light = &settings->lights[l];
    for (int page = 0; page < light->count && result == RESULT_OK; ++page, ++number) {
      bool shadows = find_shadows(gather, &light->pages[page], receivers, count);
      for (int k = 0; k < count && result == RESULT_OK; k += CUT_ROOTS) {
        const struct look look = {light,   &light->pages[page], number,
                                  shadows, &receivers[k],       &gathered[k]};
        result = take_four(gather, &look, count - k, error);
      }
    }
  }
  gather->counts.receivers += (uint64_t)count;
  gather->counts.shadow_rays = gather->visible.shadow_rays;
  if (result == RESULT_OK && gather->no_memory) result = result_no_memory(error);
  return result;
}
