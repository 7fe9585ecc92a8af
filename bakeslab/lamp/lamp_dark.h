/* lamp_dark.h - why a lamp gives less light than its author sees: trial runs (lamp.h) of the script
 * with one thing changed each. */
#ifndef LAMP_DARK_H
#define LAMP_DARK_H

#include "lamp/lamp.h"

/* What a trial run needs, as for lamp_try. */
struct lamp_trial {
  const struct povray *povray;
  const struct lamp_source *source;
  const char *directory;
  const struct effects *effects;
  const volatile sig_atomic_t *stop;
};

/* Counts the light_sources besides Canned_Bulb's: lamp->lights. */
enum result lamp_count_lights(const struct lamp_trial *trial, struct lamp *lamp,
                              struct error *error);

/* The part of the light, as the trial run sees it, that is there only where `ambient` glows, which
 * canned.inc switches off; 0 where no file that the script reads asks for it. */
enum result lamp_ambient_part(const struct lamp_trial *trial, const struct lamp *lamp, double *part,
                              struct error *error);

/* Whether a file that the script reads has a light_group: POV-Ray's count of light_sources leaves
 * those in it out. */
bool lamp_has_light_groups(const struct lamp_trial *trial, const struct lamp *lamp);

/* The mean light, as the trial run sees it, of what belongs to no channel of the lamp. */
enum result lamp_outside_channels(const struct lamp_trial *trial, double *mean,
                                  struct error *error);

/* The likely reason why no light of the lamp leaves through its slabs, and what to do: a text that
 * lives as long as the program. */
enum result lamp_why_dark(const struct lamp_trial *trial, const struct lamp *lamp,
                          const char **reason, struct error *error);

#endif
