/* cluster.c - how many lights each page of a lamp gets, and how good they are.
 *
 * A page starts with one light; the number doubles, each time with a fit of all,
 * so that more lights are never a worse start than fewer. */
#include "include/cluster/cluster.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "include/text/include_light.h"
#include "include/text/include_text.h"
#include "slab/plane.h"

const double cluster_distances[CLUSTER_DISTANCES] = {1, 4, 16};

/* POV-Ray takes light colours up to here; the include divides by 2 pi fade^2. */
static const double largest_colour = 1e37;

/* Twice the lights help if they leave at most this share of the error. */
static const double least_help = 0.9;

int cluster_light_count(const struct cluster *cluster) {
  int count = 0;
  for (int p = 0; p < cluster->page_count; ++p) count += cluster->pages[p].count;
  return count;
}

int cluster_point_count(const struct cluster *cluster) {
  int points = 0;
  for (int p = 0; p < cluster->page_count; ++p)
    for (int k = 0; k < cluster->pages[p].count; ++k)
      points += cluster->pages[p].lights[k].size[0] * cluster->pages[p].lights[k].size[1];
  return points;
}

double cluster_worst_error(const struct cluster *cluster) {
  double worst = 0;
  for (int p = 0; p < cluster->page_count; ++p) worst = fmax(worst, cluster->pages[p].error_at);
  return worst;
}

/* One page on the way: what it is fitted to. */
struct work {
  const struct slab *slab;
  struct cluster_target target, gauge; /* to fit to; to tell the error by */
  struct cluster_light *candidates;
  int candidate_count;
  double unit;
};

static enum result grow_page(const struct work *work, int wanted, struct cluster_page *page,
                             struct error *error) {
  enum result result = cluster_grow(&work->target, work->candidates, work->candidate_count,
                                    page->lights, &page->count, wanted, error);
  /* The second time with the points that the lights then need. */
  for (int times = 0; times < 2 && result == RESULT_OK; ++times) {
    cluster_set_sizes(page->lights, page->count, CLUSTER_MOST_SAMPLES);
    result = cluster_fit(&work->target, page->lights, &page->count, error);
  }
  return result;
}

/* The lights for good: in the slab's units, with their errors. */
static enum result finish_page(const struct work *work, int number, double distance,
                               struct cluster_page *page, struct error *error) {
  double most = 0, fade = 1e-3;
  if (page->count == 0)
    return result_fail(error, RESULT_BAD, "page %d: no area light fits it; use --mode sheet",
                       number + 1);
  for (int k = 0; k < page->count; ++k)
    for (int c = 0; c < 3; ++c) {
      page->lights[k].rgb[c] *= work->unit;
      most = fmax(most, page->lights[k].rgb[c]);
    }
  if (!(most / (2 * M_PI * fade * fade) <= largest_colour))
    return result_fail(error, RESULT_BAD,
                       "page %d: it is brighter than POV-Ray's light colours hold (1e37); use a "
                       "larger radiance unit",
                       number + 1);
  for (int d = 0; d < CLUSTER_DISTANCES; ++d) {
    struct cluster_target gauge;
    page->error[d] = page->error_at;
    if (cluster_distances[d] == distance) continue;
    enum result result = cluster_gauge_make(work->slab, cluster_distances[d], &gauge, error);
    if (result == RESULT_OK) page->error[d] = cluster_error(&gauge, page->lights, page->count, 1);
    cluster_target_free(&gauge);
    if (result != RESULT_OK) return result;
  }
  page->frame = *work->slab;
  page->frame.rgb = NULL;
  page->frame.json = NULL;
  return slab_flux(work->slab, page->flux, error);
}

/* Grows a page up to `lights`, or, where that is 0, until it meets the tolerance or twice
 * the lights help no more; keeps the best on the way. */
static enum result grow(const struct work *work, int lights, double tolerance,
                        struct cluster_page *page, struct error *error) {
  int most = lights > 0 ? lights : CLUSTER_MOST_LIGHTS;
  struct cluster_page now = {.count = 0};
  now.lights = calloc((size_t)most, sizeof *now.lights);
  if (!now.lights) return result_fail(error, RESULT_MEMORY, "out of memory");
  enum result result = RESULT_OK;
  page->error_at = INFINITY;
  for (int wanted = 1, idle = 0; result == RESULT_OK;
       wanted = 2 * wanted < most ? 2 * wanted : most) {
    result = grow_page(work, wanted, &now, error);
    if (result != RESULT_OK) break;
    double reached = cluster_error(&work->gauge, now.lights, now.count, work->unit);
    idle = reached < least_help * page->error_at ? 0 : idle + 1;
    if (reached < page->error_at) {
      memcpy(page->lights, now.lights, (size_t)now.count * sizeof *now.lights);
      page->count = now.count;
      page->error_at = reached;
    }
    if (wanted >= most) break;
    if (lights > 0) continue;
    if (reached <= tolerance || (idle >= 2 && reached > 2 * tolerance)) break;
  }
  free(now.lights);
  return result;
}

