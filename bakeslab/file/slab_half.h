/* slab_half.h - IEEE 754 half precision, to and from float, for files. */
#ifndef SLAB_HALF_H
#define SLAB_HALF_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* Largest finite half. From 65520 on, rounding gives infinity. */
#define SLAB_HALF_MAX 65504.0F

static inline bool slab_half_holds(float value) {
  return fabsf(value) < 65520.0F; /* false for NaN */
}

static inline float slab_half_to_float(uint16_t half) {
  int exponent = half >> 10 & 31, mantissa = half & 1023;
  float size;
  if (exponent == 31)
    size = mantissa ? NAN : INFINITY;
  else if (exponent == 0)
    size = ldexpf((float)mantissa, -24);
  else
    size = ldexpf((float)(mantissa + 1024), exponent - 25);
  return half & 0x8000 ? -size : size;
}

/* Rounds to nearest, ties to even; what half cannot hold becomes infinity. */
static inline uint16_t slab_half_from_float(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  uint16_t sign = (uint16_t)(bits >> 16 & 0x8000);
  float size = fabsf(value);
  if (isnan(value)) return (uint16_t)(sign | 0x7e00);
  if (!slab_half_holds(value)) return (uint16_t)(sign | 0x7c00);
  int exponent;
  frexpf(size, &exponent); /* size = m 2^exponent, 1/2 <= m < 1 */
  if (exponent < -13 || size == 0) exponent = -13;
  /* Mantissa in units of the last place, 11 bits: rintf rounds to even. A
   * carry runs over into the exponent field, as it must. */
  int mantissa = (int)rintf(ldexpf(size, 11 - exponent));
  int biased = exponent + 13; /* 0 for subnormals */
  return (uint16_t)(sign | (biased * 1024 + mantissa));
}

#endif
