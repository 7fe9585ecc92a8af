#include "import/rays/ray_bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER = 4 * RAY_BYTES_MOST };

enum result ray_bytes_open(const char *path, struct ray_bytes *bytes, struct error *error) {
  struct stat status;
  *bytes = (struct ray_bytes){.fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (bytes->fd < 0 || fstat(bytes->fd, &status) != 0) {
    enum result result = result_fail(error, RESULT_IO, "cannot be read: %s", strerror(errno));
    if (bytes->fd >= 0) close(bytes->fd);
    *bytes = (struct ray_bytes){0};
    return result;
  }
  bytes->buffer = S_ISREG(status.st_mode) ? malloc(BUFFER) : NULL;
  bytes->size = (uint64_t)status.st_size;
  if (bytes->buffer) return RESULT_OK;
  close(bytes->fd);
  *bytes = (struct ray_bytes){0};
  if (S_ISREG(status.st_mode)) return result_no_memory(error);
  return result_fail(error, RESULT_BAD, "is no regular file; rays are read twice");
}

void ray_bytes_close(struct ray_bytes *bytes) {
  if (bytes->buffer) close(bytes->fd);
  free(bytes->buffer);
  *bytes = (struct ray_bytes){0};
}

enum result ray_bytes_peek(struct ray_bytes *bytes, size_t wanted, const unsigned char **data,
                           size_t *count, struct error *error) {
  if (bytes->end - bytes->begin < wanted) {
    memmove(bytes->buffer, bytes->buffer + bytes->begin, bytes->end - bytes->begin);
    bytes->end -= bytes->begin;
    bytes->begin = 0;
    while (bytes->end < wanted) {
      ssize_t got = read(bytes->fd, bytes->buffer + bytes->end, BUFFER - bytes->end);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0)
        return result_fail(error, RESULT_IO, "byte %llu: cannot be read: %s",
                           (unsigned long long)bytes->at, strerror(errno));
      if (got == 0) break;
      bytes->end += (size_t)got;
    }
  }
  *data = bytes->buffer + bytes->begin;
  *count = bytes->end - bytes->begin;
  return RESULT_OK;
}

void ray_bytes_skip(struct ray_bytes *bytes, size_t count) {
  bytes->begin += count;
  bytes->at += count;
}

enum result ray_bytes_seek(struct ray_bytes *bytes, uint64_t at, struct error *error) {
  if (lseek(bytes->fd, (off_t)at, SEEK_SET) < 0)
    return result_fail(error, RESULT_IO, "byte %llu: cannot be read: %s", (unsigned long long)at,
                       strerror(errno));
  bytes->at = at;
  bytes->begin = bytes->end = 0;
  return RESULT_OK;
}
