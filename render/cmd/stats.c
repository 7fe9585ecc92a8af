#include "cmd/stats.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/output.h"
#include "base/progress.h"
#include "cli/cli.h"
#include "file/json_text.h"
#include "file/slab_json.h"

struct stats stats_start(const struct options *options) {
  struct stats stats = {.command = cli_command_line(),
                        .method = gather_methods[options->method].name,
                        .tolerance = options->tolerance,
                        .threads = options->threads};
  stats_phase(&stats, "load");
  return stats;
}

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

static json_t *object_of(const struct stats *stats) {
  const struct gather_counts *counts = &stats->counts;
  double error = isfinite(counts->error) ? counts->error : -1;
  json_t *object = json_object();
  json_object_set_new(object, "command", json_any_string(stats->command));
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
static enum result add_accuracy(json_t *list, const struct light *light, int page,
                                struct error *error) {
  const struct slab *slab = &light->pages[page].slab;
  struct slab_sampling sampling;
  struct slab_accuracy accuracy[SLAB_ACCURACY_DISTANCES];
  enum result result = slab_json_sampling(slab, &sampling, error);
  if (result == RESULT_OK) result = slab_accuracy_table(slab, &sampling, accuracy, error);
  for (int k = 0; k < SLAB_ACCURACY_DISTANCES && result == RESULT_OK; ++k) {
    json_t *about = isfinite(accuracy[k].all) ? json_real(accuracy[k].all) : json_null();
    json_array_append_new(list, json_pack("{s:o, s:i, s:f, s:o}", "light",
                                          json_any_string(light->path), "page", page + 1,
                                          "apertures", slab_accuracy_apertures[k], "about", about));
  }
  return result;
}

static enum result set_accuracy(json_t *object, const struct light *lights, int count,
                                struct error *error) {
  enum result result = RESULT_OK;
  json_t *list = json_array();
  for (int l = 0; l < count; ++l)
    for (int page = 0; page < lights[l].count && result == RESULT_OK; ++page)
      result = add_accuracy(list, &lights[l], page, error);
  json_object_set_new(object, "slab_errors", list);
  return result;
}

enum result stats_write(struct stats *stats, const struct light *lights, int count,
                        const char *path, struct error *error) {
  if (!path) return RESULT_OK;
  stats_phase(stats, NULL);
  unsigned long mark = json_mark();
  json_t *object = object_of(stats);
  enum result result = set_accuracy(object, lights, count, error);
  char *text = NULL;
  if (result == RESULT_OK)
    result = json_text(object, mark, JSON_INDENT(2) | JSON_REAL_PRECISION(6), &text, error);
  if (result == RESULT_OK) {
    size_t length = strlen(text);
    text[length] = '\n'; /* in place of the final zero */
    result = output_text(path, text, length + 1, error);
  }
  free(text);
  json_decref(object);
  return result;
}
