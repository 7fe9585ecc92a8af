#include "made_rays.h"

#include <string.h>

#include "helpers.h"

void made_over(struct made_rays *file, size_t at, uint32_t word) {
  assert_true(at + 4 <= sizeof file->bytes);
  for (int k = 0; k < 4; ++k)
    file->bytes[at + (size_t)(file->big_endian ? 3 - k : k)] = (unsigned char)(word >> 8 * k);
}

void made_word(struct made_rays *file, uint32_t word) {
  made_over(file, file->size, word);
  file->size += 4;
}

void made_float(struct made_rays *file, double number) {
  float narrow = (float)number;
  uint32_t word;
  memcpy(&word, &narrow, 4);
  made_word(file, word);
}

void made_floats(struct made_rays *file, int count, const double *numbers) {
  for (int k = 0; k < count; ++k) made_float(file, numbers[k]);
}

void made_zeros(struct made_rays *file, size_t count) {
  assert_true(file->size + count <= sizeof file->bytes);
  memset(file->bytes + file->size, 0, count);
  file->size += count;
}

void made_tm25(struct made_rays *file, uint32_t rays, const char *flags) {
  file->size = 0;
  memcpy(file->bytes, "TM25", 4);
  file->size = 4;
  made_word(file, 2013);
  made_word(file, 0);
  made_float(file, 7);                          /* lm */
  made_float(file, 5);                          /* W */
  made_word(file, file->big_endian ? 0 : rays); /* 64 bits */
  made_word(file, file->big_endian ? rays : 0);
  made_zeros(file, 256 - file->size);
  for (int k = 0; k < 8; ++k) made_word(file, flags[k] == '1');
  made_zeros(file, (size_t)9 * 4000);
}

void made_zemax(struct made_rays *file, uint32_t rays, uint32_t unit, uint32_t type,
                uint32_t flux) {
  file->size = 0;
  made_word(file, 1010);
  made_word(file, rays);
  made_zeros(file, 100); /* description */
  made_float(file, 9);   /* flux of the source */
  made_float(file, 6);   /* of these rays */
  made_zeros(file, 5 * 4);
  made_word(file, unit);
  made_zeros(file, 13 * 4);
  made_word(file, type);
  made_word(file, flux);
  made_zeros(file, 8);
  assert_int_equal(file->size, 208);
}

const char *made_write(const struct made_rays *file, const char *name) {
  const char *path = scratch(name);
  write_bytes(path, file->bytes, file->size);
  return path;
}
