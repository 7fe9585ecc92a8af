/* probe.c - which effects a lamp needs, by small bakes.
 *
 * 1. Start without effects. Try each in turn, from the cheapest to the most expensive, on top of
 *    those that matter so far, at the first step of its ladder (effects.h).
 * 2. Bake a few directions at 4 x 4 positions with and without it: the same rays, so that noise
 *    cancels in the difference.
 * 3. The change of flux is a ratio estimate; its standard error is that of four interleaved
 *    subsamples (Cochran 1977, chapter 6). While the threshold is within two standard errors,
 *    double the directions along an axis.
 * 4. An effect that matters goes one step up its ladder, and again, until a step does not matter
 *    or there is none. Photons, whose error falls slowly, are tried once more with twice as many.
 *
 * W. G. Cochran, "Sampling Techniques", third edition, 1977. */
#include "probe/probe.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "probe/probe_bake.h"

/* Positions and directions along an axis of a small bake; expensive effects start with SPARSE
 * directions, and no bake has more than MOST_DIRECTIONS. */
enum { POSITIONS = 4, DENSE = 20, SPARSE = 10, MOST_DIRECTIONS = 40 };

/* ---- 2. and 3. What an effect changes ---- */

/* The subsamples: every other position along u and v. */
enum { PARTS = 4 };

static void sum_parts(const struct probe_bake *bake, double flux[PARTS]) {
  for (int part = 0; part < PARTS; ++part) flux[part] = 0;
  for (int n = 0; n < bake->count; ++n) {
    const struct slab *page = &bake->pages[n];
    const int *samples = page->samples;
    const float *sample = page->rgb;
    double area = slab_spacing(page, SLAB_S) * slab_spacing(page, SLAB_T) *
                  slab_spacing(page, SLAB_U) * slab_spacing(page, SLAB_V);
    for (int y = 0; y < slab_height(page); ++y)
      for (int x = 0; x < slab_width(page); ++x, sample += 3) {
        double s = slab_position(page, SLAB_S, x % samples[SLAB_S]);
        double t = slab_position(page, SLAB_T, y % samples[SLAB_T]);
        double r = 1 + s * s + t * t; /* close enough with a finite st plane too */
        flux[2 * (y / samples[SLAB_T] % 2) + x / samples[SLAB_S] % 2] +=
            slab_luminance(sample) * area / (r * r);
      }
  }
}

static double ratio(double part, double whole) {
  if (part == 0) return 0;
  return whole != 0 ? part / whole : INFINITY;
}

/* Sums over the other two axes: the light of a page by direction, as seen from afar, and by
 * position, as seen close up. */
static void sum_marginals(const struct slab *page, double *by_direction, double *by_position) {
  const int *n = page->samples;
  const float *sample = page->rgb;
  for (int y = 0; y < slab_height(page); ++y)
    for (int x = 0; x < slab_width(page); ++x, sample += 3) {
      double light = slab_luminance(sample);
      by_direction[y % n[SLAB_T] * n[SLAB_S] + x % n[SLAB_S]] += light;
      by_position[y / n[SLAB_T] * n[SLAB_U] + x / n[SLAB_S]] += light;
    }
}

/* Adds to the sums of squares of the difference b - a and of b. */
static void add_squares(const double *a, const double *b, size_t count, double sums[2]) {
  for (size_t k = 0; k < count; ++k) {
    sums[0] += (b[k] - a[k]) * (b[k] - a[k]);
    sums[1] += b[k] * b[k];
  }
}

/* Fills the change's flux, and returns its standard error. */
static double compare_flux(const struct probe_bake *without, const struct probe_bake *with,
                           struct probe_change *change) {
  double before[PARTS], after[PARTS], sums[2] = {0, 0}, squares = 0;
  sum_parts(without, before);
  sum_parts(with, after);
  for (int part = 0; part < PARTS; ++part) {
    sums[0] += before[part];
    sums[1] += after[part];
  }
  change->flux = ratio(sums[1] - sums[0], sums[1]);
  for (int part = 0; part < PARTS; ++part) {
    double rest = after[part] - before[part] - change->flux * after[part];
    squares += rest * rest;
  }
  return sqrt(ratio(squares * PARTS / (PARTS - 1), sums[1] * sums[1]));
}

