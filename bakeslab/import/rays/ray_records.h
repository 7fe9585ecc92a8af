/* ray_records.h - rays as records of 32-bit floats: place, direction, and columns that a header
 * has named. */
#ifndef RAY_RECORDS_H
#define RAY_RECORDS_H

#include "import/rays/ray_file.h"

/* Numbers of a header. */
uint32_t ray_records_word(const unsigned char *bytes, bool swapped);
float ray_records_float(const unsigned char *bytes, bool swapped);

/* Refuses a file whose rays, from byte `start` on, are not as many as file->records promises, and
 * goes there. */
enum result ray_records_begin(struct ray_file *file, uint64_t start, struct error *error);

/* ray_format.read. */
enum result ray_records_read(struct ray_file *file, struct ray *rays, size_t most, size_t *count,
                             struct error *error);

/* Puts a ray in place: scales its origin to metres, makes its direction a unit vector. Refuses what
 * is not finite, is farther or brighter than any lamp, or has no direction, without a place. */
enum result ray_check(struct ray *ray, double metres, struct error *error);

#endif
