/* targets.h - can the files be written that a command was asked for? Before the work. */
#ifndef TARGETS_H
#define TARGETS_H

#include "slab_error.h"

/* Refuses outputs that cannot be written, that are one file, or that are one of the inputs,
 * naming them. NULL among either is skipped; "-" is standard output. */
enum slab_result targets_check(const char *const *outputs, int output_count,
                               const char *const *inputs, int input_count,
                               struct slab_error *error);

#endif
