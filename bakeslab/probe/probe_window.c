/* probe_window.c - windows fitted to the light.
 *
 * 1. A small bake without interreflection, 24 x 24 directions at a few positions.
 * 2. With interreflection, which is expensive and smooth, a second one of 10 x 10 directions.
 * 3. Along s and t, leave out the samples at either end that hold no more than 1/8000 of a page's
 *    light together; widen what is left by a cell, whose rays may have missed some.
 * 4. The window is the part of the declared one that either bake needs.
 * 5. Unless the script says Canned_Window_Is_Final, one more bake looks at slopes up to REACH. The
 *    window grows until no more than 1/800 of the page's flux is beyond each end. */
#include "probe/probe_window.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "probe/probe_bake.h"
#include "slab/slab_profile.h"

static const double negligible = 1.0 / 4000, negligible_beyond = 1.0 / 800, REACH = 6;
enum { REACH_DIRECTIONS = 48 };

/* Step 3: widens window[2] to hold the light of one axis of a page. */
static void widen(const struct slab *page, int axis, const double *profile, double window[2]) {
  int count = page->samples[axis], low = 0, high = count - 1;
  double all = 0, below = 0, above = 0;
  for (int k = 0; k < count; ++k) all += profile[k];
  if (all == 0) return;
  while (low < count && below + profile[low] <= negligible * all) below += profile[low++];
  while (high >= 0 && above + profile[high] <= negligible * all) above += profile[high--];
  double step = slab_spacing(page, axis);
  window[0] = fmin(window[0], slab_position(page, axis, low) - 1.5 * step);
  window[1] = fmax(window[1], slab_position(page, axis, high) + 1.5 * step);
}

static enum result widen_all(const struct probe_bake *bake, double (*windows)[4],
                             struct error *error) {
  enum result result = RESULT_OK;
  for (int n = 0; n < bake->count && result == RESULT_OK; ++n) {
    struct slab_profile profile;
    result = slab_profile(&bake->pages[n], &profile, error);
    for (int k = 0; k < 2 && result == RESULT_OK; ++k)
      widen(&bake->pages[n], SLAB_S + k, profile.axis[SLAB_S + k], windows[n] + 2 * k);
    slab_profile_free(&profile);
  }
  return result;
}

/* ---- Step 5 ---- */

static struct slab reaching(const struct slab *slab) {
  struct slab wide = *slab;
  for (int k = 0; k < 4; ++k) {
    double low = slab->st_window[k / 2 * 2], high = slab->st_window[k / 2 * 2 + 1];
    double half = fmax(REACH, high - low);
    wide.st_window[k] = (low + high) / 2 + (k % 2 ? half : -half);
  }
  return wide;
}

