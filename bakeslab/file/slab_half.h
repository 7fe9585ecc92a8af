/* slab_half.h - IEEE 754 half precision for files, by Imath: imath_half_to_float, and
 * imath_float_to_half, which rounds to nearest, ties to even. Its table of all halves would be one
 * more library to load. */
#ifndef SLAB_HALF_H
#define SLAB_HALF_H

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <math.h>
#include <stdbool.h>

/* False for NaN. The largest finite half is 65504; from 65520 on, rounding gives infinity. */
static inline bool slab_half_holds(float value) {
  return fabsf(value) < 65520.0F;
}

#endif
