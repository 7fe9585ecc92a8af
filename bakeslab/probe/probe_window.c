/* probe_window.c - windows fitted to the light.
 *
 * 1. A small bake without interreflection, 24 x 24 directions at a few positions.
 * 2. With interreflection, which is expensive and smooth, a second one of 10 x 10 directions.
 * 3. Along s and t, leave out the samples at either end that hold no more than 1/4000 of a page's
 *    light together; widen what is left by a cell, whose rays may have missed some.
 * 4. The window is the part of the declared one that either bake needs. */
#include "probe/probe_window.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "probe/probe_bake.h"
#include "slab/slab_profile.h"

static const double negligible = 1.0 / 4000;

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

/* Step 4, and the line that tells of it. */
static void fit(struct slab *slab, int page, const double light[4], struct probe_windows *windows) {
  double *window = slab->st_window, before[4];
  memcpy(before, window, sizeof before);
  for (int k = 0; k < 4; k += 2) {
    if (light[k] > light[k + 1]) continue; /* no light */
    window[k] = fmax(window[k], light[k]);
    window[k + 1] = fmin(window[k + 1], light[k + 1]);
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
  double light[MOST_PAGES][4];
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
  for (int n = 0; n < count && result == RESULT_OK; ++n) fit(&slabs[n], n, light[n], windows);
  return result;
}
