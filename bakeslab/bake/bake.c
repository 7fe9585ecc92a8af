/* bake.c - from a lamp script to a slab.
 *
 * 1. A trial run of the script (lamp.h) finds the slabs that it declares, the effects that it
 *    needs, the files that it reads, how bright the lamp is, and which cameras work.
 * 2. Small bakes (probe.h) decide what neither the user nor the script does: effects, windows, the
 *    number of samples.
 * 3. Where the script has channels (bake_channels.h), the pages are there once for each: its bulbs
 *    alone light them.
 * 4. Rounds of batches (bake_rounds.h): each sample is the mean of the radiance over its 4D cell,
 *    by pairs of antithetic rays (Hammersley and Morton 1956) on a Sobol sequence (Joe and Kuo
 *    2008), as many as the tile's noise calls for (Neyman 1934).
 * 5. Samples are the sums over their rays; what they say of the slab, the balance of its light
 *    and its own error, goes into the report.
 * 6. Write the slab, with its provenance and the lamp's housing, and drop the store. Of several
 *    processes that bake the same, one does steps 5 and 6.
 *
 * The slab is that of Heidrich, Kautz, Slusallek and Seidel, "Canned Lightsources", 1998, section
 * 3. J. M. Hammersley and K. W. Morton, "A new Monte Carlo technique: antithetic variates",
 * Mathematical Proceedings of the Cambridge Philosophical Society 52, 1956; the others are cited
 * where they are used. */
#include "bake/bake.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bake/bake_channels.h"
#include "bake/bake_estimate.h"
#include "bake/bake_housing.h"
#include "bake/bake_provenance.h"
#include "bake/bake_warnings.h"
#include "base/files.h"
#include "base/sdl.h"
#include "batch/bake_claim.h"
#include "batch/bake_ledger.h"
#include "batch/bake_rounds.h"
#include "file/slab_file.h"
#include "file/slab_json.h"
#include "lamp/housing.h"
#include "lamp/lamp_depend.h"
#include "povray/sandbox.h"
#include "probe/probe_resolution.h"
#include "probe/probe_window.h"
#include "slab/slab_accuracy.h"

struct bake_state {
  struct povray povray;
  struct lamp_source source;
  struct lamp lamp;
  struct slab *pages; /* the slab's: of each channel those that the lamp declares; owned */
  int page_count;
  struct bake_store store;
  struct bake_rounds rounds;
  struct bake_energy_bakes energy;
  struct effects effects;
  struct bake_origin origin;
};

/* ---- 1. The trial run ---- */

/* A power of two that keeps the picture well inside half float's range. The trial run shoots a few
 * thousand rays only, so room is left above the peak that it saw. */
static double choose_gain(const struct bake_options *options, double peak) {
  int exponent;
  if (options->gain > 0) return options->gain;
  if (isinf(peak)) return 0x1p-16;
  frexp(peak, &exponent); /* peak < 2^exponent */
  if (exponent > 13) return ldexp(1, 13 - exponent);
  if (peak > 0 && exponent < -3) return ldexp(1, -exponent);
  return 1;
}

/* A process costs about as much as 16384 mesh cameras or three frames: with far fewer directions
 * than positions, one image a direction is cheaper. */
static enum result choose_form(const struct bake_options *options, const struct lamp *lamp,
                               enum bake_form *form, struct error *error) {
  bool infinite = true;
  for (int n = 0; n < lamp->slab_count; ++n) infinite &= isinf(lamp->slabs[n].st_distance) != 0;
  if (options->form >= 0) {
    *form = (enum bake_form)options->form;
    if (*form == BAKE_TRANSPOSED && !infinite)
      return result_fail(error, RESULT_BAD,
                         "--camera transposed: needs st planes at infinity, since a camera on a "
                         "finite one would see what stands in front of the lamp");
    if (*form == BAKE_MESH && !lamp->mesh_camera)
      return result_fail(error, RESULT_BAD,
                         "--camera mesh: this POV-Ray's mesh_camera does not show the faces in "
                         "order; use --camera perspective");
    return RESULT_OK;
  }
  const int *samples = lamp->slabs[0].samples;
  double positions = (double)samples[SLAB_U] * samples[SLAB_V],
         directions = (double)samples[SLAB_S] * samples[SLAB_T];
  *form = infinite && positions > 4096 * directions ? BAKE_TRANSPOSED
          : lamp->mesh_camera                       ? BAKE_MESH
                                                    : BAKE_PERSPECTIVE;
  return RESULT_OK;
}