static enum result make_page(const struct slab *slab, int number, int lights, double tolerance,
                             double distance, struct cluster_page *page, struct error *error) {
  struct work work = {.slab = slab};
  page->lights = calloc((size_t)CLUSTER_MOST_LIGHTS, sizeof *page->lights);
  enum result result =
      page->lights ? RESULT_OK : result_fail(error, RESULT_MEMORY, "out of memory");
  if (result == RESULT_OK)
    result = cluster_target_make(slab, distance, &work.unit, &work.target, error);
  if (result == RESULT_OK) result = cluster_gauge_make(slab, distance, &work.gauge, error);
  if (result == RESULT_OK)
    result = cluster_seed(slab, distance, &work.candidates, &work.candidate_count, error);
  for (int k = 0; k < work.candidate_count && result == RESULT_OK; ++k)
    cluster_limit(&work.target, &work.candidates[k]);
  if (result == RESULT_OK) result = grow(&work, lights, tolerance, page, error);
  if (result == RESULT_OK) result = finish_page(&work, number, distance, page, error);
  free(work.candidates);
  cluster_target_free(&work.target);
  cluster_target_free(&work.gauge);
  return result;
}

/* Shares `lights` among the pages by flux, the next to the page with most of it a
 * light. One each, if there are too few. */
static enum result share_lights(const struct slab *slabs, const int *lit, int count, int lights,
                                int *shares, struct error *error) {
  double fluxes[CLUSTER_MOST_PAGES], rgb[3];
  for (int p = 0; p < count; ++p) {
    shares[p] = 1;
    enum result result = slab_flux(&slabs[lit[p]], rgb, error);
    if (result != RESULT_OK) return result;
    fluxes[p] = rgb[0] + rgb[1] + rgb[2];
  }
  for (int left = lights - count; left > 0; --left) {
    int best = -1;
    for (int p = 0; p < count; ++p)
      if (shares[p] < CLUSTER_MOST_LIGHTS &&
          (best < 0 || fluxes[p] / shares[p] > fluxes[best] / shares[best]))
        best = p;
    if (best < 0) break;
    ++shares[best];
  }
  return RESULT_OK;
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

enum result cluster_make(const struct slab *slabs, int count, int lights, double tolerance,
                         double distance, struct cluster *cluster, struct error *error) {
  int lit[CLUSTER_MOST_PAGES], shares[CLUSTER_MOST_PAGES] = {0}, lit_count = 0;
  memset(cluster, 0, sizeof *cluster);
  cluster->distance = distance;
  for (int k = 0; k < count; ++k) {
    enum result result = include_check_radiance(&slabs[k], k, error);
    if (result != RESULT_OK) return result;
    if (include_peak(&slabs[k]) <= 0) continue;
    if (lit_count == CLUSTER_MOST_PAGES)
      return result_fail(error, RESULT_BAD, "more than %d pages are too many for a cluster",
                         CLUSTER_MOST_PAGES);
    lit[lit_count++] = k;
  }
  cluster->black_pages = count - lit_count;
  if (!lit_count) return include_no_light(error);
  if (lights > lit_count * CLUSTER_MOST_LIGHTS)
    return result_fail(error, RESULT_BAD,
                       "%d lights are too many for a cluster, which has at most %d for each page "
                       "with light; ask for --lights %d",
                       lights, CLUSTER_MOST_LIGHTS, lit_count * CLUSTER_MOST_LIGHTS);
  if (lights > 0) {
    enum result result = share_lights(slabs, lit, lit_count, lights, shares, error);
    if (result != RESULT_OK) return result;
  }
  cluster->pages = calloc((size_t)lit_count, sizeof *cluster->pages);
  if (!cluster->pages) return result_fail(error, RESULT_MEMORY, "out of memory");
  for (int p = 0; p < lit_count; ++p) {
    enum result result = make_page(&slabs[lit[p]], lit[p], shares[p], tolerance, distance,
                                   &cluster->pages[cluster->page_count++], error);
    if (result != RESULT_OK) return result;
  }
  cluster->stamp = stamp_of(cluster);
  return RESULT_OK;
}

void cluster_free(struct cluster *cluster) {
  for (int p = 0; p < cluster->page_count; ++p) free(cluster->pages[p].lights);
  free(cluster->pages);
  memset(cluster, 0, sizeof *cluster);
}
