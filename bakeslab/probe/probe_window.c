/* probe_window.c - windows fitted to the light.
 *
 * 1. A small bake without interreflection, 24 x 24 directions at as many positions as a slab
 * usually has: a mirror sends the light of each position somewhere else.
 * 2. With interreflection, which is expensive and smooth, a second one of 10 x 10 directions at few
 *    positions.
 * 3. Along s and t, leave out the samples at either end that hold no more than 1/4000 of a page's
 *    flux together; widen what is left by half a cell, whose rays may have missed some.
 * 4. The window is the part of the declared one that either bake needs.
 * 5. To narrow windows, that is all; a page whose light fills most of its window keeps it.
 * 6. Else, unless the script says Canned_Window_Is_Final, one more bake looks at slopes up to
 * REACH. The window grows until no more than 1/800 of the page's flux is beyond each end. */
#include "probe/probe_window.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "probe/probe_bake.h"

static const double negligible = 1.0 / 4000, negligible_beyond = 1.0 / 800, REACH = 6;
/* Part of the samples that narrower windows must save to be worth the change. */
static const double least_saved = 0.1;
enum { DIRECTIONS = 24, FEW_DIRECTIONS = 10, MOST_DIRECTIONS = 48 };

/* The flux of each index along s or t, up to a factor: radiance times cosine and solid angle. */
static void sum_flux(const struct slab *page, int axis, double flux[MOST_DIRECTIONS]) {
  const float *rgb = page->rgb;
  int at[SLAB_AXES];
  for (int k = 0; k < MOST_DIRECTIONS; ++k) flux[k] = 0;
  for (size_t n = 0; n < slab_sample_count(page); ++n, rgb += 3) {
    double r = 1;
    slab_locate(page, n, at);
    for (int k = 0; k < 2; ++k) {
      double slope = slab_position(page, SLAB_S + k, at[SLAB_S + k]) -
                     slab_kappa(page) * slab_position(page, SLAB_U + k, at[SLAB_U + k]);
      r += slope * slope;
    }
    flux[at[axis]] += (fabs((double)rgb[0]) + fabs((double)rgb[1]) + fabs((double)rgb[2])) / r / r;
  }
}

/* Step 3: widens window[2] to hold the light of one axis of a page. */
static void widen(const struct slab *page, int axis, double window[2]) {
  int count = page->samples[axis], low = 0, high = count - 1;
  double flux[MOST_DIRECTIONS], all = 0, below = 0, above = 0, step = slab_spacing(page, axis);
  sum_flux(page, axis, flux);
  for (int k = 0; k < count; ++k) all += flux[k];
  if (all == 0) return;
  while (low < count && below + flux[low] <= negligible * all) below += flux[low++];
  while (high >= 0 && above + flux[high] <= negligible * all) above += flux[high--];
  window[0] = fmin(window[0], slab_position(page, axis, low) - step);
  window[1] = fmax(window[1], slab_position(page, axis, high) + step);
}

/* ---- Step 6 ---- */

static struct slab reaching(const struct slab *slab) {
  struct slab wide = *slab;
  for (int k = 0; k < 4; ++k) {
    double low = slab->st_window[k / 2 * 2], high = slab->st_window[k / 2 * 2 + 1];
    double half = fmax(REACH, high - low);
    wide.st_window[k] = (low + high) / 2 + (k % 2 ? half : -half);
  }
  return wide;
}

/* Grows window[2] of one axis by what the wide page shows beyond it. */
static void grow(const struct slab *wide, int axis, double window[2]) {
  double flux[MOST_DIRECTIONS], all = 0, beyond, step = slab_spacing(wide, axis);
  double declared[2] = {window[0], window[1]};
  sum_flux(wide, axis, flux);
  for (int k = 0; k < MOST_DIRECTIONS; ++k) all += flux[k];
  for (int end = 0; end < 2 && all > 0; ++end) {
    int k = end ? MOST_DIRECTIONS - 1 : 0, inward = end ? -1 : 1;
    beyond = flux[k];
    while (beyond <= negligible_beyond * all) beyond += flux[k += inward];
    double edge = slab_position(wide, axis, k) - inward * step / 2;
    /* A cell on the declared edge does not tell on which side its light is. */
    bool outside = end ? edge - step >= declared[1] - 1e-9 : edge + step <= declared[0] + 1e-9;
    if (outside) window[end] = edge;
  }
}

static enum result start_beyond(const struct bake_work *work, struct slab *slabs, int positions,
                                struct probe_bake *bake, struct error *error) {
  const int samples[SLAB_AXES] = {positions, positions, MOST_DIRECTIONS, MOST_DIRECTIONS};
  int count = work->lamp->slab_count;
  struct slab *wide = malloc((size_t)count * sizeof *wide); /* owns nothing */
  if (!wide) return result_no_memory(error);
  for (int n = 0; n < count; ++n) wide[n] = reaching(&slabs[n]);
  enum result result = probe_bake_start(work, wide, work->look.effects, samples, 1, bake, error);
  free(wide);
  return result;
}

