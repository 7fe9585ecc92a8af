/* slab_json.c - reads and writes the JSON text of a page with jansson. */
#include "file/slab_json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/json_text.h"

enum { FORMAT_VERSION = 1 };

static enum result get_numbers(const json_t *root, const char *key, double *out, size_t count,
                               struct error *error) {
  const json_t *array = json_object_get(root, key);
  if (!array) return result_fail(error, RESULT_BAD, "required key \"%s\" is missing", key);
  if (!json_is_array(array) || json_array_size(array) != count)
    return result_fail(error, RESULT_BAD, "\"%s\" must be an array of %zu numbers", key, count);
  for (size_t k = 0; k < count; ++k) {
    const json_t *number = json_array_get(array, k);
    if (!json_is_number(number))
      return result_fail(error, RESULT_BAD, "\"%s\" must be an array of %zu numbers", key, count);
    out[k] = json_number_value(number);
  }
  return RESULT_OK;
}

static enum result get_number(const json_t *root, const char *key, double *out,
                              struct error *error) {
  const json_t *number = json_object_get(root, key);
  if (!number) return RESULT_OK;
  if (!json_is_number(number))
    return result_fail(error, RESULT_BAD, "\"%s\" must be a number", key);
  *out = json_number_value(number);
  return RESULT_OK;
}

static enum result get_string(const json_t *root, const char *key, char *out, size_t room,
                              struct error *error) {
  const json_t *string = json_object_get(root, key);
  if (!string) return RESULT_OK;
  if (!json_is_string(string))
    return result_fail(error, RESULT_BAD, "\"%s\" must be a string", key);
  size_t length = json_string_length(string);
  if (strlen(json_string_value(string)) != length)
    return result_fail(error, RESULT_BAD, "\"%s\" holds a zero byte", key);
  if (length >= room)
    return result_fail(error, RESULT_BAD, "\"%s\" is longer than %zu bytes", key, room - 1);
  memcpy(out, json_string_value(string), length + 1);
  return RESULT_OK;
}

static enum result check_format(const json_t *root, struct error *error) {
  if (!json_is_object(root))
    return result_fail(error, RESULT_BAD, "the JSON text is not an object");
  const json_t *format = json_object_get(root, "format");
  if (!format) return result_fail(error, RESULT_BAD, "required key \"format\" is missing");
  if (!json_is_string(format) || strcmp(json_string_value(format), "light-slab") != 0)
    return result_fail(error, RESULT_BAD, "\"format\" is not \"light-slab\"");
  const json_t *version = json_object_get(root, "version");
  if (!version) return result_fail(error, RESULT_BAD, "required key \"version\" is missing");
  if (!json_is_integer(version))
    return result_fail(error, RESULT_BAD, "\"version\" must be an integer");
  if (json_integer_value(version) != FORMAT_VERSION)
    return result_fail(error, RESULT_BAD,
                       "version %" JSON_INTEGER_FORMAT
                       " of the format is unknown (this program reads version %d)",
                       json_integer_value(version), FORMAT_VERSION);
  return RESULT_OK;
}

static enum result get_samples(const json_t *root, struct slab *slab, struct error *error) {
  const json_t *array = json_object_get(root, "samples");
  if (!array) return result_fail(error, RESULT_BAD, "required key \"samples\" is missing");
  if (!json_is_array(array) || json_array_size(array) != SLAB_AXES)
    return result_fail(error, RESULT_BAD, "\"samples\" must be an array of 4 integers");
  for (size_t axis = 0; axis < SLAB_AXES; ++axis) {
    const json_t *number = json_array_get(array, axis);
    if (!json_is_integer(number))
      return result_fail(error, RESULT_BAD, "\"samples\" must be an array of 4 integers");
    json_int_t value = json_integer_value(number);
    if (value < 1 || value > 1 << 30)
      return result_fail(error, RESULT_BAD,
                         "\"samples\" has %" JSON_INTEGER_FORMAT ", each must be at least 1",
                         value);
    slab->samples[axis] = (int)value;
  }
  return RESULT_OK;
}

static enum result check_samples_are(const json_t *root, struct error *error) {
  const json_t *how = json_object_get(root, "samples_are");
  if (!how) return RESULT_OK;
  const char *text = json_string_value(how);
  if (text && (!strcmp(text, "cell_means") || !strcmp(text, "points"))) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "\"samples_are\" must be \"cell_means\" or \"points\"");
}

static enum result get_white(const json_t *root, double white[3], struct error *error) {
  white[0] = white[1] = white[2] = 1;
  if (!json_object_get(root, "logluv_white")) return RESULT_OK;
  enum result result = get_numbers(root, "logluv_white", white, 3, error);
  for (int c = 0; c < 3 && result == RESULT_OK; ++c)
    if (!(white[c] > 0) || !isfinite(1 / white[c]))
      result = result_fail(error, RESULT_BAD, "\"logluv_white\" must be positive");
  return result;
}

