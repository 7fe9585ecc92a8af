#include "import/kind/import_provenance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/version.h"
#include "file/json_text.h"
#include "file/slab_json.h"

/* The files' names without their folders: one, or an array. */
static json_t *source(const struct import_wish *wish) {
  json_t *array = json_array();
  for (int n = 0; n < wish->file_count; ++n) {
    const char *slash = strrchr(wish->files[n], '/');
    json_array_append_new(array, json_any_string(slash ? slash + 1 : wish->files[n]));
  }
  if (wish->file_count != 1) return array;
  json_t *one = json_incref(json_array_get(array, 0));
  json_decref(array);
  return one;
}

static void set_number(json_t *object, const char *key, double value) {
  if (isfinite(value)) json_object_set_new(object, key, json_real(value));
}

static json_t *import_json(const struct import_wish *wish, const char *kind,
                           const struct import_story *story) {
  json_t *import = json_pack("{s:o, s:s, s:o}", "source", source(wish), "kind", kind, "assumptions",
                             json_any_string(story->assumptions));
  set_number(import, "flux_in", story->flux_in);
  set_number(import, "flux_out", story->flux_out);
  set_number(import, "error", story->error);
  json_object_set_new(import, "error_is", json_any_string(story->error_is));
  return import;
}

enum result import_provenance(const struct import_wish *wish, const char *kind, const char *command,
                              struct import_light *light, struct error *error) {
  const struct import_story *story = &light->story;
  char *text = NULL;
  unsigned long mark = json_mark();
  json_t *object = json_pack("{s:o, s:s, s:o}", "command", json_any_string(command), "tool",
                             "bakeslab " CANNED_VERSION, "import", import_json(wish, kind, story));
  if (isfinite(story->sample_error)) {
    json_t *noise = json_pack("{s:f}", "sample", story->sample_error);
    set_number(noise, "flux", story->flux_error);
    json_object_set_new(object, "noise", noise);
  }
  if (story->missed > 0) set_number(object, "missed", story->missed);
  enum result result = json_text(object, mark, JSON_COMPACT, &text, error);
  for (int n = 0; n < light->count && result == RESULT_OK; ++n) {
    const char *samples = story->points ? "\"points\"" : "\"cell_means\"";
    result = slab_json_set(&light->slabs[n], "samples_are", samples, error);
    if (result == RESULT_OK) result = slab_json_set(&light->slabs[n], "provenance", text, error);
  }
  free(text);
  json_decref(object);
  return result;
}
