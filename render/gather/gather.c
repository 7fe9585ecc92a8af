/* gather.c - see gather.h. Receivers of a tile look at a page together: their sums are
 * prepared, then taken in the order of the page's rows. */
#include "gather/gather.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cut/cut.h"
#include "microlight/closed.h"
#include "microlight/levels.h"
#include "microlight/paper.h"
#include "microlight/row_sum.h"
#include "shadow/occlusion.h"
#include "shadow/visible.h"

/* Sums that are taken together. */
enum { TOGETHER = 64 };

/* The order rule bounds a micro light's error by its own light. Sums of samples of both signs
 * can be smaller than their parts, and users compare digits: the reference aims lower. */
static const double reference_margin = 1e-3;
static const double least_tolerance = 1e-14; /* rounding is larger */

struct gather {
  const struct gather_settings *settings;
  struct gather_counts counts;
  struct row_sum_counts cell_counts;
  struct rule_orders orders;
  struct strips whole[2], part[2]; /* what a receiver sees of a page; behind occluders */
  struct rule_nodes nodes[2];      /* of the method closed */
  struct visible visible;
  struct cut_work *cut; /* NULL until it is needed; owned */
  struct cut_counts cut_counts;
  struct {
    int receiver;
    double irradiance[3];
  } by_cut[TOGETHER];
  int by_cut_count;
  struct row_sum_scratch scratch;
  struct row_sum sums[TOGETHER];
  int receiver[TOGETHER]; /* whose sum it is */
  int waiting;            /* sums that are prepared */
};

enum result gather_create(const struct gather_settings *settings, struct gather **gather,
                          struct error *error) {
  struct gather *made = calloc(1, sizeof *made);
  if (!made) return result_fail(error, RESULT_MEMORY, "out of memory");
  made->settings = settings;
  double margin = settings->method == GATHER_REFERENCE ? reference_margin : 1;
  made->orders = rule_orders(fmax(settings->tolerance * margin, least_tolerance));
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
  for (int k = 0; k < TOGETHER; ++k) row_sum_free(&gather->sums[k]);
  row_sum_scratch_free(&gather->scratch);
  visible_free(&gather->visible);
  cut_work_free(gather->cut);
  free(gather);
}

const struct gather_counts *gather_counts(const struct gather *gather) {
  return &gather->counts;
}

static void add(struct gathered *gathered, const double irradiance[3], const double gloss[3],
                double gain) {
  for (int c = 0; c < 3; ++c) {
    gathered->irradiance[c] += gain * irradiance[c];
    gathered->gloss[c] += gain * gloss[c];
  }
}

/* One receiver, one page. */
struct look {
  const struct light *light;
  const struct light_page *page;
  int page_number; /* of gather_prepared */
  bool shadows;    /* something may stand between */
  const struct receiver *receiver;
  int index; /* of the receiver, in its tile */
};

/* Takes the sums that are waiting, strip of views by strip of views. */
static enum result take_sums(struct gather *gather, double gain, struct gathered *gathered,
                             struct error *error) {
  int views = 0;
  for (int k = 0; k < gather->waiting; ++k) {
    enum result result = row_sum_scratch_reserve(&gather->scratch, &gather->sums[k], error);
    if (result != RESULT_OK) return result;
    int count = gather->sums[k].seen.page->axes[1].near_count;
    views = count > views ? count : views;
  }
  for (int view = 0; view < views; ++view)
    for (int k = 0; k < gather->waiting; ++k) {
      struct row_sum *sum = &gather->sums[k];
      const struct strips *rows = &sum->nodes[1].strips;
      while (sum->row < rows->count && rows->strip[sum->row].taps.near <= view)
        row_sum_add_row(sum, &gather->scratch, &gather->cell_counts);
    }
  for (int k = 0; k < gather->waiting; ++k) {
    double irradiance[3], gloss[3];
    row_sum_result(&gather->sums[k], irradiance, gloss);
    add(&gathered[gather->receiver[k]], irradiance, gloss, gain);
  }
  gather->waiting = 0;
  return RESULT_OK;
}