static enum result get_fields(const json_t *root, struct slab *slab, double white[3],
                              struct error *error) {
  enum result result = check_format(root, error);
  if (result == RESULT_OK) result = get_samples(root, slab, error);
  if (result == RESULT_OK) result = get_numbers(root, "center", slab->center, 3, error);
  if (result == RESULT_OK) result = get_numbers(root, "u", slab->u, 3, error);
  if (result == RESULT_OK) result = get_numbers(root, "v", slab->v, 3, error);
  if (result == RESULT_OK) result = get_numbers(root, "normal", slab->normal, 3, error);
  if (result == RESULT_OK) result = get_numbers(root, "st_window", slab->st_window, 4, error);
  if (result == RESULT_OK && !json_is_null(json_object_get(root, "st_distance")))
    result = get_number(root, "st_distance", &slab->st_distance, error);
  if (result == RESULT_OK)
    result = get_number(root, "metres_per_unit", &slab->metres_per_unit, error);
  if (result == RESULT_OK) result = get_string(root, "name", slab->name, sizeof slab->name, error);
  if (result == RESULT_OK)
    result = get_string(root, "channel", slab->channel, sizeof slab->channel, error);
  if (result == RESULT_OK)
    result =
        get_string(root, "radiance_unit", slab->radiance_unit, sizeof slab->radiance_unit, error);
  if (result == RESULT_OK) result = check_samples_are(root, error);
  if (result == RESULT_OK) result = get_white(root, white, error);
  if (result == RESULT_OK) result = slab_check(slab, error);
  return result;
}

enum result slab_json_parse(const char *text, struct slab *slab, double white[3],
                            struct error *error) {
  double ignored[3];
  json_t *root;
  *slab = slab_default();
  enum result result = json_read(text, JSON_REJECT_DUPLICATES, &root, error);
  if (result == RESULT_OK) result = get_fields(root, slab, white ? white : ignored, error);
  if (result == RESULT_OK && !(slab->json = strdup(text))) result = result_no_memory(error);
  if (result != RESULT_OK) slab_free(slab);
  json_decref(root);
  return result;
}

enum result slab_json_root(const struct slab *slab, json_t **root, struct error *error) {
  enum result result = json_read(slab->json ? slab->json : "{}", 0, root, error);
  if (result != RESULT_OK || json_is_object(*root)) return result;
  json_decref(*root);
  *root = NULL;
  return result_fail(error, RESULT_BAD, "the JSON text is not an object");
}

/* How values are written: every double as it is. */
static const size_t exactly = JSON_REAL_PRECISION(17);

/* A whole number is written without a fraction: 1, not 1.0. */
static json_t *number(double value) {
  return value == rint(value) && fabs(value) < 1e15 ? json_integer((json_int_t)value)
                                                    : json_real(value);
}

static json_t *numbers(const double *values, size_t count) {
  json_t *array = json_array();
  for (size_t k = 0; k < count; ++k) json_array_append_new(array, number(values[k]));
  return array;
}

enum result slab_json_text(const struct slab *slab, const double white[3], char **text,
                           struct error *error) {
  *text = NULL;
  json_t *root = NULL;
  unsigned long mark = json_mark();
  enum result result = slab_check(slab, error);
  if (result == RESULT_OK) result = slab_json_root(slab, &root, error);
  if (result != RESULT_OK) return result;
  const int *n = slab->samples;
  json_t *fields = json_pack(
      "{s:s, s:i, s:s, s:[iiii], s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:s}", "format", "light-slab",
      "version", FORMAT_VERSION, "name", slab->name, "samples", n[0], n[1], n[2], n[3], "center",
      numbers(slab->center, 3), "u", numbers(slab->u, 3), "v", numbers(slab->v, 3), "normal",
      numbers(slab->normal, 3), "st_window", numbers(slab->st_window, 4), "st_distance",
      isinf(slab->st_distance) ? json_null() : number(slab->st_distance), "metres_per_unit",
      number(slab->metres_per_unit), "radiance_unit", slab->radiance_unit);
  bool failed = json_object_update(root, fields) != 0;
  if (slab->channel[0])
    json_object_set_new(root, "channel", json_string(slab->channel));
  else
    json_object_del(root, "channel");
  if (white)
    json_object_set_new(root, "logluv_white", numbers(white, 3));
  else
    json_object_del(root, "logluv_white");
  result = json_whole(mark, error);
  if (result == RESULT_OK && failed)
    result = result_fail(error, RESULT_BAD,
                         "the description cannot be written as JSON (is the name UTF-8?)");
  if (result == RESULT_OK) result = json_text(root, mark, exactly, text, error);
  json_decref(fields);
  json_decref(root);
  return result;
}

