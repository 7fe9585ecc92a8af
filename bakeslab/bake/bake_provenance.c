#include "bake/bake_provenance.h"

#include <math.h>
#include <stdio.h>

#include "base/version.h"
#include "file/json_text.h"

static json_t *effects_json(const struct bake_work *work, const struct bake_origin *origin) {
  json_t *object = json_object();
  for (int k = 0; k < EFFECTS; ++k) {
    char line[PROBE_LINE];
    bool on = work->look.effects->setting[k] > 0;
    snprintf(line, sizeof line, "%s", on ? "on" : "off");
    if (origin->probed) probe_say(&origin->probe, work->look.effects, (enum effect)k, line);
    json_object_set_new(object, effect_word((enum effect)k), json_string(line));
  }
  if (work->lamp->own_radiosity)
    json_object_set_new(object, effect_word(INTERREFLECTION), json_string("by the script"));
  return object;
}

static json_t *warnings_json(const struct warnings *warnings) {
  json_t *array = json_array();
  for (int n = 0; n < warnings_kept(warnings); ++n)
    json_array_append_new(array, json_any_string(warnings->lines[n]));
  return array;
}

enum result bake_provenance(const struct bake_work *work, const struct bake_origin *origin,
                            const struct warnings *warnings, char **text, struct error *error) {
  static const char *const forms[] = {"mesh", "perspective", "transposed"};
  const struct bake_noise *noise = &origin->noise;
  unsigned long mark = json_mark();
  json_t *object =
      json_pack("{s:o, s:s, s:s, s:o, s:s, s:f, s:f}", "command",
                json_any_string(work->options->command), "tool", "bakeslab " CANNED_VERSION,
                "renderer", work->povray->version, "effects", effects_json(work, origin), "camera",
                forms[work->look.form], "gain", work->look.gain, "rays", noise->rays);
  if (noise->known)
    json_object_set_new(object, "noise",
                        json_pack("{s:f, s:f, s:f}", "sample", noise->sample, "relative_to_mean",
                                  noise->mean != 0 ? noise->sample / noise->mean : 0, "flux",
                                  noise->flux));
  if (origin->window.line[0])
    json_object_set_new(object, "window", json_string(origin->window.line));
  if (work->options->tolerance > 0)
    json_object_set_new(object, "resolution", json_string(origin->resolution.line));
  json_object_set_new(object, "energy", json_string(origin->energy.line));
  if (!isnan(origin->energy.efficiency))
    json_object_set_new(object, "efficiency", json_real(origin->energy.efficiency));
  if (!isnan(origin->energy.missed))
    json_object_set_new(object, "missed", json_real(origin->energy.missed));
  if (warnings->count > 0) json_object_set_new(object, "warnings", warnings_json(warnings));
  if (origin->housing) json_object_set_new(object, "housing", json_string(origin->housing));
  enum result result = json_text(object, mark, JSON_COMPACT, text, error);
  json_decref(object);
  return result;
}