static void heights(const struct seen_page *seen, const struct strips strips[2], double range[2]) {
  double low[2], high[2];
  for (int axis = 0; axis < 2; ++axis) {
    low[axis] = strips[axis].strip[0].low;
    high[axis] = strips[axis].strip[strips[axis].count - 1].high;
  }
  kernel_heights(&seen->kernel, low, high, range);
}

static double pi_error(const struct seen_page *seen, const struct strips strips[2]) {
  double widest = 0, change = 0, range[2];
  for (int axis = 0; axis < 2; ++axis) {
    double wide = 0;
    for (int k = 0; k < strips[axis].count; ++k) wide = fmax(wide, strips[axis].strip[k].width);
    widest = fmax(widest, wide);
    change += fabs(seen->kernel.normal[axis]) * wide;
  }
  heights(seen, strips, range);
  const double rise = change > 0 ? change / (fmax(range[0], 0) + change / 2) : 0;
  return rule_pi_error(widest, rise, seen->kernel.shininess);
}

/* The method for this receiver and page, and its predicted relative error: INFINITY where none
 * is known, as with random samples, whole levels and sums over views. */
static enum gather_method choose(const struct gather *gather, const struct look *look,
                                 const struct seen_page *seen, double *error) {
  enum gather_method method = gather->settings->method;
  bool sampled = method == GATHER_PAPER || method == GATHER_PAPER_LEVELS ||
                 method == GATHER_VIEWS || method == GATHER_MIDPOINT;
  *error = gather->settings->tolerance;
  bool cheapest = method == GATHER_AUTO || method == GATHER_LEVELS || method == GATHER_CUT;
  if (cheapest || method == GATHER_PI) {
    double single = pi_error(seen, gather->whole);
    if (cheapest) method = single <= *error ? GATHER_PI : GATHER_REFERENCE;
    if (method != GATHER_REFERENCE) *error = single;
  }
  if (sampled || seen->page != look->page) *error = INFINITY;
  return method;
}

