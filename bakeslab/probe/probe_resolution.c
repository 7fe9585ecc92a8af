/* probe_resolution.c - the fewest samples for a tolerance.
 *
 * 1. A small bake of 8 x 8 positions and 64 x 64 directions, without interreflection: that is
 *    smooth, and with less light the relative error is the larger one.
 * 2. Its own error at the distance and beyond (slab_accuracy.h), and that of the same bake halved,
 *    for st and uv each: two points of a power law.
 * 3. Continue both to the resolutions of the ladders, and add them.
 * 4. Of those that meet the tolerance take the one with the fewest samples; if none does, the one
 *    with the least error.
 * 5. With a distance asked for, do all that for an st plane at that distance too, and take the
 *    better of both. */
#include "probe/probe_resolution.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch/bake_need.h"
#include "probe/probe_bake.h"
#include "slab/slab_accuracy.h"
#include "slab/slab_resample.h"

/* Of the small bake: 4 rays keep its noise below the errors that it is to show. */
static const int probe_samples[SLAB_AXES] = {8, 8, 64, 64};
enum { PROBE_RAYS = 4 };

/* Where errors are estimated, times the distance. */
enum { DISTANCES = 3 };
static const double distances[DISTANCES] = {1, 2, 8};

/* Not less than 4 positions: all directions of a view are seen from the same few places of the
 * aperture, one a ray, and the noise of too few places is larger than any tolerance. */
static const int uv_ladder[] = {4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64};
static const int st_ladder[] = {8,  12, 16,  20,  24,  32,  40,  48, 64,
                                80, 96, 128, 160, 192, 256, 384, 512};

/* No page gets more samples than this. */
static const double most_samples = 1 << 26;
#define COUNT(array) (sizeof(array) / sizeof *(array))

/* An error that falls as a power of the samples along an axis. */
struct power_law {
  double at; /* of the small bake */
  double power;
};

/* `ratio`: samples over those of the small bake. */
static double error_at(const struct power_law *law, double ratio) {
  return law->at / pow(ratio, law->power);
}

/* Two points give the power with little certainty; it is 1 at edges and 2 where light is smooth. */
static struct power_law make_law(double full, double halved) {
  double power = full > 0 ? log2(halved / full) : 2;
  return (struct power_law){isfinite(full) ? full : 0, fmin(fmax(power, 1), 2)};
}

/* A page's errors at all distances, for one choice of st plane. */
struct page_errors {
  struct power_law st[DISTANCES], uv[DISTANCES];
};

static double worst(const struct page_errors *errors, int pages, int uv, int st) {
  double most = 0;
  for (int n = 0; n < pages; ++n)
    for (int k = 0; k < DISTANCES; ++k)
      most = fmax(most, error_at(&errors[n].st[k], (double)st / probe_samples[SLAB_S]) +
                            error_at(&errors[n].uv[k], (double)uv / probe_samples[SLAB_U]));
  return most;
}

static enum result estimate_page(const struct slab *page, double distance,
                                 struct page_errors *errors, struct error *error) {
  int halved[SLAB_AXES];
  double at[DISTANCES];
  struct slab half = {0};
  const struct slab_sampling unknown = {.sample_noise = NAN, .flux_noise = NAN};
  struct slab_accuracy full[DISTANCES], less[DISTANCES];
  for (int k = 0; k < DISTANCES; ++k) at[k] = distance * distances[k];
  for (int axis = 0; axis < SLAB_AXES; ++axis) halved[axis] = page->samples[axis] / 2;
  enum result result = slab_resample(page, halved, &half, error);
  if (result == RESULT_OK)
    result = slab_accuracy_estimate(page, &unknown, DISTANCES, at, full, error);
  if (result == RESULT_OK)
    result = slab_accuracy_estimate(&half, &unknown, DISTANCES, at, less, error);
  for (int k = 0; k < DISTANCES && result == RESULT_OK; ++k) {
    errors->st[k] = make_law(full[k].st, less[k].st);
    errors->uv[k] = make_law(full[k].uv, less[k].uv);
  }
  slab_free(&half);
  return result;
}

/* Puts a slab's st plane at a distance; its window grows to hold the same rays. */
static void move_plane(struct slab *slab, double distance) {
  double kappa = fabs(1 / distance - slab_kappa(slab));
  for (int k = 0; k < 4; ++k) {
    double half = 0.5 * slab_spacing(slab, k / 2) * slab->samples[k / 2];
    slab->st_window[k] += (k % 2 ? 1 : -1) * kappa * half;
  }
  slab->st_distance = distance;
}

/* Starts step 1 for the st planes as they are, or moved to the distance. */
static enum result start_pages(const struct bake_work *work, const struct slab *slabs, bool moved,
                               struct probe_bake *bake, struct error *error) {
  int pages = work->lamp->slab_count;
  struct effects effects = *work->look.effects;
  struct slab *geometry = calloc((size_t)pages, sizeof *geometry); /* owns nothing */
  if (!geometry) return result_no_memory(error);
  for (int n = 0; n < pages; ++n) {
    geometry[n] = slabs[n];
    if (moved) move_plane(&geometry[n], work->options->for_distance);
  }
  effects.setting[INTERREFLECTION] = 0;
  enum result result =
      probe_bake_start(work, geometry, &effects, probe_samples, PROBE_RAYS, bake, error);
  free(geometry);
  return result;
}

