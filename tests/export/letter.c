#include "letter.h"

#include <stdio.h>
#include <stdlib.h>

#include "testing.h"

enum { SIDE = 5 };
static const char *const rows[SIDE] = {"####.", "#....", "###..", "#....", "#...."};
static const double focus = 3, width = 2;

double letter_light(int pixel) {
  return rows[pixel / SIDE][pixel % SIDE] == '#';
}

const char *letter_write(void) {
  char command[1024];
  const char *image = scratch("letter.ppm"), *slab = scratch("letter.exr");
  FILE *file = fopen(image, "w");
  assert_non_null(file);
  fprintf(file, "P3\n%d %d\n255\n", SIDE, SIDE);
  for (int k = 0; k < LETTER_PIXELS; ++k)
    fputs(letter_light(k) > 0 ? "255 255 255\n" : "0 0 0\n", file);
  assert_int_equal(fclose(file), 0);
  snprintf(command, sizeof command,
           "'%s' projector '%s' -o '%s' --uv 2 --aperture 0.1 --focus %g --width %g",
           getenv("BAKESLAB"), image, slab, focus, width);
  assert_int_equal(system(command), 0);
  return slab;
}

/* On the right of somebody who looks along `forward` is forward x up. */
void letter_ray(int pixel, const double forward[3], const double up[3], double ray[6]) {
  double right = ((pixel % SIDE + 0.5) / SIDE - 0.5) * width;
  double high = (0.5 - (pixel / SIDE + 0.5) / SIDE) * width;
  for (int c = 0; c < 3; ++c) {
    int y = (c + 1) % 3, z = (c + 2) % 3;
    ray[c] = focus * forward[c] + high * up[c] + right * (forward[y] * up[z] - forward[z] * up[y]);
    ray[3 + c] = -ray[c];
  }
}