/* Sums the micro lights between `strips`: at once, or puts it with those that wait. */
static enum result sum(struct gather *gather, const struct look *look, const struct seen_page *seen,
                       const struct strips strips[2], enum gather_method method,
                       struct gathered *gathered, struct error *error) {
  double irradiance[3] = {0}, gloss[3] = {0}, gain = look->light->gain;
  enum result result = RESULT_OK;
  switch (method) {
  case GATHER_PAPER:
  case GATHER_PAPER_LEVELS:
    paper_sum(seen, look->page, strips,
              gather->settings->seed ^ (look->receiver->index * 0xd1342543de82ef95u +
                                        (uint64_t)look->page_number * 0x9fb21c651e98df25u),
              irradiance, gloss, &gather->cell_counts);
    add(&gathered[look->index], irradiance, gloss, gain);
    return RESULT_OK;
  case GATHER_CLOSED:
    result = closed_sum(seen, strips, gather->nodes, irradiance, &gather->cell_counts, error);
    add(&gathered[look->index], irradiance, gloss, gain);
    return result;
  default:
    break;
  }
  if (gather->waiting == TOGETHER) result = take_sums(gather, gain, gathered, error);
  if (result != RESULT_OK) return result;
  enum row_sum_kind kind = method == GATHER_VIEWS       ? ROW_SUM_VIEWS
                           : method == GATHER_REFERENCE ? ROW_SUM_GAUSS
                                                        : ROW_SUM_SINGLE;
  enum rule rule = method == GATHER_REFERENCE ? RULE_GAUSS
                   : method == GATHER_PI      ? RULE_PI
                                              : RULE_MIDPOINT;
  gather->receiver[gather->waiting] = look->index;
  gather->sums[gather->waiting].skip_black = !gather->settings->all_effects;
  return row_sum_prepare(&gather->sums[gather->waiting++], seen, strips, kind, rule,
                         &gather->orders, error);
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

/* The strips within a visible rectangle; of views, those whose middle is. */
static enum result clip(struct gather *gather, const struct visible_rectangle *rectangle,
                        bool views, struct error *error) {
  for (int axis = 0; axis < 2; ++axis) {
    struct strips *part = &gather->part[axis];
    const struct strips *whole = &gather->whole[axis];
    enum result result = RESULT_OK;
    double low = rectangle->low[axis], high = rectangle->high[axis];
    part->count = 0;
    if (!views) result = strips_clip(whole, low, high, part, error);
    for (int k = 0; views && k < whole->count && result == RESULT_OK; ++k) {
      double middle = (whole->strip[k].low + whole->strip[k].high) / 2;
      if (middle >= low && middle < high) result = strips_append(part, &whole->strip[k], error);
    }
    if (result != RESULT_OK) return result;
  }
  return RESULT_OK;
}

/* May it see any of the page: is any of the aperture above its tangent plane, and seen through
 * the window? */
static bool may_see(const struct seen_page *seen) {
  double low[2], high[2], range[2];
  if (!(seen->height > 0)) return true;
  const double per_height = 1 / seen->height;
  for (int axis = 0; axis < 2; ++axis) {
    const struct light_axis *along = &seen->page->axes[axis];
    low[axis] = (-along->half - seen->foot[axis]) * per_height;
    high[axis] = (along->half - seen->foot[axis]) * per_height;
    const double across = along->kappa * along->half;
    const double ends[2] = {-across - low[axis], across - high[axis]};
    if ((ends[0] < along->far_low && ends[1] < along->far_low) ||
        (ends[0] > along->far_high && ends[1] > along->far_high))
      return false;
  }
  kernel_heights(&seen->kernel, low, high, range);
  return range[1] > 0;
}

/* The receiver's view of the page, or of the level that its distance calls for; false where
 * the page is turned away. */
static bool find_view(const struct gather *gather, const struct look *look,
                      struct seen_page *seen) {
  const struct gather_settings *settings = gather->settings;
  if (!seen_page_find(look->page, look->receiver, seen) || !may_see(seen)) return false;
  if (!settings->aids || !settings->aids->levels) return true;
  const struct levels *levels = &settings->aids->levels[look->page_number];
  int level = settings->level < 0 ? levels_choose(levels, seen) : settings->level;
  if (level > levels->count) level = levels->count;
  if (level > 0) seen->page = &levels->page[level - 1];
  return true;
}

/* Does it see any of the page above its tangent plane? Finds the strips. */
static enum result find_strips(struct gather *gather, const struct seen_page *seen, bool *sees,
                               struct error *error) {
  struct strips *whole = gather->whole;
  double range[2];
  *sees = false;
  enum result result =
      seen_page_strips(seen, gather->settings->method == GATHER_VIEWS, whole, error);
  if (result != RESULT_OK || whole[0].count == 0 || whole[1].count == 0) return result;
  heights(seen, whole, range);
  *sees = range[1] > 0;
  return RESULT_OK;
}

static void note_error(struct gather *gather, const struct look *look, double error,
                       struct gathered *gathered) {
  gathered[look->index].error = fmax(gathered[look->index].error, error);
  gather->counts.error = fmax(gather->counts.error, error);
}

static void add_cuts(struct gather *gather, double gain, struct gathered *gathered) {
  static const double gloss[3];
  if (gather->cut) cut_finish(gather->cut);
  for (int k = 0; k < gather->by_cut_count; ++k)
    add(&gathered[gather->by_cut[k].receiver], gather->by_cut[k].irradiance, gloss, gain);
  gather->by_cut_count = 0;
}

/* By the method cut, if there are trees and it takes this receiver. */
static bool take_cut(struct gather *gather, const struct look *look, const struct seen_page *seen,
                     struct gathered *gathered) {
  const struct gather_prepared *aids = gather->settings->aids;
  if (!aids || !aids->trees) return false;
  if (!gather->cut) gather->cut = cut_work_make();
  if (!gather->cut) {
    gather->cut_counts.no_memory = true;
    return false;
  }
  if (gather->by_cut_count == TOGETHER) add_cuts(gather, look->light->gain, gathered);
  if (!cut_sum(aids->trees[look->page_number], seen, gather->settings->tolerance, 0, gather->cut,
               gather->by_cut[gather->by_cut_count].irradiance, &gather->cut_counts))
    return false;
  gather->by_cut[gather->by_cut_count++].receiver = look->index;
  note_error(gather, look, gather->cut_counts.error, gathered);
  return true;
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

static enum result take_look(struct gather *gather, const struct look *look,
                             struct gathered *gathered, struct error *error) {
  struct seen_page seen;
  const bool faces = find_view(gather, look, &seen);
  bool sees = faces;
  const bool open = gather->settings->occlusion && !look->shadows;
  if (sees && !look->shadows && take_cut(gather, look, &seen, gathered)) {
    gather->counts.open_views += open;
    return RESULT_OK;
  }
  enum result result = sees ? find_strips(gather, &seen, &sees, error) : RESULT_OK;
  if (result != RESULT_OK) return result;
  if (!sees) {
    ++gather->counts.pages_behind;
    /* There may be light between the views. */
    if (faces && gather->settings->method == GATHER_VIEWS)
      note_error(gather, look, INFINITY, gathered);
    return RESULT_OK;
  }
  gather->counts.open_views += open;
  if (look->shadows) {
    result = find_visible(gather, &seen, look->receiver, error);
    if (result != RESULT_OK) return result;
    if (all_visible(gather) && take_cut(gather, look, &seen, gathered)) return RESULT_OK;
  }
  double predicted;
  enum gather_method method = choose(gather, look, &seen, &predicted);
  note_error(gather, look, predicted, gathered);
  if (!look->shadows) return sum(gather, look, &seen, gather->whole, method, gathered, error);
  for (int k = 0; k < gather->visible.count && result == RESULT_OK; ++k) {
    result = clip(gather, &gather->visible.rectangles[k], method == GATHER_VIEWS, error);
    if (result == RESULT_OK && gather->part[0].count > 0 && gather->part[1].count > 0)
      result = sum(gather, look, &seen, gather->part, method, gathered, error);
  }
  return result;
}

/* May anything stand between the receivers that face the page, and the page? */
static bool find_shadows(struct gather *gather, const struct light_page *page,
                         const struct receiver *receivers, int count) {
  const struct occlusion *occlusion = gather->settings->occlusion;
  if (!occlusion || gather->settings->all_effects) return occlusion != NULL;
  double lifted[TOGETHER][3], corners[4][3];
  struct seen_page seen;
  int facing = 0;
  for (int k = 0; k < count; ++k) {
    if (!seen_page_find(page, &receivers[k], &seen)) continue;
    if (facing == TOGETHER) return true;
    occlusion_lift(occlusion, receivers[k].position, receivers[k].lift, lifted[facing++]);
  }
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 3; ++c)
      corners[k][c] = page->center[c] + (k & 1 ? 1 : -1) * page->axes[0].half * page->frame[0][c] +
                      (k & 2 ? 1 : -1) * page->axes[1].half * page->frame[1][c];
  return occlusion_between(occlusion, (const double(*)[3])lifted, facing,
                           (const double(*)[3])corners);
}

enum result gather_light(struct gather *gather, const struct receiver *receivers, int count,
                         struct gathered *gathered, struct error *error) {
  const struct gather_settings *settings = gather->settings;
  enum result result = RESULT_OK;
  memset(gathered, 0, (size_t)count * sizeof *gathered);
  gather->waiting = gather->by_cut_count = 0;
  for (int l = 0, number = 0; l < settings->light_count; ++l) {
    const struct light *light = &settings->lights[l];
    for (int page = 0; page < light->count && result == RESULT_OK; ++page, ++number) {
      bool shadows = find_shadows(gather, &light->pages[page], receivers, count);
      for (int k = 0; k < count && result == RESULT_OK; ++k) {
        const struct look look = {light, &light->pages[page], number, shadows, &receivers[k], k};
        result = take_look(gather, &look, gathered, error);
      }
      add_cuts(gather, light->gain, gathered);
      if (result == RESULT_OK) result = take_sums(gather, light->gain, gathered, error);
    }
  }
  gather->counts.receivers += (uint64_t)count;
  gather->counts.microlights = gather->cell_counts.microlights;
  gather->counts.nodes =
      gather->cell_counts.nodes + gather->cut_counts.nodes + gather->cut_counts.views;
  gather->counts.black = gather->cell_counts.black;
  gather->counts.shadow_rays = gather->visible.shadow_rays;
  if (result == RESULT_OK && gather->cut_counts.no_memory)
    result = result_fail(error, RESULT_MEMORY, "out of memory for the lights");
  return result;
}