static void compare_rms(const struct probe_bake *without, const struct probe_bake *with,
                        struct probe_change *change) {
  enum { MOST = MOST_DIRECTIONS * MOST_DIRECTIONS };
  double sums[2][2] = {{0}};
  for (int n = 0; n < with->count; ++n) {
    const int *samples = with->pages[n].samples;
    double light[2][2][MOST] = {{{0}}}; /* without, with; by direction, by position */
    sum_marginals(&without->pages[n], light[0][0], light[0][1]);
    sum_marginals(&with->pages[n], light[1][0], light[1][1]);
    for (int k = 0; k < 2; ++k)
      add_squares(light[0][k], light[1][k], (size_t)samples[2 - 2 * k] * (size_t)samples[3 - 2 * k],
                  sums[k]);
  }
  change->rms = sqrt(fmax(ratio(sums[0][0], sums[0][1]), ratio(sums[1][0], sums[1][1])));
}

static bool matters(const struct probe_change *change, double threshold) {
  return fabs(change->flux) > threshold || change->rms > 2 * threshold;
}

static bool is_expensive(enum effect effect) {
  return effect == INTERREFLECTION || effect == EXTENDED_SOURCE;
}

/* Without caustics all light that meets a target goes on straight: that loses less than photons
 * that are never shot. */
static void warn_of_photons(const struct probe_bake *with, struct warnings *warnings) {
  warnings_add(warnings, "goes without caustics: with them %s; " BAKE_PHOTONS_ADVICE,
               with->photons_lost);
}

/* Bakes with `less` and with `more`, both at once, and compares them. */
static enum result compare(const struct bake_work *work, const struct effects *less,
                           const struct effects *more, int directions, struct probe_change *change,
                           double *deviation, int *depth, struct bake_report *report,
                           struct error *error) {
  const int samples[SLAB_AXES] = {POSITIONS, POSITIONS, directions, directions};
  const struct slab *slabs = work->lamp->slabs;
  struct probe_bake without = {0}, with = {0};
  enum result result = probe_bake_start(work, slabs, less, samples, 1, &without, error);
  if (result == RESULT_OK) result = probe_bake_start(work, slabs, more, samples, 1, &with, error);
  if (result == RESULT_OK) result = probe_bake_wait(&without, report, error);
  if (result == RESULT_OK) result = probe_bake_wait(&with, report, error);
  if (result == RESULT_OK) {
    *deviation = compare_flux(&without, &with, change);
    compare_rms(&without, &with, change);
    change->rays = ratio(with.traced, without.traced);
    *depth = with.depth;
  }
  if (with.photons_lost[0]) {
    warn_of_photons(&with, &report->warnings);
    *change = (struct probe_change){.rays = 1};
    *deviation = 0;
  }
  probe_bake_free(&without);
  probe_bake_free(&with);
  return result;
}

/* What an effect, a step further in `more` than in `less`, changes, and the trace level that rays
 * reach with `more`. Photons that are lost change nothing, and a warning tells of them; where no
 * Canned_Bulb can be extended, nothing is baked. */
static enum result measure(const struct bake_work *work, enum effect effect,
                           const struct effects *less, const struct effects *more,
                           struct probe_change *change, int *depth, struct bake_report *report,
                           struct error *error) {
  enum result result = RESULT_OK;
  bool certain = effect == EXTENDED_SOURCE && !work->lamp->bulbs;
  *change = (struct probe_change){.rays = 1};
  for (int n = is_expensive(effect) ? SPARSE : DENSE;
       n <= MOST_DIRECTIONS && !certain && result == RESULT_OK; n *= 2) {
    double deviation = 0;
    result = compare(work, less, more, n, change, &deviation, depth, report, error);
    certain = fabs(fabs(change->flux) - work->options->effect_threshold) > 2 * deviation;
  }
  return result;
}

/* ---- 1. and 4. All effects ---- */