/* Runs the script with these effects, or those of its Canned_Needs (NULL), and takes from it what
 * the cameras depend on. */
static enum result try_lamp(struct bake_work *work, struct bake_state *state,
                            const struct effects *effects, struct error *error) {
  const struct bake_options *options = work->options;
  char *scratch;
  lamp_free(&state->lamp);
  enum result result = bake_store_scratch(&state->store, NULL, &scratch, error);
  if (result == RESULT_OK)
    result = lamp_try(&state->povray, &state->source, scratch, effects, NULL, work->stop,
                      &state->lamp, error);
  free(scratch);
  for (int n = 0; n < state->lamp.slab_count && result == RESULT_OK; ++n) {
    int *samples = state->lamp.slabs[n].samples;
    memcpy(samples, (int[]){options->uv[0], options->uv[1], options->st[0], options->st[1]},
           SLAB_AXES * sizeof *samples);
    result = slab_check(&state->lamp.slabs[n], error);
  }
  if (result == RESULT_OK) result = choose_form(options, &state->lamp, &work->look.form, error);
  if (result != RESULT_OK) return result;
  work->slabs = state->lamp.slabs;
  work->look.defect_rows = state->lamp.defect_rows;
  work->look.gain = choose_gain(options, state->lamp.peak);
  return RESULT_OK;
}

/* ---- 2. What the bake is to be ---- */

/* Effects are those that the user names, else those of the script's Canned_Needs, else those that
 * small bakes show to matter. What a script does may depend on them: it is run again with them. */
static enum result find_effects(struct bake_work *work, struct bake_state *state,
                                struct bake_report *report, struct error *error) {
  const char *word = work->options->effects;
  bool automatic = !strcmp(word, "auto"), probe = !strcmp(word, "probe");
  enum result result = RESULT_OK;
  if (automatic) result = try_lamp(work, state, NULL, error);
  if (result == RESULT_OK && automatic && state->lamp.needs_declared)
    result = effects_parse(state->lamp.needs, "Canned_Needs", &state->effects, error);
  else if (result == RESULT_OK && !automatic && !probe)
    result = effects_parse(word, "--effects", &state->effects, error);
  else if (result == RESULT_OK) {
    struct effects all;
    state->origin.probed = true;
    result = effects_parse("all", "--effects", &all, error);
    if (result == RESULT_OK) result = try_lamp(work, state, &all, error);
    if (result == RESULT_OK)
      result = probe_effects(work, &state->effects, &state->origin.probe, report, error);
  }
  if (result == RESULT_OK && !state->effects.named && !state->origin.probed) {
    result = try_lamp(work, state, &state->effects, error);
    if (result == RESULT_OK) result = probe_photons(work, &state->effects, report, error);
  }
  bool known = automatic && !state->origin.probed && !effects_any(&state->effects) &&
               state->lamp.all_lights <=
                   state->lamp.bulbs; /* a light for previews may be left out of bakes */
  return result != RESULT_OK || known ? result : try_lamp(work, state, &state->effects, error);
}