static double area(const double window[4]) {
  return (window[1] - window[0]) * (window[3] - window[2]);
}

/* Steps 4 and 5, and the line that tells of it. */
static void fit(struct slab *slab, int page, const double light[4], const double before[4],
                bool narrow, struct probe_windows *windows) {
  double *window = slab->st_window;
  for (int k = 0; k < 4; k += 2) {
    if (light[k] > light[k + 1]) continue; /* no light */
    if (window[k] == before[k]) window[k] = fmax(window[k], light[k]);
    if (window[k + 1] == before[k + 1]) window[k + 1] = fmin(window[k + 1], light[k + 1]);
  }
  if (narrow && area(window) > (1 - least_saved) * area(before)) {
    memcpy(window, before, sizeof slab->st_window);
    return;
  }
  size_t used = strlen(windows->line);
  snprintf(windows->line + used, sizeof windows->line - used,
           "%spage %d: %.3g %% of the declared %.4g to %.4g, %.4g to %.4g", used ? "; " : "",
           page + 1, 100 * area(window) / area(before), before[0], before[1], before[2], before[3]);
}

/* Of step 1. */
static int positions(const struct bake_work *work) {
  return work->lamp->slab_count > 1 ? 8 : 16;
}

bool probe_window_pays(const struct bake_work *work) {
  const struct slab *page = &work->slabs[0];
  double samples = (double)slab_sample_count(page);
  return work->options->window == BAKE_WINDOW_AUTO ||
         (work->options->window == BAKE_WINDOW_NARROWED && work->effort.adaptive &&
          samples >= pow(positions(work) * DIRECTIONS, 2));
}

/* The small bakes, which run at once: the light that comes straight, that which is scattered, and
 * what is beyond the windows. */
enum { STRAIGHT, SCATTERED, BEYOND, BAKES };

static enum result start_bakes(const struct bake_work *work, struct slab *slabs, bool beyond,
                               struct probe_bake bakes[BAKES], struct error *error) {
  int uv = positions(work);
  struct effects straight = *work->look.effects;
  straight.setting[INTERREFLECTION] = 0;
  enum result result = probe_bake_start(
      work, slabs, &straight, (int[]){uv, uv, DIRECTIONS, DIRECTIONS}, 1, &bakes[STRAIGHT], error);
  if (result == RESULT_OK && work->look.effects->setting[INTERREFLECTION] > 0)
    result = probe_bake_start(work, slabs, work->look.effects,
                              (int[]){uv / 4, uv / 4, FEW_DIRECTIONS, FEW_DIRECTIONS}, 1,
                              &bakes[SCATTERED], error);
  if (result == RESULT_OK && beyond)
    result = start_beyond(work, slabs, uv / 2, &bakes[BEYOND], error);
  return result;
}

/* Steps 3 to 6. */
static void fit_windows(const struct bake_work *work, struct slab *slabs,
                        const struct probe_bake bakes[BAKES], struct probe_windows *windows) {
  for (int n = 0; n < work->lamp->slab_count; ++n) {
    double light[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY}, before[4];
    memcpy(before, slabs[n].st_window, sizeof before);
    for (int k = 0; k < 2; ++k) {
      for (int kind = STRAIGHT; kind <= SCATTERED; ++kind)
        if (bakes[kind].count) widen(&bakes[kind].pages[n], SLAB_S + k, light + 2 * k);
      if (bakes[BEYOND].count)
        grow(&bakes[BEYOND].pages[n], SLAB_S + k, slabs[n].st_window + 2 * k);
    }
    fit(&slabs[n], n, light, before, work->options->window == BAKE_WINDOW_NARROWED, windows);
  }
}

enum result probe_window(const struct bake_work *work, struct slab *slabs,
                         struct probe_windows *windows, struct bake_report *report,
                         struct error *error) {
  bool beyond = work->options->window != BAKE_WINDOW_NARROWED && !work->lamp->final_window;
  struct probe_bake bakes[BAKES] = {0};
  *windows = (struct probe_windows){0};
  enum result result = start_bakes(work, slabs, beyond, bakes, error);
  for (int n = 0; n < BAKES && result == RESULT_OK; ++n)
    result = probe_bake_wait(&bakes[n], report, error);
  if (result == RESULT_OK) fit_windows(work, slabs, bakes, windows);
  for (int n = 0; n < BAKES; ++n) probe_bake_free(&bakes[n]);
  return result;
}
