/* bytes.hh - the bytes of an image file, for what it says of itself and OpenImageIO does not tell.
 * What lies beyond its end reads as nothing, and numbers there as 0. */
#ifndef BYTES_H
#define BYTES_H

#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <string>

struct Bytes {
  int fd; /* not owned */

  uint64_t size() const {
    struct stat status;
    return fstat(fd, &status) == 0 ? uint64_t(status.st_size) : 0;
  }

  std::string text(uint64_t at, size_t length) const {
    std::string text(length, 0);
    ssize_t got = pread(fd, &text[0], length, off_t(at));
    text.resize(got > 0 ? size_t(got) : 0);
    return text;
  }

  uint64_t big(uint64_t at, size_t length) const { /* the most significant byte first */
    uint64_t sum = 0;
    std::string bytes = text(at, length);
    bytes.resize(length);
    for (char byte : bytes) sum = sum << 8 | uint8_t(byte);
    return sum;
  }

  uint64_t little(uint64_t at, size_t length) const {
    uint64_t sum = 0;
    std::string bytes = text(at, length);
    for (size_t k = bytes.size(); k-- > 0;) sum = sum << 8 | uint8_t(bytes[k]);
    return sum;
  }
};

#endif
