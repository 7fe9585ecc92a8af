/* helpers.h - what the slab tests share: slabs filled with known numbers, and refusals. */
#ifndef HELPERS_H
#define HELPERS_H

#include "file/slab_file.h"
#include "file/slab_json.h"
#include "testing.h"

/* A mirrored frame (u x v = -n), off its origin, with an off-centre window. */
struct slab awkward_slab(const int samples[SLAB_AXES], double distance);

/* Fills the samples with positive colours between 0.05 and 1.05, white every
 * 7th. */
void fill_colours(struct slab *slab, uint64_t seed);

/* Fails the test with the message where the operation failed. */
void assert_ok(enum result result, const struct error *error);

/* The operation must have been refused with a message that holds all of the
 * given pieces, on one line. End the list with NULL. */
void assert_refused(enum result result, const struct error *error, ...);

/* Opens and loads all of a file; whatever it says must hold the pieces. */
void assert_file_refused(const char *path, const char *piece1, const char *piece2);

/* What is read of a file after it was written; slab_file_free_all it. Fails the test where either
 * fails. */
struct slab *write_and_load(const char *path, const struct slab *pages, int count,
                            enum slab_precision precision);

void write_bytes(const char *path, const void *bytes, size_t count);

/* What a page's JSON says of its samples. */
struct slab_sampling sampling_of(const struct slab *slab);

/* The text of a value of a page's JSON, at key or key.inner; the caller frees it. */
char *json_of(const struct slab *slab, const char *key, const char *inner);

#endif
