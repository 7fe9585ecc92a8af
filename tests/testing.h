/* testing.h - what tests in C share: cmocka, scratch files, numbers that are near each other. */
#ifndef TESTING_H
#define TESTING_H

/* cmocka.h needs these before it */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* A path in a scratch directory of this process, which exists; valid until the next 8 calls. The
 * directory and what is in it goes away at exit. */
const char *scratch(const char *name);

/* The number of entries in the scratch directory. */
int scratch_entries(void);

/* |a - b| <= tolerance in double precision (cmocka's assert_float_equal rounds to float); NaN
 * fails. */
#define assert_near(a, b, tolerance) assert_near_at(a, b, tolerance, __FILE__, __LINE__)
void assert_near_at(double a, double b, double tolerance, const char *file, int line);

#endif
