/* bake_warnings.h - what a lamp's author may not mean, in one line each: light that the slab does
 * not have, and likely reasons. */
#ifndef BAKE_WARNINGS_H
#define BAKE_WARNINGS_H

#include "batch/bake_run.h"

/* By trial runs of the work's lamp, before the bake: light_sources, which are counted in it, things
 * that glow by `ambient`, translucent surfaces with photons, files that the script writes. */
enum result bake_warn_of_lamp(const struct bake_work *work, struct lamp *lamp,
                              struct warnings *warnings, struct error *error);

/* Refuses a lamp with channels of which some light belongs to none: it would be in each. */
enum result bake_refuse_stray_light(const struct bake_work *work, struct error *error);

/* All pages are black: the likely reason, by more trial runs. Or all of one channel are. */
enum result bake_warn_of_darkness(const struct bake_work *work, const struct slab *pages, int count,
                                  struct warnings *warnings, struct error *error);

#endif
