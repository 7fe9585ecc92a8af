/* stats.c - see stats.h. */
#include "cmd/stats.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "base/progress.h"
#include "file/slab_json.h"
#include "slab/slab_accuracy.h"

void stats_phase(struct stats *stats, const char *name) {
  double time = progress_now();
  if (stats->start > 0) stats->phases[stats->phase_count - 1].seconds += time - stats->start;
  stats->start = name ? time : 0;
  if (name && stats->phase_count < STATS_PHASES)
    stats->phases[stats->phase_count++] = (struct stats_phase){name, 0};
}

void stats_effect(struct stats *stats, const char *name, bool simulated, const char *format, ...) {
  if (stats->effect_count == STATS_EFFECTS) return;
  struct stats_effect *effect = &stats->effects[stats->effect_count++];
  *effect = (struct stats_effect){.name = name, .simulated = simulated};
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(effect->reason, sizeof effect->reason, format, arguments);
  va_end(arguments);
}

void stats_add_counts(struct gather_counts *sum, const struct gather_counts *counts) {
  sum->receivers += counts->receivers;
  sum->microlights += counts->microlights;
  sum->nodes += counts->nodes;
  sum->black += counts->black;
  sum->shadow_rays += counts->shadow_rays;
  sum->open_views += counts->open_views;
  sum->pages_behind += counts->pages_behind;
  sum->error = fmax(sum->error, counts->error);
}

static json_t *seconds_of(const struct stats *stats) {
  json_t *seconds = json_object();
  double total = 0;
  for (int k = 0; k < stats->phase_count; ++k) {
    json_object_set_new(seconds, stats->phases[k].name, json_real(stats->phases[k].seconds));
    total += stats->phases[k].seconds;
  }
  json_object_set_new(seconds, "total", json_real(total));
  return seconds;
}

static json_t *effects_of(const struct stats *stats) {
  json_t *effects = json_object();
  for (int k = 0; k < stats->effect_count; ++k) {
    const struct stats_effect *effect = &stats->effects[k];
    json_object_set_new(
        effects, effect->name,
        json_pack("{s:b, s:s}", "simulated", effect->simulated, "reason", effect->reason));
  }
  return effects;
}

/* A command line may hold any bytes; JSON only UTF-8. */
static json_t *text_of(const char *text) {
  json_t *value = json_string(text);
  char *plain = value ? NULL : strdup(text);
  for (char *c = plain; c && *c; ++c)
    if ((unsigned char)*c >= 0x80) *c = '?';
  if (plain) value = json_string(plain);
  free(plain);
  return value;
}

static json_t *object_of(const struct stats *stats) {
  const struct gather_counts *counts = &stats->counts;
  double error = isfinite(counts->error) ? counts->error : -1;
  json_t *object = json_object();
  json_object_set_new(object, "command", text_of(stats->command));
  json_object_set_new(object, "method", json_string(stats->method));
  json_object_set_new(object, "tolerance", json_real(stats->tolerance));
  json_object_set_new(object, "threads", json_integer(stats->threads));
  json_object_set_new(object, "seconds", seconds_of(stats));
  json_object_set_new(object, "receivers", json_integer((json_int_t)counts->receivers));
  json_object_set_new(object, "microlights", json_integer((json_int_t)counts->microlights));
  json_object_set_new(object, "nodes", json_integer((json_int_t)counts->nodes));
  json_object_set_new(object, "black_microlights", json_integer((json_int_t)counts->black));
  json_object_set_new(object, "shadow_rays", json_integer((json_int_t)counts->shadow_rays));
  json_object_set_new(object, "open_views", json_integer((json_int_t)counts->open_views));
  json_object_set_new(object, "pages_behind", json_integer((json_int_t)counts->pages_behind));
  json_object_set_new(object, "effects", effects_of(stats));
  json_object_set_new(object, "error_estimate", error < 0 ? json_null() : json_real(error));
  return object;
}

/* Appends what a page errs by itself. */
static enum result add_floors(json_t *list, const struct light *light, int page,
                              struct error *error) {
  const struct slab *slab = &light->pages[page].slab;
  double distances[SLAB_ACCURACY_DISTANCES];
  struct slab_accuracy floors[SLAB_ACCURACY_DISTANCES];
  for (int k = 0; k < SLAB_ACCURACY_DISTANCES; ++k)
    distances[k] = slab_accuracy_apertures[k] * slab_aperture(slab);
  enum result result =
      slab_accuracy_estimate(slab, SLAB_ACCURACY_DISTANCES, distances, floors, error);
  for (int k = 0; k < SLAB_ACCURACY_DISTANCES && result == RESULT_OK; ++k) {
    json_t *about = isfinite(floors[k].all) ? json_real(floors[k].all) : json_null();
    json_array_append_new(list, json_pack("{s:o, s:i, s:f, s:o}", "light", text_of(light->path),
                                          "page", page + 1, "apertures", slab_accuracy_apertures[k],
                                          "about", about));
  }
  return result;
}

static enum result set_floors(json_t *object, const struct light *lights, int count,
                              struct error *error) {
  enum result result = RESULT_OK;
  json_t *list = json_array();
  for (int l = 0; l < count; ++l)
    for (int page = 0; page < lights[l].count && result == RESULT_OK; ++page)
      result = add_floors(list, &lights[l], page, error);
  json_object_set_new(object, "slab_errors", list);
  return result;
}

enum result stats_write(struct stats *stats, const struct light *lights, int count,
                        const char *path, struct error *error) {
  stats_phase(stats, NULL);
  struct output output = {0};
  unsigned long lost = slab_json_lost();
  json_t *object = object_of(stats);
  enum result result = set_floors(object, lights, count, error);
  char *text = json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(6));
  size_t length = text ? strlen(text) : 0;
  if (result == RESULT_OK && (!text || slab_json_lost() != lost))
    result = result_fail(error, RESULT_MEMORY, "%s: out of memory", path);
  if (result == RESULT_OK) {
    text[length] = '\n'; /* in place of the final zero */
    result = output_begin(&output, path, error);
  }
  if (result == RESULT_OK && output_write(&output, text, length + 1, 0) != 0)
    result = result_fail(error, RESULT_IO, "%s: cannot be written: %s", path, strerror(errno));
  if (result == RESULT_OK) result = output_commit(&output, error);
  output_abandon(&output);
  free(text);
  json_decref(object);
  return result;
}
