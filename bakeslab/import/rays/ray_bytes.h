/* ray_bytes.h - the bytes of a regular file, read once from front to back through a buffer, so that
 * files of any size can be read. */
#ifndef RAY_BYTES_H
#define RAY_BYTES_H

#include <stddef.h>
#include <stdint.h>

#include "base/result.h"

enum { RAY_BYTES_MOST = 1 << 16 }; /* that can be peeked at */

struct ray_bytes {
  int fd;
  uint64_t size; /* of the file */
  uint64_t at;   /* the next byte, from 0 */
  unsigned char *buffer;
  size_t begin, end; /* of what the buffer holds */
};

/* Refuses what is no regular file. Messages do not name the file. */
enum result ray_bytes_open(const char *path, struct ray_bytes *bytes, struct error *error);
void ray_bytes_close(struct ray_bytes *bytes); /* zeroed ones allowed */

/* The bytes that come next, valid until the next call: `*count` of them, at least `wanted`
 * (up to RAY_BYTES_MOST) unless the file ends before. */
enum result ray_bytes_peek(struct ray_bytes *bytes, size_t wanted, const unsigned char **data,
                           size_t *count, struct error *error);

/* Goes on, by no more than was peeked at. */
void ray_bytes_skip(struct ray_bytes *bytes, size_t count);

/* Goes to another place of the file. */
enum result ray_bytes_seek(struct ray_bytes *bytes, uint64_t at, struct error *error);

#endif
