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
#include "file/slab_source.h"

struct stats stats_start(void) {
  struct stats stats = {.mark = json_mark()};
  stats.seconds = json_object();
  stats.effects = json_object();
  stats_phase(&stats, "load");
  return stats;
}

void stats_phase(struct stats *stats, const char *name) {
  double time = progress_now(), seconds = time - stats->start;
  if (stats->phase) {
    json_object_set_new(stats->seconds, stats->phase, json_real(seconds));
    stats->total += seconds;
  }
  stats->phase = name;
  stats->start = time;
}

void stats_effect(struct stats *stats, const char *name, bool simulated, const char *format, ...) {
  char reason[160];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(reason, sizeof reason, format, arguments);
  va_end(arguments);
  json_object_set_new(stats->effects, name,
                      json_pack("{s:b, s:s}", "simulated", simulated, "reason", reason));
}

static json_t *number(double x) {
  return isfinite(x) ? json_real(x) : json_null();
}

void stats_error(struct stats *stats, const struct image_error *told) {
  json_decref(stats->error);
  stats->error =
      json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "noise", number(told->noise), "resolution",
                number(told->resolution), "logluv", number(told->logluv), "sum", number(told->sum),
                "shadows", number(told->shadows), "all", number(told->all));
}

static json_t *object_of(const struct stats *stats, const struct options *options) {
  const struct gather_counts *counts = &stats->counts;
  json_t *object = json_object();
  json_object_set_new(object, "command", json_any_string(cli_command_line()));
  json_object_set_new(object, "method", json_string(gather_methods[options->method].name));
  json_object_set_new(object, "tolerance", json_real(options->tolerance));
  json_object_set_new(object, "threads", json_integer(options->threads));
  json_object_set(object, "seconds", stats->seconds);
  json_object_set_new(object, "receivers", json_integer((json_int_t)counts->receivers));
  json_object_set_new(object, "microlights", json_integer((json_int_t)counts->microlights));
  json_object_set_new(object, "nodes", json_integer((json_int_t)counts->nodes));
  json_object_set_new(object, "black_microlights", json_integer((json_int_t)counts->black));
  json_object_set_new(object, "shadow_rays", json_integer((json_int_t)counts->shadow_rays));
  json_object_set_new(object, "open_views", json_integer((json_int_t)counts->open_views));
  json_object_set_new(object, "pages_behind", json_integer((json_int_t)counts->pages_behind));
  json_object_set(object, "effects", stats->effects);
  if (stats->error) json_object_set(object, "error", stats->error);
  json_object_set_new(object, "error_estimate", number(counts->error));
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
    json_array_append_new(list,
                          json_pack("{s:o, s:i, s:f, s:o}", "light", json_any_string(light->path),
                                    "page", page + 1, "apertures", slab_accuracy_apertures[k],
                                    "about", number(accuracy[k].all)));
  }
  return result;
}

static enum result set_accuracy(json_t *object, const struct world *world, struct error *error) {
  enum result result = RESULT_OK;
  json_t *list = json_array();
  for (int l = 0; l < world->light_count; ++l)
    for (int page = 0; page < world->lights[l].count && result == RESULT_OK; ++page)
      result = add_accuracy(list, &world->lights[l], page, error);
  json_object_set_new(object, "slab_errors", list);
  return result;
}

/* Where the light of lamps that were imported comes from. */
static enum result set_sources(json_t *object, const struct world *world, struct error *error) {
  enum result result = RESULT_OK;
  json_t *list = json_array();
  for (int l = 0; l < world->light_count && result == RESULT_OK; ++l) {
    const struct light *light = &world->lights[l];
    json_t *source;
    result = slab_source(&light->pages[0].slab, &source, error);
    if (!source) continue;
    json_t *told = json_pack("{s:o}", "light", json_any_string(light->path));
    json_object_update(told, source);
    json_array_append_new(list, told);
    json_decref(source);
  }
  if (json_array_size(list) > 0) json_object_set(object, "imported", list);
  json_decref(list);
  return result;
}

static enum result write(struct stats *stats, const struct world *world, struct error *error) {
  char *text = NULL;
  stats_phase(stats, NULL);
  json_object_set_new(stats->seconds, "total", json_real(stats->total));
  json_t *object = object_of(stats, &world->options);
  enum result result = set_accuracy(object, world, error);
  if (result == RESULT_OK) result = set_sources(object, world, error);
  if (result == RESULT_OK)
    result = json_text(object, stats->mark, JSON_INDENT(2) | JSON_REAL_PRECISION(6), &text, error);
  if (result == RESULT_OK) {
    size_t length = strlen(text);
    text[length] = '\n'; /* in place of the final zero */
    result = output_text(world->options.stats, text, length + 1, error);
  }
  free(text);
  json_decref(object);
  return result;
}

enum result stats_end(struct stats *stats, const struct world *world, enum result result,
                      struct error *error) {
  if (result == RESULT_OK && world->options.stats) result = write(stats, world, error);
  json_decref(stats->seconds);
  json_decref(stats->effects);
  json_decref(stats->error);
  return result;
}
