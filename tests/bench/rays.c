/* rays.c - a TM-25 file of a Lambertian square millimetre of 1 W, as bench/97-rays reads it:
 *   rays COUNT >FILE */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/random.h"

enum { HEADER = 288 + 36000, FLAGS = 256 };

static void put_word(unsigned char *at, uint64_t word, int bytes) {
  for (int k = 0; k < bytes; ++k) at[k] = (unsigned char)(word >> 8 * k);
}

static void put_float(unsigned char *at, double number) {
  float narrow = (float)number;
  uint32_t word;
  memcpy(&word, &narrow, sizeof word);
  put_word(at, word, 4);
}

static void make_ray(uint64_t *seed, double flux, unsigned char ray[28]) {
  double r = sqrt(random_number(seed)), angle = random_between(seed, 0, 6.283185307179586);
  const double numbers[7] = {random_between(seed, -0.5, 0.5),
                             random_between(seed, -0.5, 0.5),
                             0,
                             r * cos(angle),
                             r * sin(angle),
                             sqrt(1 - r * r),
                             flux};
  for (int k = 0; k < 7; ++k) put_float(ray + 4 * k, numbers[k]);
}

int main(int argc, char **argv) {
  static unsigned char header[HEADER];
  unsigned char ray[28];
  uint64_t seed = 1, count = argc == 2 ? strtoull(argv[1], NULL, 10) : 0;
  if (count == 0) {
    fputs("rays COUNT >FILE\n", stderr);
    return 2;
  }
  memcpy(header, "TM25", 4);
  put_word(header + 4, 2013, 4);
  put_float(header + 16, 1);
  put_word(header + 20, count, 8);
  for (int k = 0; k < 3; ++k) put_word(header + FLAGS + 4 * k, 1, 4);
  fwrite(header, 1, sizeof header, stdout);
  for (uint64_t n = 0; n < count; ++n) {
    make_ray(&seed, 1 / (double)count, ray);
    fwrite(ray, 1, sizeof ray, stdout);
  }
  return fflush(stdout) || ferror(stdout);
}
