/* cluster.c - area lights that are fitted to a lamp's pages.
 *
 * 1. The number of lights is shared among the pages by their flux.
 * 2. A page becomes a target: its irradiance on receivers of planes around the distance asked
 *    for, and its flux (cluster_target.c).
 * 3. Candidates for lights are groups of the slab's 4D cells, in which close cells light the
 *    same: halved across their longest axis, relaxed by Lloyd's iteration [1] (cluster_seed.c).
 * 4. Of the candidates, that which takes most of what is left of the target becomes a light,
 *    with all colours solved for anew, until there are as many as wanted: orthogonal matching
 *    pursuit [2] (cluster_grow.c), with colours that are not negative [3] (cluster_colours.c).
 * 5. All numbers of the lights are refined by Levenberg and Marquardt's method [4]; the colours,
 *    which enter linearly, are solved for at each trial, as in [5] (cluster_fit.c).
 * 6. From one light on, 4 and 5 are done for twice as many, so that more lights are never a worse
 *    start than fewer, up to all of the page's, or until they meet the tolerance or twice as
 *    many help no more. The best are kept.
 * 7. The error is told on receivers that had no part in the fit, and, in the shadow of an edge,
 *    by plane_shadow.h.
 * 8. Where the work is bounded, it is counted (cluster_fit.h) and shared evenly among the pages; a
 *    page's fit ends with the lights that it then has.
 * Nothing is random.
 *
 * [1] Lloyd, "Least squares quantization in PCM", 1982.
 * [2] Pati, Rezaiifar and Krishnaprasad, "Orthogonal matching pursuit", 1993.
 * [3] Lawson and Hanson, "Solving Least Squares Problems", 1974, chapter 23.
 * [4] Marquardt, "An algorithm for least-squares estimation of nonlinear parameters", 1963.
 * [5] Golub and Pereyra, "The differentiation of pseudo-inverses and nonlinear least squares
 *     problems whose variables separate", 1973. */
#include "include/cluster/cluster.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "include/cluster/cluster_fit.h"
#include "include/cluster/cluster_grow.h"
#include "include/cluster/cluster_seed.h"
#include "slab/plane_shadow.h"

const double cluster_distances[CLUSTER_DISTANCES] = {1, 4, 16};

/* Points of a page's lights. */
enum { MOST_POINTS = 128 };

/* Twice the lights help if they leave at most this share of the error. */
static const double least_help = 0.9;

int cluster_light_count(const struct cluster *cluster) {
  int count = 0;
  for (int p = 0; p < cluster->page_count; ++p) count += cluster->pages[p].count;
  return count;
}

int cluster_page_points(const struct cluster_page *page) {
  int points = 0;
  for (int k = 0; k < page->count; ++k) points += page->lights[k].size[0] * page->lights[k].size[1];
  return points;
}

/* One page on the way: what it is fitted to. */
struct work {
  const struct slab *slab;
  const struct cluster_wish *wish;
  struct cluster_target target, gauge; /* to fit to; to tell the error by */
  struct plane_shadow shadow;          /* and that in a shadow */
  struct cluster_light *candidates;
  int candidate_count;
  struct cluster_work effort;
};

/* Work of growing once: what each candidate gives to each receiver, with some points each. */
static double growing_work(const struct work *work) {
  double points = 0;
  for (int k = 0; k < work->candidate_count; ++k)
    points += work->candidates[k].size[0] * work->candidates[k].size[1];
  return points * work->target.count;
}

static enum result grow_page(struct work *work, int wanted, struct cluster_page *page,
                             struct error *error) {
  cluster_work_add(&work->effort, growing_work(work));
  enum result result = cluster_grow(&work->target, work->candidates, work->candidate_count,
                                    page->lights, &page->count, wanted, error);
  /* The second time with the points that the lights then need. */
  for (int times = 0; times < 2 && result == RESULT_OK; ++times) {
    cluster_set_sizes(page->lights, page->count, MOST_POINTS);
    result = cluster_fit(&work->target, page->lights, &page->count, &work->effort, error);
  }
  return result;
}