static enum result prepare(struct bake_work *work, struct bake_state *state,
                           struct bake_report *report, struct error *error) {
  const struct bake_options *options = work->options;
  char name[SDL_IDENTIFIER_SIZE];
  enum result result = find_effects(work, state, report, error);
  if (result == RESULT_OK) /* an include bears it */
    result = result_at(sdl_capitalise(work->slabs[0].name, name, error), error, "%s: Canned_Lamp",
                       options->lamp);
  if (result == RESULT_OK) result = bake_warn_of_lamp(work, &state->lamp, &report->warnings, error);
  if (result == RESULT_OK && options->depend)
    result = lamp_depend(&state->lamp.reads, state->source.path, options->output, options->depend,
                         !options->dry_run, error);
  if (result == RESULT_OK && probe_window_pays(work))
    result = probe_window(work, state->lamp.slabs, &state->origin.window, report, error);
  if (result == RESULT_OK && options->tolerance > 0)
    result = probe_resolution(work, state->lamp.slabs, &state->origin.resolution, report, error);
  if (result == RESULT_OK) result = choose_form(options, &state->lamp, &work->look.form, error);
  work->look.offsets = options->centre ? BAKE_CENTRE : options->uniform ? BAKE_SHARED : BAKE_OWN;
  return result;
}

/* The same work with the pages of all channels. The lamp as a whole is what small bakes look at,
 * before and after. */
static enum result part_channels(const struct bake_work *work, struct bake_state *state,
                                 struct lamp *lit, struct bake_work *channels,
                                 struct error *error) {
  enum result result = bake_channels_pages(&state->lamp, &state->pages, &state->page_count, error);
  *lit = state->lamp;
  lit->slabs = state->pages;
  lit->slab_count = state->page_count;
  *channels = *work;
  channels->lamp = lit;
  channels->slabs = state->pages;
  return result;
}

/* What it is going to cost: only for people who wait for it. */
static enum result announce(const struct bake_work *work, const struct bake_state *state,
                            struct bake_report *report, struct error *error) {
  const struct bake_options *options = work->options;
  const char *why =
      options->tolerance > 0 ? state->origin.resolution.line : "as asked for or usual";
  char line[BAKE_ESTIMATE_LINE];
  struct bake_estimate estimate;
  if (!options->tell_plan) return RESULT_OK;
  enum result result = bake_estimate(work, &estimate, report, error);
  if (result != RESULT_OK) return result;
  bake_estimate_say(work, &estimate, why, line);
  options->tell_plan(line);
  if (estimate.seconds > 3600 && options->ask && !options->dry_run)
    return result_fail(error, RESULT_BAD,
                       "%s: the bake may take more than an hour; say --yes to begin it",
                       options->lamp);
  return RESULT_OK;
}

/* ---- 5. What the samples say ---- */

/* A flux that is known less well is told, relative standard error. */
static const double most_flux_noise = 0.05;

static void warn_of_noise(const struct bake_noise *noise, struct warnings *warnings) {
  if (!(noise->flux > most_flux_noise)) return;
  warnings_add(warnings,
               "the slab's flux is known to %.0f %% only (standard error; few rays find the light "
               "of a small source): %.3g times as many --rays would make that %.2g %%, and so may "
               "narrower windows",
               100 * noise->flux, ceil(pow(noise->flux / most_flux_noise, 2)),
               100 * most_flux_noise);
}

/* Small bakes chose the resolution; the slab itself may show that it is not enough, or none was. */
static void warn_of_resolution(const struct bake_options *options, const struct bake_report *report,
                               const struct slab *page, struct warnings *warnings) {
  static const double certainty = 1.5; /* of both estimates */
  double excess = report->error / options->tolerance;
  if (options->tolerance == 0 || !(excess > certainty)) return;
  warnings_add(
      warnings,
      "the slab's own error is about %.2g, not the tolerance of %g: with %d positions and "
      "%d directions a side that is its floor; --uv %.0f --st %.0f may reach the tolerance",
      report->error, options->tolerance, page->samples[SLAB_U], page->samples[SLAB_S],
      ceil(page->samples[SLAB_U] * sqrt(excess)), ceil(page->samples[SLAB_S] * excess));
}

