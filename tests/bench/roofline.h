/* roofline.h - what this machine can do at most: how fast one core reads, and multiplies and
 * adds. */
#ifndef ROOFLINE_H
#define ROOFLINE_H

#include <stddef.h>

/* CPU seconds of the calling thread so far. */
double roofline_seconds(void);

/* Bytes per second of reading all of an array in order. `count` is rounded down to 64. */
double roofline_read(const float *array, size_t count);

/* Multiply-adds per second in single precision, all lanes of all units busy: in the widest
 * registers and fused; and as render/ may (simd.h): 8 lanes, two operations. */
double roofline_fused(void);
double roofline_plain(void);

#endif