/* Sets a key to a value, which it takes over, in the page's text. */
static enum result set(struct slab *slab, const char *key, json_t *value, unsigned long mark,
                       struct error *error) {
  json_t *root = NULL;
  char *text = NULL;
  enum result result = slab_json_root(slab, &root, error);
  if (value) json_object_set_new(root, key, value);
  if (!value) json_object_del(root, key);
  if (result == RESULT_OK) result = json_text(root, mark, exactly, &text, error);
  if (result == RESULT_OK) {
    free(slab->json);
    slab->json = text;
  }
  json_decref(root);
  return result;
}

enum result slab_json_set(struct slab *slab, const char *key, const char *value,
                          struct error *error) {
  json_t *parsed = NULL;
  unsigned long mark = json_mark();
  enum result result = RESULT_OK;
  if (value) result = json_read(value, JSON_DECODE_ANY | JSON_REJECT_DUPLICATES, &parsed, error);
  if (result != RESULT_OK) return result_at(result, error, "\"%s\"", key);
  return set(slab, key, parsed, mark, error);
}

enum result slab_json_sampling(const struct slab *slab, struct slab_sampling *sampling,
                               struct error *error) {
  json_t *root = NULL;
  enum result result = slab_json_root(slab, &root, error);
  const json_t *provenance = json_object_get(root, "provenance");
  const json_t *noise = json_object_get(provenance, "noise");
  const char *are = json_string_value(json_object_get(root, "samples_are"));
  const json_t *sample = json_object_get(noise, "sample"), *flux = json_object_get(noise, "flux");
  *sampling = (struct slab_sampling){
      .points = are && !strcmp(are, "points"),
      .sharpened = json_is_string(json_object_get(provenance, "sharpened")),
      .sample_noise = json_is_number(sample) ? json_number_value(sample) : NAN,
      .flux_noise = json_is_number(flux) ? json_number_value(flux) : NAN};
  sampling->logluv = json_object_get(root, "logluv_white") != NULL;
  if (result == RESULT_OK) result = get_white(root, sampling->white, error);
  json_decref(root);
  return result;
}

/* A copy of the provenance to change. */
static json_t *copy_provenance(const json_t *root) {
  json_t *old = json_object_get(root, "provenance");
  return json_is_object(old) ? json_copy(old) : json_object();
}

enum result slab_json_record_sharpening(struct slab *slab, enum slab_sharpening how,
                                        struct error *error) {
  json_t *root = NULL;
  unsigned long mark = json_mark();
  enum result result = slab_json_root(slab, &root, error);
  if (result != RESULT_OK) return result;
  json_t *provenance = copy_provenance(root);
  json_object_set_new(provenance, "sharpened",
                      json_string(how == SLAB_SHARPEN_POSITIVE ? "st, not below zero" : "st"));
  result = set(slab, "provenance", provenance, mark, error);
  json_decref(root);
  return result;
}

/* Of light that was imported, what is known of samples that have changed: source and assumptions
 * stay. */
static void forget_import_error(json_t *entry, json_t *fresh) {
  json_t *import = json_object_get(fresh, "import");
  if (!json_is_object(import)) return;
  json_object_set(entry, "import", import);
  import = json_copy(import);
  json_object_del(import, "error");
  json_object_del(import, "error_is");
  json_object_set_new(fresh, "import", import);
}

/* The entry of "history" that tells how the slab was made before, by its provenance. Where the
 * samples have changed, what is known of them moves there from the `fresh` one. */
static json_t *history_entry(const json_t *provenance, json_t *fresh, bool changed) {
  static const char *const kept[] = {"command", "tool"}, *const of_samples[] = {
                                                             "rays",       "noise",  "energy",
                                                             "efficiency", "missed", "warnings"};
  json_t *entry = json_object();
  for (size_t k = 0; k < 2; ++k)
    json_object_set(entry, kept[k], json_object_get(provenance, kept[k]));
  for (size_t k = 0; changed && k < sizeof of_samples / sizeof *of_samples; ++k) {
    json_object_set(entry, of_samples[k], json_object_get(provenance, of_samples[k]));
    json_object_del(fresh, of_samples[k]);
  }
  if (changed) forget_import_error(entry, fresh);
  return entry;
}

enum result slab_json_record(struct slab *slab, const char *command, const char *tool, bool changed,
                             struct error *error) {
  json_t *root = NULL;
  unsigned long mark = json_mark();
  enum result result = slab_json_root(slab, &root, error);
  if (result != RESULT_OK) return result;
  json_t *old = json_object_get(root, "provenance"), *fresh = copy_provenance(root);
  json_t *before = json_object_get(old, "history");
  json_t *history = json_is_array(before) ? json_copy(before) : json_array();
  if (json_is_object(old))
    json_array_append_new(history, history_entry(old, fresh, changed));
  else if (old)
    json_array_append(history, old);
  json_object_set_new(fresh, "command", json_any_string(command));
  json_object_set_new(fresh, "tool", json_any_string(tool));
  json_object_set_new(fresh, "history", history);
  result = set(slab, "provenance", fresh, mark, error);
  json_decref(root);
  return result;
}