static void say(const struct probe_effect *found, int setting, enum effect effect,
                char line[PROBE_LINE]) {
  static const char *const units[EFFECTS] = {[INTERREFLECTION] = "bounces",
                                             [CAUSTICS] = "photons",
                                             [EXTENDED_SOURCE] = "lights a side",
                                             [DEEP_TRACE] = "levels"};
  int used = snprintf(line, PROBE_LINE, "%s: flux %+.2g %%, %.2g %% RMS, rays x %.2g",
                      setting ? "on" : "off", 100 * found->first.flux, 100 * found->first.rms,
                      found->first.rays);
  if (setting && used > 0 && used < PROBE_LINE)
    used += snprintf(line + used, (size_t)(PROBE_LINE - used), "; %d %s", setting, units[effect]);
  if (setting && found->tried && used > 0 && used < PROBE_LINE)
    snprintf(line + used, (size_t)(PROBE_LINE - used), ", %s %.2g %%, %.2g %% RMS",
             !found->converged    ? "not converged, the last change was"
             : effect == CAUSTICS ? "twice as many would change"
                                  : "more would change",
             100 * found->next.flux, 100 * found->next.rms);
}

/* What the next setting changes. */
static void note_next(struct probe_effect *found, const struct probe_change *change,
                      bool converged) {
  found->next = *change;
  found->tried = true;
  found->converged = converged;
}

/* Tries one effect on top of `effects`, and leaves it there as far as it matters. Where rays
 * still end at the trace level, more levels may matter though this step did not. */
static enum result try_effect(const struct bake_work *work, enum effect effect,
                              struct effects *effects, struct probe_effect *found,
                              struct bake_report *report, struct error *error) {
  enum result result = RESULT_OK;
  bool go_on = true;
  for (const int *step = effect_ladder(effect); *step && go_on && result == RESULT_OK; ++step) {
    struct effects more = *effects;
    struct probe_change change = {0};
    int depth = 0;
    more.setting[effect] = *step;
    result = measure(work, effect, effects, &more, &change, &depth, report, error);
    bool good = matters(&change, work->options->effect_threshold);
    if (effects->setting[effect]) {
      note_next(found, &change, !good);
    } else {
      found->first = change;
    }
    go_on = good || (effect == DEEP_TRACE && depth >= *step);
    if (good) *effects = more;
  }
  if (effects->setting[effect] && effect == CAUSTICS && result == RESULT_OK) {
    struct effects more = *effects;
    struct probe_change change = {0};
    int depth = 0;
    more.setting[effect] *= 2;
    result = measure(work, effect, effects, &more, &change, &depth, report, error);
    note_next(found, &change, !matters(&change, work->options->effect_threshold));
  }
  if (result == RESULT_OK && found->tried && !found->converged) {
    char line[PROBE_LINE];
    say(found, effects->setting[effect], effect, line);
    warnings_add(&report->warnings, "%s %s; name a greater setting in --effects",
                 effect_word(effect), line);
  }
  return result;
}

enum result probe_effects(const struct bake_work *work, struct effects *effects,
                          struct probe *probe, struct bake_report *report, struct error *error) {
  static const enum effect order[EFFECTS] = {DEEP_TRACE, CAUSTICS, EXTENDED_SOURCE,
                                             INTERREFLECTION};
  enum result result = RESULT_OK;
  *effects = (struct effects){0};
  *probe = (struct probe){0};
  for (int k = 0; k < EFFECTS && result == RESULT_OK; ++k)
    result = try_effect(work, order[k], effects, &probe->effects[order[k]], report, error);
  return result;
}

enum result probe_photons(const struct bake_work *work, struct effects *effects,
                          struct bake_report *report, struct error *error) {
  struct effects cheap = *effects;
  struct probe_bake bake = {0};
  const int samples[SLAB_AXES] = {1, 1, SPARSE, SPARSE};
  cheap.setting[INTERREFLECTION] = 0;
  if (!effects->setting[CAUSTICS]) return RESULT_OK;
  enum result result =
      probe_bake(work, work->lamp->slabs, &cheap, samples, 1, &bake, report, error);
  if (bake.photons_lost[0]) {
    warn_of_photons(&bake, &report->warnings);
    effects->setting[CAUSTICS] = 0;
  }
  probe_bake_free(&bake);
  return result;
}

void probe_say(const struct probe *probe, const struct effects *effects, enum effect effect,
               char line[PROBE_LINE]) {
  say(&probe->effects[effect], effects->setting[effect], effect, line);
}
