/* simd.h - vectors of the compiler (gcc's and clang's extension), and functions that exist
 * once for each instruction set and are chosen when the program starts.
 *
 * No operation is fused (-ffp-contract=off), so all of them give the same bits. */
#ifndef SIMD_H
#define SIMD_H

typedef float simd_float8 __attribute__((vector_size(32)));
typedef float simd_float4 __attribute__((vector_size(16)));
typedef double simd_double4 __attribute__((vector_size(32)));

/* The same anywhere in an array of floats or doubles. */
typedef float simd_floats8 __attribute__((vector_size(32), aligned(4), may_alias));
typedef float simd_floats4 __attribute__((vector_size(16), aligned(4), may_alias));
typedef double simd_doubles4 __attribute__((vector_size(32), aligned(8), may_alias));
#define SIMD_LOAD(type, from) (*(const type *)(from))

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) &&             \
    !defined(__SANITIZE_THREAD__)
#define SIMD_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SIMD_CLONES
#endif

#define SIMD_INLINE static inline __attribute__((always_inline))

/* Lanes in an array; counts are rounded up to it. */
enum { SIMD_LANES = 8 };

#endif
