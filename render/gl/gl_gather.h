/* gl_gather.h - what receivers gather, as gather.h, by the sum of gl_sum.h. */
#ifndef GL_GATHER_H
#define GL_GATHER_H

#include "gl/gl_sum.h"
#include "microlight/receiver.h"

enum { GL_GATHER_MOST = 1024 * 256 }; /* receivers at a time */

struct gl_gather; /* owned by whoever created it; with a context of its own */
enum result gl_gather_create(const struct gl_sum_settings *settings, struct gl_gather **gather,
                             struct error *error);
void gl_gather_free(struct gl_gather *gather); /* NULL allowed */
const struct gather_counts *gl_gather_counts(const struct gl_gather *gather);

/* From the thread that created it. Errors are not predicted: INFINITY. */
enum result gl_gather_light(struct gl_gather *gather, const struct receiver *receivers, int count,
                            struct gathered *gathered, struct error *error);

#endif
