/* simd.h - vectors of the compiler (gcc's and clang's extension), and functions that are compiled
 * once for each instruction set and chosen when they are called.
 *
 * No operation is fused (-ffp-contract=off), so all of them give the same bits. */
#ifndef SIMD_H
#define SIMD_H

typedef float simd_float8 __attribute__((vector_size(32)));
typedef float simd_float4 __attribute__((vector_size(16)));
typedef double simd_double4 __attribute__((vector_size(32)));

/* The same at any address of an array of floats or doubles. */
typedef float simd_floats8 __attribute__((vector_size(32), aligned(4), may_alias));
typedef float simd_floats4 __attribute__((vector_size(16), aligned(4), may_alias));
typedef double simd_doubles4 __attribute__((vector_size(32), aligned(8), may_alias));
typedef long long simd_longs4 __attribute__((vector_size(32), aligned(8), may_alias));
typedef int simd_ints4 __attribute__((vector_size(16), aligned(4), may_alias));
#define SIMD_LOAD(type, from) (*(const type *)(from))

#define SIMD_INLINE static inline __attribute__((always_inline))

typedef int simd_int4 __attribute__((vector_size(16)));
typedef long long simd_long4 __attribute__((vector_size(32))); /* of comparisons of doubles */

SIMD_INLINE simd_float4 simd_magnitude(simd_float4 x) {
  return (simd_float4)((simd_int4)x & 0x7fffffff);
}

SIMD_INLINE simd_float4 simd_larger(simd_float4 a, simd_float4 b) {
  simd_int4 more = a > b;
  return (simd_float4)(((simd_int4)a & more) | ((simd_int4)b & ~more));
}

/* Macros, since gcc warns of vectors of 32 bytes as parameters. SIMD_CHOOSE: x where `which` is
 * true, else y. */
#define SIMD_ALL(x) ((simd_double4){(x), (x), (x), (x)})
#define SIMD_CHOOSE(which, x, y)                                                                   \
  ((simd_double4)(((simd_long4)(x) & (which)) | ((simd_long4)(y) & ~(which))))
#define SIMD_ABSOLUTE(x) ((simd_double4)((simd_long4)(x)&0x7fffffffffffffff))
#define SIMD_ROOT(x) ((simd_double4){sqrt((x)[0]), sqrt((x)[1]), sqrt((x)[2]), sqrt((x)[3])})

/* Inlined, unlike fmin and fmax; there are no NaNs. */
SIMD_INLINE double simd_min(double a, double b) {
  return a < b ? a : b;
}

SIMD_INLINE double simd_max(double a, double b) {
  return a > b ? a : b;
}

/* Defines `void NAME parameters`, which does what NAME_body does. (The attribute target_clones
 * would be shorter, but clang 14 does not export its functions.) */
#ifdef __x86_64__
#define SIMD_DISPATCH(name, parameters, arguments)                                                 \
  __attribute__((target("avx2"))) static void name##_avx2 parameters {                             \
    name##_body arguments;                                                                         \
  }                                                                                                \
  static void name##_plain parameters {                                                            \
    name##_body arguments;                                                                         \
  }                                                                                                \
  void name parameters {                                                                           \
    (__builtin_cpu_supports("avx2") ? name##_avx2 : name##_plain) arguments;                       \
  }
#else
#define SIMD_DISPATCH(name, parameters, arguments)                                                 \
  void name parameters {                                                                           \
    name##_body arguments;                                                                         \
  }
#endif

/* Room in arrays is rounded up to so many elements. */
enum { SIMD_LANES = 8 };

#endif