/* The light of each index along s or t, up to a factor: radiance times cosine and solid angle. */
static void sum_flux(const struct slab *page, int axis, double flux[REACH_DIRECTIONS]) {
  const float *rgb = page->rgb;
  int at[SLAB_AXES];
  for (int k = 0; k < REACH_DIRECTIONS; ++k) flux[k] = 0;
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

/* Grows window[2] of one axis by what the wide page shows beyond it. */
static void grow(const struct slab *wide, int axis, double window[2]) {
  double flux[REACH_DIRECTIONS], all = 0, beyond, step = slab_spacing(wide, axis);
  double declared[2] = {window[0], window[1]};
  sum_flux(wide, axis, flux);
  for (int k = 0; k < REACH_DIRECTIONS; ++k) all += flux[k];
  for (int end = 0; end < 2 && all > 0; ++end) {
    int k = end ? REACH_DIRECTIONS - 1 : 0, inward = end ? -1 : 1;
    beyond = flux[k];
    while (beyond <= negligible_beyond * all) beyond += flux[k += inward];
    double edge = slab_position(wide, axis, k) - inward * step / 2;
    /* A cell on the declared edge does not tell on which side its light is. */
    bool outside = end ? edge - step >= declared[1] - 1e-9 : edge + step <= declared[0] + 1e-9;
    if (outside) window[end] = edge;
  }
}

static enum result probe_beyond(const struct bake_work *work, struct slab *slabs, int positions,
                                struct bake_report *report, struct error *error) {
  const int samples[SLAB_AXES] = {positions, positions, REACH_DIRECTIONS, REACH_DIRECTIONS};
  int count = work->lamp->slab_count;
  struct probe_bake bake = {0};
  struct slab *wide = malloc((size_t)count * sizeof *wide); /* owns nothing */
  enum result result = wide ? RESULT_OK : result_no_memory(error);
  for (int n = 0; n < count && result == RESULT_OK; ++n) wide[n] = reaching(&slabs[n]);
  if (result == RESULT_OK)
    result = probe_bake(work, wide, work->look.effects, samples, 1, &bake, report, error);
  for (int n = 0; n < bake.count && result == RESULT_OK; ++n)
    for (int k = 0; k < 2; ++k) grow(&bake.pages[n], SLAB_S + k, slabs[n].st_window + 2 * k);
  probe_bake_free(&bake);
  free(wide);
  return result;
}

/* Step 4, and the line that tells of it. */
static void fit(struct slab *slab, int page, const double light[4], const double before[4],
                struct probe_windows *windows) {
  double *window = slab->st_window;
  for (int k = 0; k < 4; k += 2) {
    if (light[k] > light[k + 1]) continue; /* no light */
    if (window[k] == before[k]) window[k] = fmax(window[k], light[k]);
    if (window[k + 1] == before[k + 1]) window[k + 1] = fmin(window[k + 1], light[k + 1]);
  }
  double share = (window[1] - window[0]) * (window[3] - window[2]) / (before[1] - before[0]) /
                 (before[3] - before[2]);
  size_t used = strlen(windows->line);
  snprintf(windows->line + used, sizeof windows->line - used,
           "%spage %d: %.3g %% of the declared %.4g to %.4g, %.4g to %.4g", used ? "; " : "",
           page + 1, 100 * share, before[0], before[1], before[2], before[3]);
}

enum result probe_window(const struct bake_work *work, struct slab *slabs,
                         struct probe_windows *windows, struct bake_report *report,
                         struct error *error) {
  enum { MOST_PAGES = 64 };
  int count = work->lamp->slab_count, positions = count > 1 ? 2 : 4;
  struct effects effects = *work->look.effects;
  int bakes = effects.setting[INTERREFLECTION] > 0 ? 2 : 1;
  double light[MOST_PAGES][4], before[MOST_PAGES][4];
  *windows = (struct probe_windows){0};
  if (count > MOST_PAGES)
    return result_fail(error, RESULT_BAD, "--window auto: more than %d pages", MOST_PAGES);
  for (int n = 0; n < MOST_PAGES; ++n)
    for (int k = 0; k < 4; ++k) light[n][k] = k % 2 ? -INFINITY : INFINITY;
  enum result result = RESULT_OK;
  for (int n = 0; n < bakes && result == RESULT_OK; ++n) {
    int directions = n == 0 ? 24 : 10;
    const int samples[SLAB_AXES] = {positions, positions, directions, directions};
    struct probe_bake bake;
    effects.setting[INTERREFLECTION] = n == 0 ? 0 : work->look.effects->setting[INTERREFLECTION];
    result = probe_bake(work, slabs, &effects, samples, 1, &bake, report, error);
    if (result == RESULT_OK) result = widen_all(&bake, light, error);
    probe_bake_free(&bake);
  }
  for (int n = 0; n < count; ++n) memcpy(before[n], slabs[n].st_window, sizeof before[n]);
  if (result == RESULT_OK && !work->lamp->final_window)
    result = probe_beyond(work, slabs, positions, report, error);
  for (int n = 0; n < count && result == RESULT_OK; ++n)
    fit(&slabs[n], n, light[n], before[n], windows);
  return result;
}
