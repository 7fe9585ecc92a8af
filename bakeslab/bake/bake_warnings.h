/* bake_warnings.h - what a lamp's author may not mean, in one line each: light that the slab does
 * not have, and likely reasons. */
#ifndef BAKE_WARNINGS_H
#define BAKE_WARNINGS_H

#include "batch/bake_run.h"

/* By trial runs, before the bake: light_sources, things that glow by `ambient`, files that the
 * script writes. */
enum result bake_warn_of_lamp(const struct bake_work *work, struct warnings *warnings,
                              struct error *error);

/* All pages are black: the likely reason, by more trial runs. */
enum result bake_warn_of_darkness(const struct bake_work *work, const struct slab *pages,
                                  struct warnings *warnings, struct error *error);

#endif
