/* ways_lamp.c - the lamp itself in the scene, by POV-Ray: what a slab is to save. Lamps whose bake
 * traced caustics are lit by photons, others by radiosity, as the bake's notes say. Each step
 * spends four times as much, so that its noise halves; they end where one has reached the least
 * error of the ladder, has taken more than all bakes together, or gained nothing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_file.h"
#include "file/slab_json.h"
#include "pov/pov.h"
#include "tradeoff/ways.h"

static const int first_rays = 100, first_photons = 100000;
static const double least_seconds = 20; /* that it may take, however short the bakes */
static const double no_gain = 0.98;     /* of the error before */

/* Is the effect on, in what the bake recorded? */
static bool effect_on(json_t *root, const char *name) {
  json_t *effects = json_object_get(json_object_get(root, "provenance"), "effects");
  const char *state = json_string_value(json_object_get(effects, name));
  return state && strncmp(state, "off", 3) != 0;
}

static enum result effects_of(const struct ways_bake *bake, bool *gather, bool *photons,
                              struct error *error) {
  struct slab *slabs = NULL;
  int count = 0;
  json_t *root = NULL;
  enum result result = slab_file_load_all(bake->slab, &slabs, &count, error);
  if (result == RESULT_OK) result = slab_json_root(&slabs[0], &root, error);
  *gather = effect_on(root, "interreflection");
  *photons = effect_on(root, "caustics") || !*gather;
  json_decref(root);
  slab_file_free_all(slabs, count);
  return result;
}

static enum result draw(const struct ways_settings *settings, struct ways *ways,
                        const struct pov_lamp *lamp, struct picture *picture, double *cpu,
                        struct error *error) {
  char *path = programs_file(&ways->programs, "lamp.pov");
  if (!path) return result_no_memory(error);
  enum result result = pov_write_lamp(path, &settings->view, lamp, error);
  if (result == RESULT_OK)
    result = ways_povray(settings, ways, "lamp.pov", ways->pixels.width, ways->pixels.height,
                         picture, cpu, error);
  free(path);
  return result;
}

static void brighten(const struct ways *ways, struct picture *picture) {
  size_t count = (size_t)picture->width * (size_t)picture->height;
  for (size_t k = 0; k < 3 * count; ++k) picture->rgb[k] *= (float)ways->light.gain[k % 3];
}

static double all_bakes(const struct ways *ways) {
  double sum = 0;
  for (int k = 0; k < ways->bake_count; ++k) sum += ways->bakes[k].cpu;
  return sum;
}

/* Compared where the lamp itself does not hide the mesh. */
static enum result climb(const struct ways_settings *settings, struct ways *ways,
                         const struct pixels *seen, struct pov_lamp *lamp, struct error *error) {
  double dearest = fmax(all_bakes(ways), least_seconds), spent = 0;
  double enough = settings->errors[settings->error_count - 1];
  enum result result = RESULT_OK;
  for (int k = 0; k < WAYS_WHOLE && result == RESULT_OK && spent < dearest; ++k) {
    struct ways_lamp *made = &ways->lamp[k];
    struct picture picture = {0};
    if (settings->progress)
      settings->progress(settings->progress_context, 0.9 + 0.02 * k, "the whole lamp in POV-Ray");
    result = draw(settings, ways, lamp, &picture, &made->cpu, error);
    if (result != RESULT_OK) break;
    brighten(ways, &picture);
    made->rays = lamp->gather ? lamp->gather : lamp->photons / 1000;
    made->error = pixels_error(seen, &picture, ways->truth);
    picture_free(&picture);
    ways->lamp_count = k + 1;
    spent = made->cpu;
    if (made->error <= enough || (k > 0 && made->error > no_gain * made[-1].error)) break;
    lamp->gather *= 4;
    lamp->photons *= 4;
  }
  return result;
}

static enum result climb_seen(const struct ways_settings *settings, struct ways *ways,
                              const struct picture *marked, struct pov_lamp *lamp,
                              struct error *error) {
  struct pixels seen = ways->pixels;
  size_t count = (size_t)seen.width * (size_t)seen.height;
  seen.compared = malloc(count * sizeof *seen.compared);
  if (!seen.compared) return result_no_memory(error);
  memcpy(seen.compared, ways->pixels.compared, count * sizeof *seen.compared);
  pixels_keep_marked(&seen, marked);
  enum result result = climb(settings, ways, &seen, lamp, error);
  free(seen.compared);
  return result;
}

enum result ways_lamp_all(const struct ways_settings *settings, struct ways *ways,
                          struct error *error) {
  struct pov_lamp lamp = {.script = settings->lamp, .light = &ways->light, .mark = true};
  struct picture marked = {0};
  struct error reason;
  bool gather, photons;
  double unpaid = 0;
  if (!settings->script) return RESULT_OK;
  enum result result = effects_of(&ways->bakes[ways->bake_count - 1], &gather, &photons, error);
  if (result != RESULT_OK) return result;
  ways->lamp_photons = !gather;
  lamp.gather = gather ? first_rays : 0;
  lamp.photons = photons ? first_photons : 0;
  result = draw(settings, ways, &lamp, &marked, &unpaid, &reason);
  lamp.mark = false;
  if (result == RESULT_OK) result = climb_seen(settings, ways, &marked, &lamp, &reason);
  picture_free(&marked);
  if (result == RESULT_OK) return RESULT_OK;
  if (result != RESULT_IO) return result_fail(error, result, "%s", reason.text);
  snprintf(ways->lamp_refusal, sizeof ways->lamp_refusal, "%.255s", reason.text);
  return RESULT_OK;
}
