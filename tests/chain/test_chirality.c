/* test_chirality.c - a lamp that shines the letter F shows an F the right way
 * round on a wall, as someone sees it who looks the way the lamp shines. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "chain.h"
#include "letter.h"

/* A small lamp at the origin that shines along +z with the letter in its
 * directions: x/z to the right, y/z up. */
static struct slab letter_lamp(const double u[3], const double v[3], double st_distance) {
  struct slab slab = slab_default();
  const int samples[4] = {2, 2, 28, 28};
  memcpy(slab.samples, samples, sizeof samples);
  memcpy(slab.u, u, sizeof slab.u);
  memcpy(slab.v, v, sizeof slab.v);
  slab.normal[1] = 0;
  slab.normal[2] = 1;
  slab.st_distance = st_distance;
  snprintf(slab.name, sizeof slab.name, "letter");
  assert_int_equal(slab_alloc(&slab, NULL), RESULT_OK);
  double edge = chain_length(u);
  for (int t = 0; t < samples[3]; ++t)
    for (int s = 0; s < samples[2]; ++s) {
      /* Far from the small aperture, the same direction for either st plane. */
      double x = -1 + (s + 0.5) * 2 / samples[2], y = -1 + (t + 0.5) * 2 / samples[3];
      double value = letter_ink((x * u[0] + y * v[0]) / edge, (x * u[1] + y * v[1]) / edge);
      for (int view = 0; view < 4; ++view)
        for (int c = 0; c < 3; ++c)
          oracle_sample(&slab, view % 2, view / 2, s, t)[c] = (float)value;
    }
  return slab;
}

static void shine(const double u[3], const double v[3], double st_distance) {
  struct slab slab = letter_lamp(u, v, st_distance);
  struct picture picture;
  chain_include(&slab, 1, "lamp", "");
  letter_render("#include \"lamp.inc\"\nobject { Letter_Canned(1, 1) }", &picture);
  letter_expect(&picture);
  picture_free(&picture);
  slab_free(&slab);
}

/* All frames around +z whose axes are x and y: half of them have u x v = -n. */
TEST(test_letter) {
  const double edge = 0.04;
  for (int k = 0; k < 8; ++k) {
    double u[3] = {0, 0, 0}, v[3] = {0, 0, 0};
    int swap = k & 1;
    u[swap] = k & 2 ? -edge : edge;
    v[!swap] = k & 4 ? -edge : edge;
    shine(u, v, k % 3 ? INFINITY : 5);
  }
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
