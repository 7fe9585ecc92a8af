/* bake.c - see bake.h. */
#include "bake.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bake_run.h"
#include "bake_sum.h"
#include "effects.h"
#include "files.h"
#include "housing.h"
#include "lamp_depend.h"
#include "slab_cli.h"
#include "slab_json.h"

/* Passes everywhere before tiles are told apart: with fewer, a pilot misses light. */
enum { PILOT = 4 };

struct bake_state {
  struct povray povray;
  struct lamp_source source;
  struct lamp lamp;
  struct bake_store store;
  struct bake_tiles tiles;
  struct bake_round pilot, rest;
  struct bake_sum *sum;
  struct effects effects;
};

/* A power of two that keeps the picture well inside half float's range. The probe
 * sees a few thousand rays only, so there is room above what it saw. */
static double choose_gain(const struct bake_options *options, double peak) {
  int exponent;
  if (options->gain > 0) return options->gain;
  if (isinf(peak)) return 0x1p-16;
  frexp(peak, &exponent); /* peak < 2^exponent */
  if (exponent > 13) return ldexp(1, 13 - exponent);
  if (peak > 0 && exponent < -3) return ldexp(1, -exponent);
  return 1;
}

/* The probe rendered as a mesh_camera says whether that works. A process costs about as
 * much as 16384 meshes or three frames: with far fewer directions than positions, one
 * image a direction is cheaper. */
static enum slab_result choose_form(const struct bake_options *options, const struct lamp *lamp,
                                    enum bake_form *form, struct slab_error *error) {
  bool infinite = true;
  for (int n = 0; n < lamp->slab_count; ++n) infinite &= isinf(lamp->slabs[n].st_distance) != 0;
  if (options->form >= 0) {
    *form = (enum bake_form)options->form;
    if (*form == BAKE_TRANSPOSED && !infinite)
      return slab_fail(error, SLAB_BAD,
                       "--camera transposed: needs st planes at infinity, since a camera on a "
                       "finite one would see what stands in front of the lamp");
    if (*form == BAKE_MESH && !lamp->mesh_camera)
      return slab_fail(error, SLAB_BAD,
                       "--camera mesh: this POV-Ray's mesh_camera does not show the faces in "
                       "order; use --camera perspective");
    return SLAB_OK;
  }
  double positions = (double)options->uv[0] * options->uv[1],
         directions = (double)options->st[0] * options->st[1];
  if (infinite && (positions > 4096 * directions))
    *form = BAKE_TRANSPOSED;
  else
    *form = lamp->mesh_camera ? BAKE_MESH : BAKE_PERSPECTIVE;
  return SLAB_OK;
}

static bool is_adaptive(const struct bake_options *options) {
  return !options->uniform && options->rays > PILOT;
}

/* Renders and sums. A shard needs the whole pilot's sums to plan by, but renders only its
 * own part of the round after that. */
static enum slab_result do_rounds(const struct bake_work *work, struct bake_state *state,
                                  struct bake_report *report, struct slab_error *error) {
  const struct bake_options *options = work->options;
  bool adaptive = is_adaptive(options);
  int passes = adaptive ? PILOT : options->rays;
  int tiles = bake_tile_count(&state->tiles);
  enum slab_result result =
      bake_sum_new(&state->tiles, adaptive ? options->rays_max : passes, &state->sum, error);
  if (!result)
    result = bake_plan_pilot(&state->tiles, passes, work->look.form, &state->pilot, error);
  bool shard = options->shards > 1;
  if (!result)
    result = bake_run(work, &state->pilot, adaptive || !shard ? state->sum : NULL,
                      adaptive ? "pilot" : "bake", report, error);
  if (result || !adaptive) return result;
  double *deviation = malloc((size_t)tiles * sizeof *deviation);
  int *wanted = malloc((size_t)tiles * sizeof *wanted);
  if (!deviation || !wanted) result = slab_fail(error, SLAB_MEMORY, "out of memory");
  if (!result) result = bake_sum_deviation(state->sum, deviation, error);
  if (!result)
    result = bake_plan_allocate(&state->tiles, deviation, PILOT, options->rays, options->rays_max,
                                wanted, error);
  if (!result)
    result = bake_plan_rest(&state->tiles, wanted, PILOT, work->look.form, &state->rest, error);
  free(deviation);
  free(wanted);
  if (!result)
    result = bake_run(work, &state->rest, shard ? NULL : state->sum, "bake", report, error);
  return result;
}

