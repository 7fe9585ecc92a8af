/* bake_provenance.c - see bake_provenance.h. */
#include "bake/bake_provenance.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"
#include "file/slab_json.h"

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

char *bake_provenance(const struct bake_work *work, const struct bake_origin *origin) {
  static const char *const forms[] = {"mesh", "perspective", "transposed"};
  const struct bake_noise *noise = &origin->noise;
  unsigned long lost = slab_json_lost();
  json_t *object =
      json_pack("{s:o, s:s, s:s, s:o, s:s, s:f, s:f}", "command",
                command_json(work->options->command), "tool", "bakeslab " CANNED_VERSION,
                "renderer", work->povray->version, "effects", effects_json(work, origin), "camera",
                forms[work->look.form], "gain", work->look.gain, "rays", noise->rays);
  if (noise->known)
    json_object_set_new(object, "noise",
                        json_pack("{s:f, s:f, s:f}", "sample", noise->sample, "relative_to_mean",
                                  noise->mean != 0 ? noise->sample / noise->mean : 0, "flux",
                                  noise->flux));
  if (work->options->window_auto)
    json_object_set_new(object, "window", json_string(origin->window.line));
  if (work->options->tolerance > 0)
    json_object_set_new(object, "resolution", json_string(origin->resolution.line));
  if (origin->housing) json_object_set_new(object, "housing", json_string(origin->housing));
  char *text = json_dumps(object, JSON_COMPACT);
  json_decref(object);
  if (slab_json_lost() == lost) return text;
  free(text);
  return NULL;
}
