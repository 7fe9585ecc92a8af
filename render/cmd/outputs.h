/* outputs.h - can the files be written that a command was asked for? Before the work. */
#ifndef OUTPUTS_H
#define OUTPUTS_H

#include "base/result.h"

/* Refuses outputs that cannot be written, that are one file, or that are one of the inputs,
 * naming them. NULL among either is skipped; "-" is standard output. */
enum result outputs_check(const char *const *outputs, int output_count, const char *const *inputs,
                          int input_count, struct error *error);

#endif
