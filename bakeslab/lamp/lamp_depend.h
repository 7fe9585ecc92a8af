/* lamp_depend.h - a rule for make: a slab depends on every file that its lamp script reads. */
#ifndef LAMP_DEPEND_H
#define LAMP_DEPEND_H

#include <stdbool.h>

#include "lamp/lamp_reads.h"

/* Writes the rule to `path` ("-": standard output), as gcc's -MD -MP would: `target` depends on
 * all files, and each but `script` has an empty rule, so that one that is removed remakes the
 * target where make would stop. Files below the working folder have relative names. Refuses
 * names that make cannot carry, and a `path` that is the target or one of the files. A `trial`,
 * before the work, refuses the same and leaves nothing behind. */
enum result lamp_depend(const struct lamp_reads *reads, const char *script, const char *target,
                        const char *path, bool trial, struct error *error);

#endif
