/* probe.c - see probe.h. */
#include "probe.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "probe_take.h"

/* Directions along an axis of a take. Interreflection and extended sources are dear: their
 * takes are sparse. */
enum { DENSE = 24, SPARSE = 10 };

/* ---- Comparing ---- */

static double luminance(const float *rgb) {
  return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

static double flux_of(const struct probe_take *take) {
  double sum = 0, rgb[3];
  for (int n = 0; n < take->count; ++n) {
    slab_flux(&take->pages[n], rgb);
    sum += 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  }
  return sum;
}

static double ratio(double part, double whole) {
  if (part == 0) return 0;
  return whole != 0 ? part / whole : INFINITY;
}

/* The light of a page by direction (all positions together, as seen from afar) and by
 * position (all directions, as seen close up), one after the other. */
static void sum_marginals(const struct slab *page, double *by_direction, double *by_position) {
  const int *n = page->samples;
  const float *sample = page->rgb;
  for (int y = 0; y < slab_height(page); ++y)
    for (int x = 0; x < slab_width(page); ++x, sample += 3) {
      double light = luminance(sample);
      by_direction[y % n[SLAB_T] * n[SLAB_S] + x % n[SLAB_S]] += light;
      by_position[y / n[SLAB_T] * n[SLAB_U] + x / n[SLAB_S]] += light;
    }
}

/* Adds to the sums of squares of what differs and of all. */
static void add_squares(const double *a, const double *b, size_t count, double sums[2]) {
  for (size_t k = 0; k < count; ++k) {
    sums[0] += (b[k] - a[k]) * (b[k] - a[k]);
    sums[1] += b[k] * b[k];
  }
}

static struct probe_change compare(const struct probe_take *without,
                                   const struct probe_take *with) {
  enum { MOST = DENSE * DENSE };
  double sums[2][2] = {{0}}, flux = flux_of(with);
  for (int n = 0; n < with->count; ++n) {
    const int *samples = with->pages[n].samples;
    double light[2][2][MOST] = {{{0}}}; /* without, with; by direction, by position */
    sum_marginals(&without->pages[n], light[0][0], light[0][1]);
    sum_marginals(&with->pages[n], light[1][0], light[1][1]);
    for (int k = 0; k < 2; ++k)
      add_squares(light[0][k], light[1][k], (size_t)samples[2 - 2 * k] * (size_t)samples[3 - 2 * k],
                  sums[k]);
  }
  return (struct probe_change){
      .flux = ratio(flux - flux_of(without), flux),
      .rms = sqrt(fmax(ratio(sums[0][0], sums[0][1]), ratio(sums[1][0], sums[1][1]))),
      .rays = ratio(with->traced, without->traced)};
}

static bool matters(const struct probe_change *change, double threshold) {
  return fabs(change->flux) > threshold || change->rms > 2 * threshold;
}

/* ---- Deciding ---- */

/* Few positions do where there are several pages. */
static enum slab_result take(const struct bake_work *work, const struct effects *effects,
                             bool sparse, struct probe_take *out, struct bake_report *report,
                             struct slab_error *error) {
  int positions = work->lamp->slab_count > 1 ? 2 : 4, directions = sparse ? SPARSE : DENSE;
  const int samples[SLAB_AXES] = {positions, positions, directions, directions};
  return probe_take(work, work->lamp->slabs, effects, samples, 1, out, report, error);
}

static bool is_dear(enum effect effect) {
  return effect == INTERREFLECTION || effect == EXTENDED_SOURCE;
}

/* Whether rays still end at the trace level of this take: more levels may matter, though
 * these did not. */
static bool is_too_shallow(enum effect effect, int setting, const struct probe_take *take) {
  return effect == DEEP_TRACE && take->depth >= setting;
}

/* Tries one effect on top of `effects`, of which *base is the take, and leaves both as found
 * best. */
static enum slab_result try_effect(const struct bake_work *work, enum effect effect,
                                   struct effects *effects, struct probe_take *base,
                                   struct probe_effect *found, struct bake_report *report,
                                   struct slab_error *error) {
  enum slab_result result = SLAB_OK;
  bool go_on = true;
  for (const int *step = effect_ladder(effect); *step && go_on && !result; ++step) {
    struct effects more = *effects;
    struct probe_take with;
    struct probe_change change = {0};
    more.setting[effect] = *step;
    result = take(work, &more, is_dear(effect), &with, report, error);
    if (!result) change = compare(base, &with);
    bool good = matters(&change, work->options->effect_threshold);
    if (effects->setting[effect]) {
      found->next = change;
      found->tried = true;
      found->converged = !good;
    } else {
      found->first = change;
    }
    go_on = good || is_too_shallow(effect, *step, &with);
    if (good) {
      *effects = more;
      probe_take_free(base);
      *base = with;
    } else {
      probe_take_free(&with);
    }
  }
  return result;
}

enum slab_result probe_effects(const struct bake_work *work, struct effects *effects,
                               struct probe *probe, struct bake_report *report,
                               struct slab_error *error) {
  static const enum effect order[EFFECTS] = {DEEP_TRACE, CAUSTICS, EXTENDED_SOURCE,
                                             INTERREFLECTION};
  struct probe_take base = {0};
  *effects = (struct effects){0};
  *probe = (struct probe){0};
  enum slab_result result = take(work, effects, false, &base, report, error);
  for (int k = 0; k < EFFECTS && !result; ++k) {
    if (k && is_dear(order[k]) && !is_dear(order[k - 1])) { /* from here on, other rays */
      probe_take_free(&base);
      result = take(work, effects, true, &base, report, error);
    }
    if (!result)
      result = try_effect(work, order[k], effects, &base, &probe->effects[order[k]], report, error);
  }
  probe_take_free(&base);
  return result;
}

void probe_say(const struct probe *probe, const struct effects *effects, enum effect effect,
               char line[PROBE_LINE]) {
  static const char *const units[EFFECTS] = {[INTERREFLECTION] = "bounces",
                                             [CAUSTICS] = "photons",
                                             [EXTENDED_SOURCE] = "lights a side",
                                             [DEEP_TRACE] = "levels"};
  const struct probe_effect *found = &probe->effects[effect];
  int setting = effects->setting[effect];
  int used = snprintf(line, PROBE_LINE, "%s: flux %+.2g %%, %.2g %% RMS, rays x %.2g",
                      setting ? "on" : "off", 100 * found->first.flux, 100 * found->first.rms,
                      found->first.rays);
  if (setting && used > 0 && used < PROBE_LINE)
    used += snprintf(line + used, (size_t)(PROBE_LINE - used), "; %d %s", setting, units[effect]);
  if (setting && found->tried && used > 0 && used < PROBE_LINE)
    snprintf(line + used, (size_t)(PROBE_LINE - used), ", %s %.2g %%, %.2g %% RMS",
             found->converged ? "more would change" : "not converged, the last change was",
             100 * found->next.flux, 100 * found->next.rms);
}
