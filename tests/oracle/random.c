/* random.c - see random.h. */
#include "oracle/random.h"

#include <math.h>

uint64_t random_bits(uint64_t *seed) {
  uint64_t z = *seed += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

double random_number(uint64_t *seed) {
  return (double)(random_bits(seed) >> 11) * 0x1p-53;
}

double random_between(uint64_t *seed, double low, double high) {
  return low + (high - low) * random_number(seed);
}

double random_log(uint64_t *seed, double low, double high) {
  return low * pow(high / low, random_number(seed));
}

int random_choose(uint64_t *seed, int count) {
  return (int)(count * random_number(seed));
}

void random_direction(uint64_t *seed, double direction[3]) {
  double z = random_between(seed, -1, 1), turn = 2 * M_PI * random_number(seed);
  direction[0] = sqrt(1 - z * z) * cos(turn);
  direction[1] = sqrt(1 - z * z) * sin(turn);
  direction[2] = z;
}

static double dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* Gram and Schmidt, of vectors that are not nearly in a plane. */
void random_frame(uint64_t *seed, int hand, double frame[3][3]) {
  for (int k = 0; k < 3; ++k) {
    double size;
    do {
      for (int c = 0; c < 3; ++c) frame[k][c] = random_between(seed, -1, 1);
      for (int m = 0; m < k; ++m) {
        double share = dot(frame[k], frame[m]);
        for (int c = 0; c < 3; ++c) frame[k][c] -= share * frame[m][c];
      }
      size = sqrt(dot(frame[k], frame[k]));
    } while (size < 0.1);
    for (int c = 0; c < 3; ++c) frame[k][c] /= size;
  }
  double triple = 0;
  for (int c = 0; c < 3; ++c) {
    int d = (c + 1) % 3, e = (c + 2) % 3;
    triple += (frame[0][d] * frame[1][e] - frame[0][e] * frame[1][d]) * frame[2][c];
  }
  for (int c = 0; c < 3 && hand * triple < 0; ++c) frame[2][c] = -frame[2][c];
}
