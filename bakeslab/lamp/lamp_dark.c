#include "lamp/lamp_dark.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/files.h"
#include "base/sdl_scan.h"

/* The mean light of the lamp with a change of the scene. */
static enum result try_change(const struct lamp_trial *trial, const char *change, double *mean,
                              struct error *error) {
  struct lamp lamp;
  enum result result = lamp_try(trial->povray, trial->source, trial->directory, trial->effects,
                                change, trial->stop, &lamp, error);
  *mean = lamp.mean;
  lamp_free(&lamp);
  return result;
}

/* ---- Words of the script ---- */

/* Whether the word has an effect: `ambient 0` and `emission 0` have none. */
static bool means_it(const char *word, const char *after) {
  if (strcmp(word, "ambient") != 0 && strcmp(word, "emission") != 0) return true;
  after += strspn(after, " \t\r\n");
  return *after != '0' || after[1] == '.' || isdigit((unsigned char)after[1]);
}

static bool has_word(const char *text, const char *word) {
  for (const char *at = text; *at;) {
    const char *after = sdl_skip_quiet(at);
    size_t length = sdl_word_length(at);
    if (after == at && length == strlen(word) && !strncmp(at, word, length) &&
        means_it(word, at + length))
      return true;
    at = after != at ? after : at + (length ? length : 1);
  }
  return false;
}

/* Whether a file that the script reads, canned.inc apart, has the word and means it. */
static bool mentions(const struct lamp_trial *trial, const struct lamp *lamp, const char *word) {
  bool found = false;
  size_t own = strlen(trial->source->include_pov);
  for (int n = 0; n < lamp->reads.count && !found; ++n) {
    const char *path = lamp_reads_path(&lamp->reads, n);
    if (!strncmp(path, trial->source->include_pov, own) && path + own == strrchr(path, '/'))
      continue;
    char *text = files_read("", path);
    found = text && has_word(text, word);
    free(text);
  }
  return found;
}

enum result lamp_count_lights(const struct lamp_trial *trial, struct lamp *lamp,
                              struct error *error) {
  struct lamp unlit = {0};
  enum result result = RESULT_OK;
  if (mentions(trial, lamp, "light_source"))
    result = lamp_try(trial->povray, trial->source, trial->directory, trial->effects,
                      "Canned_Probe_Unlit_", trial->stop, &unlit, error);
  lamp->lights = unlit.all_lights;
  lamp_free(&unlit);
  return result;
}

bool lamp_has_light_groups(const struct lamp_trial *trial, const struct lamp *lamp) {
  return mentions(trial, lamp, "light_group");
}

/* ---- Ambient ---- */

static const char let_glow[] = "Canned_Probe_Glow_";

enum result lamp_ambient_part(const struct lamp_trial *trial, const struct lamp *lamp, double *part,
                              struct error *error) {
  double mean = 0;
  *part = 0;
  if (!mentions(trial, lamp, "ambient")) return RESULT_OK;
  enum result result = try_change(trial, let_glow, &mean, error);
  if (result == RESULT_OK && mean > 0) *part = fmax(0, 1 - lamp->mean / mean);
  return result;
}

enum result lamp_outside_channels(const struct lamp_trial *trial, double *mean,
                                  struct error *error) {
  return try_change(trial, "Canned_Probe_No_Channel_", mean, error);
}

/* ---- Darkness ---- */

enum result lamp_why_dark(const struct lamp_trial *trial, const struct lamp *lamp,
                          const char **reason, struct error *error) {
  static const struct {
    const char *change, *reason;
  } tries[] = {
      {"Canned_Probe_Turned_",
       "there is light on the other side: the normal of Canned_Slab points into the lamp; turn it"},
      {"Canned_Probe_Wide_", "its light leaves outside the st window, or is so small that no ray "
                             "met it; enlarge the window "
                             "in Canned_Slab, or bake with more --rays"},
      {"Canned_Probe_Inside_",
       "there is light inside, but something opaque shuts the aperture; move Canned_Slab to where "
       "the light leaves, or open the lamp"},
      {let_glow,
       "it glows by ambient, which canned.inc switches off; write emission in place of ambient"}};
  double mean = 0;
  enum result result = RESULT_OK;
  size_t n = 0, count = sizeof tries / sizeof *tries;
  if (lamp->mean > 0) {
    *reason =
        "its light is so small that no ray met it, though some of the trial run did; bake with "
        "more --rays, --uv or --st, or make the window in Canned_Slab narrower";
    return RESULT_OK;
  }
  for (; n < count && result == RESULT_OK; ++n) {
    result = try_change(trial, tries[n].change, &mean, error);
    if (mean > 0) break;
  }
  *reason =
      n < count      ? tries[n].reason
      : lamp->lights ? "it is lit by light_sources alone, and shows nothing that they light; "
                       "write Canned_Bulb"
      : lamp->bulbs && lamp->peak == 0 ? "its bulbs have radiance 0"
      : lamp->bulbs ? "neither its bulbs nor what they light can be seen through the slabs"
      : mentions(trial, lamp, "emission")
          ? "what has emission cannot be seen: its pigment is clear (rgbt 1, rgbf 1), its media "
            "are in no hollow object, or it is hidden by clipped_by, no_image or other things"
          : "nothing in it glows; add Canned_Bulb, or finish { emission ... }";
  return result;
}
