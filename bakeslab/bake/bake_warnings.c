#include "bake/bake_warnings.h"

#include <stdlib.h>
#include <string.h>

#include "base/files.h"
#include "lamp/lamp_dark.h"

static enum result begin_trial(const struct bake_work *work, struct lamp_trial *trial,
                               char **scratch, struct error *error) {
  enum result result = bake_store_scratch(work->store, NULL, scratch, error);
  *trial = (struct lamp_trial){.povray = work->povray,
                               .source = work->source,
                               .directory = *scratch,
                               .effects = work->look.effects,
                               .stop = work->stop};
  return result;
}

static void end_trial(char *scratch) {
  if (scratch) files_remove_tree(scratch);
  free(scratch);
}

enum result bake_warn_of_lamp(const struct bake_work *work, struct lamp *lamp,
                              struct warnings *warnings, struct error *error) {
  struct lamp_trial trial;
  char *scratch = NULL;
  double ambient = 0;
  enum result result = begin_trial(work, &trial, &scratch, error);
  if (result == RESULT_OK) result = lamp_count_lights(&trial, lamp, error);
  if (result == RESULT_OK) result = lamp_ambient_part(&trial, lamp, &ambient, error);
  /* Where Canned_Glow tells their flux, they stand for things that are seen. */
  bool told = lamp->glow_flux[0] + lamp->glow_flux[1] + lamp->glow_flux[2] > 0;
  if (lamp->lights && !told)
    warnings_add(warnings,
                 "%d light_source%s besides Canned_Bulb's: a ray cannot hit a point, so %s direct "
                 "light is not in the slab, only what %s; write Canned_Bulb(centre, radius, "
                 "radiance) instead, or an object with finish { emission ... }",
                 lamp->lights, lamp->lights == 1 ? "" : "s", lamp->lights == 1 ? "its" : "their",
                 lamp->lights == 1 ? "it lights" : "they light");
  if (lamp_has_light_groups(&trial, lamp))
    warnings_add(warnings, "light_sources in a light_group, which POV-Ray does not count: their "
                           "direct light is not in the slab; write Canned_Bulb instead");
  if (ambient > 0.01)
    warnings_add(warnings,
                 "objects glow by ambient (%.3g %% of the light in a trial run with it), which "
                 "canned.inc switches off: it is not in the slab; write emission where a thing "
                 "is to glow",
                 100 * ambient);
  if (lamp->reads.translucent && work->look.effects->setting[CAUSTICS] > 0)
    warnings_add(warnings,
                 "photons (caustics) and a translucent surface (diffuse with two numbers): POV-Ray "
                 "shows photons through it up to ten times too bright, so that the slab may have "
                 "too much light even where its efficiency is below 100 %%; leave caustics out of "
                 "--effects, or give the surface one number");
  if (lamp->reads.write[0])
    warnings_add(warnings,
                 "the script writes files (%s is the first); with --sandbox it can only do so in a "
                 "folder that is removed after it",
                 lamp->reads.write);
  end_trial(scratch);
  return result;
}

enum result bake_refuse_stray_light(const struct bake_work *work, struct error *error) {
  struct lamp_trial trial;
  char *scratch = NULL;
  double stray = 0;
  if (!work->lamp->channel_count) return RESULT_OK;
  enum result result = begin_trial(work, &trial, &scratch, error);
  if (result == RESULT_OK) result = lamp_outside_channels(&trial, &stray, error);
  end_trial(scratch);
  if (result != RESULT_OK || stray == 0) return result;
  return result_fail(error, RESULT_BAD,
                     "%s: some of its light belongs to no Canned_Channel and would be in each; "
                     "write emission rgb Canned_Lit(...) for what glows after a Canned_Channel, "
                     "and Canned_Bulb or rgb Canned_Lit(...) for a light_source",
                     work->source->script);
}

/* Whether a channel gives any light; of no name: whether any does. */
static bool is_lit(const struct slab *pages, int count, const char *channel) {
  for (int n = 0; n < count; ++n)
    if ((!*channel || !strcmp(pages[n].channel, channel)) && slab_is_lit(&pages[n])) return true;
  return false;
}

enum result bake_warn_of_darkness(const struct bake_work *work, const struct slab *pages, int count,
                                  struct warnings *warnings, struct error *error) {
  struct lamp_trial trial;
  char *scratch = NULL;
  const char *reason = "";
  bool lit = is_lit(pages, count, "");
  for (int n = 0; lit && n < work->lamp->channel_count; ++n)
    if (!is_lit(pages, count, work->lamp->channels[n].name))
      warnings_add(warnings, "the channel \"%s\" gives no light that leaves through the pages",
                   work->lamp->channels[n].name);
  if (lit) return RESULT_OK;
  enum result result = begin_trial(work, &trial, &scratch, error);
  if (result == RESULT_OK) result = lamp_why_dark(&trial, work->lamp, &reason, error);
  if (result == RESULT_OK) warnings_add(warnings, "gives no light at all: %s", reason);
  end_trial(scratch);
  return result;
}