/* Step 2. */
static enum result estimate_pages(const struct bake_work *work, struct probe_bake *bake,
                                  struct page_errors *errors, struct bake_report *report,
                                  struct error *error) {
  enum result result = probe_bake_wait(bake, report, error);
  for (int n = 0; n < bake->count && result == RESULT_OK; ++n)
    result = estimate_page(&bake->pages[n], bake_need_distance(work->options, &bake->pages[n]),
                           &errors[n], error);
  return result;
}

struct choice {
  int uv, st;
  double error;
};

static double samples_of(const struct choice *choice) {
  return pow(choice->uv, 2) * pow(choice->st, 2);
}

static bool is_better(const struct choice *a, const struct choice *b, double tolerance) {
  bool meets[2] = {a->error <= tolerance, b->error <= tolerance};
  if (meets[0] != meets[1]) return meets[0];
  if (!meets[0]) return a->error < b->error;
  return samples_of(a) < samples_of(b) || (samples_of(a) == samples_of(b) && a->error < b->error);
}

/* Steps 3 and 4. */
static struct choice choose(const struct page_errors *errors, int pages,
                            const struct bake_options *options) {
  struct choice best = {0};
  for (size_t n = 0; n < COUNT(uv_ladder); ++n)
    for (size_t k = 0; k < COUNT(st_ladder); ++k) {
      struct choice next = {uv_ladder[n], st_ladder[k], 0};
      if (!options->uv_free) next.uv = options->uv[0];
      if (!options->st_free) next.st = options->st[0];
      next.error = worst(errors, pages, next.uv, next.st);
      if (best.uv && samples_of(&next) > most_samples) continue;
      if (best.uv == 0 || is_better(&next, &best, options->tolerance)) best = next;
    }
  return best;
}

static void say(const struct bake_options *options, const struct choice *choice,
                const struct choice other[2], bool moved, struct probe_resolution *resolution) {
  char planes[128] = "";
  if (options->for_distance > 0)
    snprintf(planes, sizeof planes,
             "; st plane %s, the other way %d positions and %d directions a side",
             moved ? "at that distance" : "as declared", other[!moved].uv, other[!moved].st);
  snprintf(resolution->line, sizeof resolution->line,
           "tolerance %g %s at %.6g lamp units and beyond by %d positions and %d directions a "
           "side, error told %.2g%s",
           options->tolerance, choice->error <= options->tolerance ? "met" : "not met",
           resolution->distance, choice->uv, choice->st, choice->error, planes);
}

/* Gives the pages the samples chosen, and the st plane that they were chosen for. */
static void apply(const struct bake_work *work, const struct choice *choice, bool moved,
                  struct slab *slabs, struct probe_resolution *resolution) {
  const struct bake_options *options = work->options;
  for (int n = 0; n < work->lamp->slab_count; ++n) {
    if (moved) move_plane(&slabs[n], options->for_distance);
    for (int k = 0; k < 2; ++k) {
      slabs[n].samples[SLAB_U + k] = options->uv_free ? choice->uv : options->uv[k];
      slabs[n].samples[SLAB_S + k] = options->st_free ? choice->st : options->st[k];
    }
    resolution->distance = fmax(resolution->distance, bake_need_distance(work->options, &slabs[n]));
  }
}

enum result probe_resolution(const struct bake_work *work, struct slab *slabs,
                             struct probe_resolution *resolution, struct bake_report *report,
                             struct error *error) {
  const struct bake_options *options = work->options;
  struct choice choices[2] = {0};
  struct probe_bake bakes[2] = {0};
  int pages = work->lamp->slab_count, planes = options->for_distance > 0 ? 2 : 1, best = 0;
  struct page_errors *errors = calloc((size_t)pages, sizeof *errors);
  enum result result = errors ? RESULT_OK : result_no_memory(error);
  for (int n = 0; n < planes && result == RESULT_OK; ++n)
    result = start_pages(work, slabs, n == 1, &bakes[n], error);
  for (int n = 0; n < planes && result == RESULT_OK; ++n) {
    result = estimate_pages(work, &bakes[n], errors, report, error);
    if (result == RESULT_OK) choices[n] = choose(errors, pages, options);
    if (result == RESULT_OK && n && is_better(&choices[n], &choices[0], options->tolerance))
      best = n;
  }
  if (result == RESULT_OK) {
    apply(work, &choices[best], best == 1, slabs, resolution);
    say(options, &choices[best], choices, best == 1, resolution);
  }
  for (int n = 0; n < planes; ++n) probe_bake_free(&bakes[n]);
  free(errors);
  return result;
}
