/* testing.h - what tests in C share: tests that register themselves, scratch files, comparisons. */
#ifndef TESTING_H
#define TESTING_H

#include <math.h>

/* cmocka.h needs these before it */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* A test, which registers itself; it has no use for cmocka's state. */
#define TEST(name)                                                                                 \
  static void name(void **);                                                                       \
  __attribute__((constructor)) static void name##_is_there(void) {                                 \
    testing_add(#name, name, NULL);                                                                \
  }                                                                                                \
  static void name(__attribute__((unused)) void **unused)
/* And one of a row of a table, whose cmocka state points to the row. */
void testing_add(const char *name, CMUnitTestFunction test, const void *row);

/* Runs the tests in the order in which they were added, that of the file; what main returns. Setup
 * and teardown, or NULL, are of all of them together. */
int testing_run(CMFixtureFunction setup, CMFixtureFunction teardown);

/* A path in a scratch directory of this process, which exists; valid until the next 8 calls. The
 * directory and what is in it goes away at exit. */
const char *scratch(const char *name);

/* The number of entries in the scratch directory. */
int scratch_entries(void);

/* |a - b| <= tolerance in double precision (cmocka's assert_float_equal rounds to float); NaN
 * fails. */
#define assert_near(a, b, tolerance) assert_near_at(a, b, tolerance, __FILE__, __LINE__)
void assert_near_at(double a, double b, double tolerance, const char *file, int line);

/* The larger one, and NaN where one is: fmax would drop it. The worst of some errors is then at
 * most what is allowed only if each of them is. */
static inline double larger(double a, double b) {
  return a > b || isnan(a) ? a : b;
}

#endif