/* ---- The slab ---- */

static json_t *effects_json(const struct effects *effects, bool own_radiosity) {
  json_t *object = json_object();
  for (const char *at = effects_all; *(at += strspn(at, " "));) {
    char word[32];
    snprintf(word, sizeof word, "%.*s", (int)strcspn(at, " "), at);
    json_object_set_new(object, word, json_string(effects_has(effects, word) ? "on" : "off"));
    at += strlen(word);
  }
  if (own_radiosity) json_object_set_new(object, "interreflection", json_string("by the script"));
  return object;
}

/* File names on the command line may be no UTF-8, which JSON has to be. */
static json_t *command_json(const char *command) {
  json_t *text = json_string(command);
  if (text) return text;
  char *plain = strdup(command);
  for (char *c = plain; c && *c; ++c)
    if (*c < 0) *c = '?';
  text = json_string(plain ? plain : "");
  free(plain);
  return text;
}

/* The lamp's visible housing as SDL, where the script declares one that stands alone. */
static char *find_housing(const struct bake_work *work, struct bake_report *report) {
  char *script = files_read(work->source->folder, strrchr(work->source->path, '/') + 1);
  char *housing = script ? housing_find(script) : NULL;
  char *scratch = NULL;
  if (housing && !bake_store_scratch(work->store, &scratch, NULL) &&
      !housing_parses(work->povray, housing, scratch)) {
    report->housing_left_out = true;
    free(housing);
    housing = NULL;
  }
  free(scratch);
  free(script);
  return housing;
}

static char *provenance_text(const struct bake_work *work, const struct bake_noise *noise,
                             const char *housing) {
  static const char *const forms[] = {"mesh", "perspective", "transposed"};
  json_t *object = json_pack(
      "{s:o, s:s, s:s, s:o, s:s, s:f, s:f}", "command", command_json(work->options->command),
      "tool", "bakeslab " CANNED_VERSION, "renderer", work->povray->version, "effects",
      effects_json(work->look.effects, work->lamp->own_radiosity), "camera", forms[work->look.form],
      "gain", work->look.gain, "rays", noise->rays);
  if (noise->known)
    json_object_set_new(object, "noise",
                        json_pack("{s:f, s:f, s:f}", "sample", noise->sample, "relative_to_mean",
                                  noise->mean != 0 ? noise->sample / noise->mean : 0, "flux",
                                  noise->flux));
  if (housing) json_object_set_new(object, "housing", json_string(housing));
  char *text = json_dumps(object, JSON_COMPACT);
  json_decref(object);
  return text;
}

static enum slab_result write_slab(const struct bake_work *work, struct bake_state *state,
                                   struct bake_report *report, struct slab_error *error) {
  const struct bake_options *options = work->options;
  struct slab *pages = state->lamp.slabs;
  int count = state->lamp.slab_count;
  struct bake_noise noise;
  bake_sum_noise(state->sum, work->look.gain, &noise);
  enum slab_result result = bake_sum_finish(state->sum, work->look.gain, pages, error);
  char *housing = result ? NULL : find_housing(work, report);
  char *text = provenance_text(work, &noise, housing);
  free(housing);
  if (!result && !text) result = slab_fail(error, SLAB_MEMORY, "out of memory");
  for (int n = 0; n < count && !result; ++n) {
    result = slab_json_set(&pages[n], "provenance", text, error);
    if (!result)
      result = slab_json_set(&pages[n], "samples_are",
                             options->centre ? "\"points\"" : "\"cell_means\"", error);
  }
  free(text);
  return result ? result
                : slab_file_write(options->output, pages, count, options->precision, error);
}