static enum result assess(const struct bake_work *work, struct bake_state *state,
                          struct bake_report *report, struct error *error) {
  const struct slab *pages = state->pages;
  enum result result =
      bake_warn_of_darkness(work, pages, state->page_count, &report->warnings, error);
  warn_of_noise(&state->origin.noise, &report->warnings);
  if (report->photons_lost[0])
    warnings_add(&report->warnings, "light that meets glass is lost: %s; " BAKE_PHOTONS_ADVICE,
                 report->photons_lost);
  for (int n = 0; n < state->page_count && result == RESULT_OK; ++n) {
    struct slab_sampling sampling;
    struct slab_accuracy accuracy = {0};
    result = slab_json_sampling(&pages[n], &sampling, error);
    if (result == RESULT_OK && work->options->tolerance > 0)
      result = slab_accuracy_estimate(&pages[n], &sampling, 1, &state->origin.resolution.distance,
                                      &accuracy, error);
    if (!(accuracy.all <= report->error)) report->error = accuracy.all;
  }
  warn_of_resolution(work->options, report, &pages[0], &report->warnings);
  if (result == RESULT_OK)
    result = bake_energy(work, pages, state->page_count, &state->origin.noise, &state->energy,
                         &state->origin.energy, report, error);
  return result;
}

/* ---- 6. The slab ---- */

/* Writes into the pages how they were baked. */
static enum result record(const struct bake_work *work, const struct bake_state *state,
                          const struct bake_report *report, struct error *error) {
  char *text = NULL;
  enum result result = bake_provenance(work, &state->origin, &report->warnings, &text, error);
  for (int n = 0; n < state->page_count && result == RESULT_OK; ++n)
    result = slab_json_set(&state->pages[n], "provenance", text, error);
  free(text);
  return result;
}

/* With --strict, warnings end the bake. */
static enum result be_strict(const struct bake_work *work, const struct bake_report *report,
                             struct error *error) {
  int count = report->warnings.count;
  if (!work->options->strict || count == 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD,
                     "%s: %d warning%s, which --strict takes for a failure: no slab is written",
                     work->source->script, count, count == 1 ? "" : "s");
}

static enum result write_slab(const struct bake_work *work, struct bake_state *state,
                              struct bake_report *report, struct error *error) {
  const struct bake_options *options = work->options;
  struct slab *pages = state->pages;
  int count = state->page_count;
  bake_sum_noise(state->rounds.sum, work->look.gain, work->look.offsets, &state->origin.noise);
  enum result result = bake_sum_finish(state->rounds.sum, work->look.gain, pages, error);
  if (result == RESULT_OK) result = bake_housing(work, report, &state->origin.housing, error);
  for (int n = 0; n < count && result == RESULT_OK; ++n)
    result = slab_json_set(&pages[n], "samples_are",
                           options->centre ? "\"points\"" : "\"cell_means\"", error);
  /* Twice: the assessment reads the noise there, and its warnings go there. */
  if (result == RESULT_OK) result = record(work, state, report, error);
  if (result == RESULT_OK) result = assess(work, state, report, error);
  if (result == RESULT_OK) result = record(work, state, report, error);
  if (result == RESULT_OK) result = be_strict(work, report, error);
  if (result == RESULT_OK)
    result = slab_file_write(options->output, pages, count, options->precision, error);
  return result;
}

/* Makes the store one of this bake, which others may be at work on. */
static enum result join(struct bake_work *work, struct error *error) {
  struct bake_ledger ledger;
  enum result result = bake_ledger_make(work, &ledger, error);
  if (result == RESULT_OK) result = bake_ledger_join(work->store, &ledger, error);
  if (result == RESULT_OK) memcpy(work->plan, ledger.plan, sizeof work->plan);
  return result;
}

