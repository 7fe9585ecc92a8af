/* roofline.c - see roofline.h. The Makefile lets the compiler fuse here. */
#include "roofline.h"

#include <string.h>
#include <time.h>

typedef float wide __attribute__((vector_size(64)));
typedef float eight __attribute__((vector_size(32)));

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__)
#define WIDEST __attribute__((target_clones("avx512f", "arch=haswell", "default")))
#define AVX2 __attribute__((target_clones("avx2", "default")))
#else
#define WIDEST
#define AVX2
#endif

enum { CHAINS = 12, STEPS = 1 << 21 };

double roofline_seconds(void) {
  struct timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Results go here, so that the compiler leaves the work in. */
static volatile float sink;

WIDEST
static void read_all(const float *array, size_t count) {
  wide sum[4] = {{0}};
  for (size_t n = 0; n + 64 <= count; n += 64)
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) {
      wide part;
      memcpy(&part, array + n + 16 * k, sizeof part);
      sum[k] += part;
    }
  wide all = (sum[0] + sum[1]) + (sum[2] + sum[3]);
  sink = all[0] + all[7] + all[15];
}

double roofline_read(const float *array, size_t count) {
  double start = roofline_seconds();
  read_all(array, count);
  return (double)(count / 64 * 64 * sizeof *array) / (roofline_seconds() - start);
}

WIDEST
static void multiply_add_wide(float by, float more) {
  wide x[CHAINS] = {{0}};
  for (int n = 0; n < STEPS; ++n)
#pragma GCC unroll 12
    for (int k = 0; k < CHAINS; ++k) x[k] = x[k] * by + more;
  for (int k = 1; k < CHAINS; ++k) x[0] += x[k];
  sink = x[0][0];
}

/* Half of the chains multiply and half add: neither waits for the other, nothing fuses. */
AVX2 static void multiply_add_eight(float by, float more) {
  eight x[CHAINS] = {{0}};
  for (int n = 0; n < STEPS; ++n)
#pragma GCC unroll 12
    for (int k = 0; k < CHAINS; ++k) x[k] = k % 2 ? x[k] * by : x[k] + more;
  for (int k = 1; k < CHAINS; ++k) x[0] += x[k];
  sink = x[0][0];
}

double roofline_fused(void) {
  double start = roofline_seconds();
  multiply_add_wide(0.75f, 0.25f);
  return 16.0 * CHAINS * STEPS / (roofline_seconds() - start);
}

double roofline_plain(void) {
  double start = roofline_seconds();
  multiply_add_eight(0.75f, 0.25f);
  return 8.0 * CHAINS / 2 * STEPS / (roofline_seconds() - start);
}
