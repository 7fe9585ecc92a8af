/* helpers.h - what the slab tests share: scratch files, slabs filled with
 * known numbers, an independent oracle for lookups. */
#ifndef HELPERS_H
#define HELPERS_H

/* cmocka.h needs these before it */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "slab_file.h"

/* A path in a scratch directory of this process, which exists; valid until the
 * next 8 calls. The directory and what is in it goes away at exit. */
const char *scratch(const char *name);

/* A number in [0, 1) from a seed; the same on every machine. */
double random_number(uint32_t *seed);

/* A mirrored frame (u x v = -n), off its origin, with an off-centre window. */
struct slab awkward_slab(const int samples[SLAB_AXES], double distance);

/* Fills the samples with positive colours between 0.05 and 1.05, white every
 * 7th. */
void fill_colours(struct slab *slab, uint32_t seed);

/* Quadrilinear radiance by nested loops over all samples and hat functions,
 * from the format's text alone. */
void oracle_lookup(const struct slab *slab, double a, double b, double s, double t, double rgb[3]);

/* |a - b| <= tolerance in double precision (cmocka's assert_float_equal rounds
 * to float); NaN fails. */
#define assert_near(a, b, tolerance) assert_near_at(a, b, tolerance, __FILE__, __LINE__)
void assert_near_at(double a, double b, double tolerance, const char *file, int line);

/* Fails the test with the message where the operation failed. */
void assert_ok(enum slab_result result, const struct slab_error *error);

/* The operation must have been refused with a message that holds all of the
 * given pieces, on one line. End the list with NULL. */
void assert_refused(enum slab_result result, const struct slab_error *error, ...);

/* Opens and loads all of a file; whatever it says must hold the pieces. */
void assert_file_refused(const char *path, const char *piece1, const char *piece2);

void write_bytes(const char *path, const void *bytes, size_t count);

/* The number of entries in the scratch directory. */
int scratch_entries(void);

#endif