/* The lights for good: in the slab's units, with their errors. `number` is the page's. */
static enum result finish_page(const struct work *work, int number, double distance,
                               struct cluster_page *page, struct error *error) {
  double most = 0, fade = 1e-3;
  if (page->count == 0)
    return result_fail(error, RESULT_BAD, "page %d: no area light fits it; use --mode sheet",
                       number + 1);
  for (int k = 0; k < page->count; ++k)
    for (int c = 0; c < 3; ++c) {
      page->lights[k].rgb[c] *= work->target.unit;
      most = fmax(most, page->lights[k].rgb[c]);
    }
  enum result result = include_check_colour(most / (2 * M_PI * fade * fade), number, error);
  for (int d = 0; d < CLUSTER_DISTANCES && result == RESULT_OK; ++d) {
    struct cluster_target gauge = {.count = 0};
    page->error[d] = page->error_at;
    if (cluster_distances[d] == distance) continue;
    result = cluster_gauge_make(work->slab, cluster_distances[d], &gauge, error);
    if (result == RESULT_OK) page->error[d] = cluster_error(&gauge, page->lights, page->count, 1);
    cluster_target_free(&gauge);
  }
  return result;
}

/* The lights that a receiver sees past an edge. */
static void add_seen(const void *of, int k, const struct plane_shadow_receiver *receiver,
                     double rgb[3]) {
  (void)k;
  const struct cluster_page *page = of;
  double width = plane_width(&page->frame), until[2], at[3];
  for (int c = 0; c < 2; ++c) until[c] = receiver->until[c] / width;
  for (int c = 0; c < 3; ++c) at[c] = receiver->at[c] / width;
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int n = 0; n < page->count; ++n) {
    double share = cluster_irradiance_until(&page->lights[n], until, at);
    for (int c = 0; c < 3; ++c) rgb[c] += page->lights[n].rgb[c] * share;
  }
}

/* Its shadow's error, before its lights are in the slab's units. */
static double shadow_error(const struct work *work, const struct cluster_page *page) {
  struct cluster_page now = *page;
  now.frame = include_frame(work->slab);
  for (int k = 0; k < now.count; ++k)
    for (int c = 0; c < 3; ++c) now.lights[k].rgb[c] *= work->target.unit;
  return plane_shadow_error(&work->shadow, add_seen, &now, 0);
}

/* Grows a page up to `lights`, or, where that is 0, until it meets the tolerance or twice
 * the lights help no more, or there is no work left; keeps the best on the way. */
static enum result grow(struct work *work, int lights, struct cluster_page *page, bool *cut_short,
                        struct error *error) {
  int most = lights > 0 ? lights : CLUSTER_MOST_LIGHTS;
  double tolerance = work->wish->tolerance, best = INFINITY;
  struct cluster_page now = {.count = 0};
  for (int wanted = 1, idle = 0;; wanted = 2 * wanted < most ? 2 * wanted : most) {
    enum result result = grow_page(work, wanted, &now, error);
    if (result != RESULT_OK) return result;
    now.error_at = cluster_error(&work->gauge, now.lights, now.count, work->target.unit);
    now.shadow_at = shadow_error(work, &now);
    double reached = work->wish->shadows ? fmax(now.error_at, now.shadow_at) : now.error_at;
    idle = reached < least_help * best ? 0 : idle + 1;
    if (reached < best) {
      memcpy(page->lights, now.lights, sizeof now.lights);
      page->count = now.count;
      page->error_at = now.error_at;
      page->shadow_at = now.shadow_at;
      best = reached;
    }
    if (wanted >= most) return RESULT_OK;
    if (lights == 0 && (reached <= tolerance || (idle >= 2 && reached > 2 * tolerance)))
      return RESULT_OK;
    if (work->effort.done + growing_work(work) > work->effort.most) {
      *cut_short = true;
      return RESULT_OK;
    }
  }
}

/* Page `place` of those with light, `number` of all. */
static enum result make_page(const struct slab *slab, int number, int place, int lights,
                             const struct cluster_wish *wish, struct cluster *cluster,
                             struct error *error) {
  double distance = wish->distance, pages = cluster->page_count;
  struct cluster_page *page = &cluster->pages[place];
  struct work work = {.slab = slab,
                      .wish = wish,
                      .effort = {.most = wish->work > 0 ? wish->work / pages : INFINITY,
                                 .progress = wish->progress,
                                 .begun = place / pages,
                                 .part = 1 / pages}};
  enum result result = cluster_target_make(slab, distance, wish->intensity, &work.target, error);
  if (result == RESULT_OK) result = cluster_gauge_make(slab, distance, &work.gauge, error);
  if (result == RESULT_OK)
    result = plane_shadow_make(slab, distance * plane_width(slab), &work.shadow, error);
  if (result == RESULT_OK)
    result = cluster_seed(slab, distance, &work.candidates, &work.candidate_count, error);
  for (int k = 0; k < work.candidate_count && result == RESULT_OK; ++k)
    cluster_limit(&work.target, &work.candidates[k]);
  if (result == RESULT_OK) result = grow(&work, lights, page, &cluster->cut_short, error);
  if (result == RESULT_OK) result = finish_page(&work, number, distance, page, error);
  free(work.candidates);
  plane_shadow_free(&work.shadow);
  cluster_target_free(&work.target);
  cluster_target_free(&work.gauge);
  return result;
}

