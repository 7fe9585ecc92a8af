/* made_rays.h - files of rays, written byte by byte from the formats' own descriptions, so that
 * tests of the readers share no code with them. */
#ifndef MADE_RAYS_H
#define MADE_RAYS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct made_rays {
  bool big_endian;
  size_t size;
  unsigned char bytes[1 << 17];
};

void made_word(struct made_rays *file, uint32_t word);
void made_float(struct made_rays *file, double number);
void made_floats(struct made_rays *file, int count, const double *numbers);
void made_zeros(struct made_rays *file, size_t count);
/* Puts a word over what is there. */
void made_over(struct made_rays *file, size_t at, uint32_t word);

/* The 36288 bytes of a TM-25 header with the eight flags, "11100000" say. Its fluxes are 5 W and
 * 7 lm. */
void made_tm25(struct made_rays *file, uint32_t rays, const char *flags);

/* The 208 bytes of a Zemax header: unit of length 0 to 4, rays of type 0 or 2, flux 0 or 1. */
void made_zemax(struct made_rays *file, uint32_t rays, uint32_t unit, uint32_t type, uint32_t flux);

/* Writes it to a scratch file of that name, whose path it returns. */
const char *made_write(const struct made_rays *file, const char *name);

#endif