/* Steps 4 to 6, unless others have written the slab by now. */
static enum result run(const struct bake_work *work, struct bake_work *channels,
                       struct bake_state *state, struct bake_report *report, struct error *error) {
  const struct bake_options *options = work->options;
  enum result result = join(channels, error);
  report->by_others = result == RESULT_OK && bake_store_is_done(work->store);
  if (result != RESULT_OK || report->by_others) return result;
  if (options->shards == 1) result = bake_energy_start(work, &state->energy, error);
  if (result == RESULT_OK)
    result = bake_rounds_run(channels, BAKE_LEDGER_LAST, &state->rounds, report, error);
  report->assembled = state->rounds.whole;
  report->by_others = result == RESULT_OK && !state->rounds.whole && options->shards == 1;
  report->is_shard = options->shards > 1;
  report->waits = state->rounds.waits;
  report->pilot = state->rounds.number;
  report->more_pilots = state->rounds.grows;
  if (result != RESULT_OK || !report->assembled) return result;
  /* Before the slab: with an old rule, make would take the new slab for up to date. */
  if (options->depend)
    result = lamp_depend(&state->lamp.reads, state->source.path, options->output, options->depend,
                         false, error);
  return result == RESULT_OK ? write_slab(work, state, report, error) : result;
}

/* Refused before it began, it leaves nothing that was not there. */
static enum bake_store_end end_of(const struct bake_state *state, enum result before,
                                  enum result result, const struct bake_report *report) {
  if (before == RESULT_BAD && state->store.fresh) return BAKE_STORE_DROPPED;
  if (result == RESULT_OK && report->assembled) return BAKE_STORE_DONE;
  return result == RESULT_OK && report->is_shard ? BAKE_STORE_SHARD : BAKE_STORE_KEPT;
}

enum result bake(const struct bake_options *options, const volatile sig_atomic_t *stop,
                 struct bake_report *report, struct error *error) {
  struct bake_state state = {.rounds.claim = BAKE_CLAIM_OTHERS};
  *report = (struct bake_report){.warnings.tell = options->warn};
  struct bake_work work = {.options = options,
                           .effort = bake_effort_of(options),
                           .povray = &state.povray,
                           .source = &state.source,
                           .lamp = &state.lamp,
                           .store = &state.store,
                           .look.effects = &state.effects,
                           .stop = stop};
  enum result result = slab_file_check_target(options->output, options->precision, error);
  if (result == RESULT_OK) result = povray_find(options->povray, stop, &state.povray, error);
  state.povray.sandbox = options->sandbox;
  if (result == RESULT_OK && options->sandbox) result = sandbox_check(error);
  if (result == RESULT_OK)
    result = lamp_source_open(options->lamp, options->libraries, &state.source, error);
  if (result == RESULT_OK)
    result = bake_store_open(options->output, options->jobs, &state.store, error);
  if (result == RESULT_OK) result = prepare(&work, &state, report, error);
  if (result == RESULT_OK) result = be_strict(&work, report, error);
  if (result == RESULT_OK) result = bake_refuse_stray_light(&work, error);
  struct bake_work channels = work;
  struct lamp lit;
  if (result == RESULT_OK) result = part_channels(&work, &state, &lit, &channels, error);
  if (result == RESULT_OK) result = announce(&channels, &state, report, error);
  enum result before = result;
  if (result == RESULT_OK && !options->dry_run)
    result = run(&work, &channels, &state, report, error);
  bake_energy_free(&state.energy);
  report->highlights = state.lamp.reads.highlights;
  enum bake_store_end end = end_of(&state, before, result, report);
  if (end != BAKE_STORE_DONE && state.rounds.claim != BAKE_CLAIM_OTHERS)
    bake_claim_leave(state.store.worker, channels.plan, state.rounds.claim);
  bake_store_close(&state.store, end);
  bake_rounds_free(&state.rounds);
  free(state.origin.housing);
  slab_file_free_all(state.pages, state.page_count);
  lamp_free(&state.lamp);
  lamp_source_free(&state.source);
  return result;
}