/* Shares `lights` among the pages by flux, the next to the page with most of it a
 * light. One each, if there are too few. */
static void share_lights(const struct cluster *cluster, int lights, int *shares) {
  double fluxes[CLUSTER_MOST_PAGES];
  for (int p = 0; p < cluster->page_count; ++p) {
    const double *flux = cluster->pages[p].flux;
    fluxes[p] = flux[0] + flux[1] + flux[2];
    shares[p] = 1;
  }
  for (int left = lights - cluster->page_count; left > 0; --left) {
    int best = -1;
    for (int p = 0; p < cluster->page_count; ++p)
      if (shares[p] < CLUSTER_MOST_LIGHTS &&
          (best < 0 || fluxes[p] / shares[p] > fluxes[best] / shares[best]))
        best = p;
    if (best < 0) break;
    ++shares[best];
  }
}

static uint64_t stamp_of(const struct cluster *cluster) {
  uint64_t hash = include_hash_start;
  for (int p = 0; p < cluster->page_count; ++p) {
    const struct cluster_page *page = &cluster->pages[p];
    const double *vectors[4] = {page->frame.u, page->frame.v, page->frame.normal,
                                page->frame.center};
    for (int k = 0; k < 4; ++k) hash = include_hash(hash, vectors[k], 3 * sizeof(double));
    for (int k = 0; k < page->count; ++k)
      hash = include_hash(hash, &page->lights[k], sizeof page->lights[k]);
  }
  return hash;
}

static enum result check_counts(int pages, int lights, struct error *error) {
  if (pages > CLUSTER_MOST_PAGES)
    return result_fail(error, RESULT_BAD, "more than %d pages are too many for a cluster",
                       CLUSTER_MOST_PAGES);
  if (lights > pages * CLUSTER_MOST_LIGHTS)
    return result_fail(error, RESULT_BAD,
                       "%d lights are too many for a cluster, which has at most %d for each page "
                       "with light; ask for --lights %d",
                       lights, CLUSTER_MOST_LIGHTS, pages * CLUSTER_MOST_LIGHTS);
  return RESULT_OK;
}

/* The pages without lights, but with their flux. */
static enum result make_pages(const struct slab *const *lit, int count, struct cluster *cluster,
                              struct error *error) {
  enum result result = RESULT_OK;
  cluster->pages = calloc((size_t)count, sizeof *cluster->pages);
  if (!cluster->pages) return result_no_memory(error);
  cluster->page_count = count;
  for (int p = 0; p < count && result == RESULT_OK; ++p) {
    cluster->pages[p].frame = include_frame(lit[p]);
    result = slab_flux(lit[p], cluster->pages[p].flux, error);
  }
  return result;
}

enum result cluster_make(const struct slab *slabs, int count, const struct cluster_wish *wish,
                         struct cluster *cluster, struct error *error) {
  int shares[CLUSTER_MOST_PAGES] = {0}, lit_count = 0;
  const struct slab **lit = NULL;
  memset(cluster, 0, sizeof *cluster);
  cluster->distance = wish->distance;
  enum result result = include_lit_pages(slabs, count, &cluster->lamp, &lit, &lit_count, error);
  if (result == RESULT_OK) result = check_counts(lit_count, wish->lights, error);
  if (result == RESULT_OK) result = make_pages(lit, lit_count, cluster, error);
  if (result == RESULT_OK && wish->lights > 0) share_lights(cluster, wish->lights, shares);
  for (int p = 0; p < lit_count && result == RESULT_OK; ++p)
    result = make_page(lit[p], (int)(lit[p] - slabs), p, shares[p], wish, cluster, error);
  if (result == RESULT_OK) cluster->lamp.stamp = stamp_of(cluster);
  free(lit);
  return result;
}

void cluster_free(struct cluster *cluster) {
  free(cluster->pages);
  memset(cluster, 0, sizeof *cluster);
}