static enum slab_result probe_once(const struct bake_work *work, struct bake_state *state,
                                   const char *effects, struct slab_error *error) {
  char *scratch;
  enum slab_result result = bake_store_scratch(&state->store, &scratch, error);
  if (!result)
    result = lamp_probe(&state->povray, &state->source, scratch, effects, work->stop, &state->lamp,
                        error);
  free(scratch);
  return result;
}

/* Which effects are on: the user's word, else the lamp author's, else all. What a script
 * reads may depend on them, so a probe that finds some called for is made again with these. */
static enum slab_result probe_lamp(const struct bake_work *work, struct bake_state *state,
                                   struct slab_error *error) {
  const struct bake_options *options = work->options;
  bool automatic = !strcmp(options->effects, "auto");
  enum slab_result result = SLAB_OK;
  if (!automatic) result = effects_parse(options->effects, "--effects", &state->effects, error);
  if (!result) result = probe_once(work, state, automatic ? NULL : state->effects.words, error);
  if (!result && automatic)
    result = effects_parse(state->lamp.needs_declared ? state->lamp.needs : "all", "Canned_Needs",
                           &state->effects, error);
  if (!result && automatic && state->effects.words[0]) {
    lamp_free(&state->lamp);
    result = probe_once(work, state, state->effects.words, error);
  }
  for (int n = 0; n < state->lamp.slab_count && !result; ++n) {
    int *samples = state->lamp.slabs[n].samples;
    memcpy(samples, (int[]){options->uv[0], options->uv[1], options->st[0], options->st[1]},
           SLAB_AXES * sizeof *samples);
    result = slab_check(&state->lamp.slabs[n], error);
  }
  return result;
}

enum slab_result bake(const struct bake_options *options, const volatile sig_atomic_t *stop,
                      struct bake_report *report, struct slab_error *error) {
  struct bake_state state = {.store = {.lock = -1}};
  *report = (struct bake_report){0};
  struct bake_work work = {.options = options,
                           .povray = &state.povray,
                           .source = &state.source,
                           .lamp = &state.lamp,
                           .store = &state.store,
                           .stop = stop};
  enum slab_result result = slab_file_check_target(options->output, options->precision, error);
  if (!result) result = povray_find(options->povray, &state.povray, error);
  if (!result) result = lamp_source_open(options->lamp, options->libraries, &state.source, error);
  if (!result) result = bake_store_open(options->output, options->shards > 1, &state.store, error);
  if (!result) result = probe_lamp(&work, &state, error);
  if (!result && options->depend)
    result = lamp_depend_check(&state.lamp.reads, state.source.path, options->output,
                               options->depend, error);
  if (!result) result = choose_form(options, &state.lamp, &work.look.form, error);
  if (!result)
    result = bake_tiles_init(&state.tiles, state.lamp.slabs, state.lamp.slab_count,
                             work.look.form == BAKE_TRANSPOSED, error);
  if (!result) {
    work.slabs = state.lamp.slabs;
    work.look.defect_rows = state.lamp.defect_rows;
    work.look.offsets = options->centre        ? BAKE_CENTRE
                        : is_adaptive(options) ? BAKE_OWN
                                               : BAKE_SHARED;
    work.look.gain = choose_gain(options, state.lamp.peak);
    work.look.effects = &state.effects;
    result = do_rounds(&work, &state, report, error);
  }
  /* A shard leaves the slab to the run without --shard. */
  report->assembled = options->shards == 1;
  /* Before the slab: with an old rule, make would take the new slab for up to date. */
  if (!result && report->assembled && options->depend)
    result = lamp_depend_write(&state.lamp.reads, state.source.path, options->output,
                               options->depend, error);
  if (!result && report->assembled) result = write_slab(&work, &state, report, error);
  bake_store_close(&state.store, !result && report->assembled);
  bake_sum_free(state.sum);
  bake_round_free(&state.pilot);
  bake_round_free(&state.rest);
  bake_tiles_free(&state.tiles);
  lamp_free(&state.lamp);
  lamp_source_free(&state.source);
  return result;
}
