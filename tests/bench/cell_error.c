/* cell_error.c - what a slab that was made of a lamp's rays is off from the lamp's own slab:
 *
 *   cell_error LAMP IMPORTED
 *
 * prints the relative RMS error of the cells' luminance over the etendue, against means of the
 * lamp's radiance over the same cells. Pages are the same in both; IMPORTED is in metres and its
 * directions are at infinity. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "file/slab_file.h"
#include "oracle/lookup.h"

enum { POINTS = 3, CELLS = 60000 }; /* along each axis of a cell; of a page, at most */

/* The mean of the lamp's radiance over a cell of the other slab. */
static double lamp_mean(const struct slab *lamp, const struct slab *made, const int at[SLAB_AXES]) {
  double sum = 0, kappa = slab_kappa(lamp);
  int count = POINTS * POINTS * POINTS * POINTS;
  for (int n = 0; n < count; ++n) {
    double x[SLAB_AXES], rgb[3];
    for (int axis = 0, left = n; axis < SLAB_AXES; ++axis, left /= POINTS)
      x[axis] = slab_position(made, axis, at[axis]) +
                ((left % POINTS + 0.5) / POINTS - 0.5) * slab_spacing(made, axis);
    for (int axis = 0; axis < 2; ++axis) {
      x[axis] /= lamp->metres_per_unit;
      x[2 + axis] += kappa * x[axis];
    }
    oracle_lookup(lamp, x, rgb);
    sum += 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  }
  return sum / count;
}

/* Adds to the sums of squares of one page: of the error, of the radiance. */
static void compare(const struct slab *lamp, const struct slab *made, double sums[2]) {
  size_t count = slab_sample_count(made), step = count / CELLS + 1;
  for (size_t pixel = 0; pixel < count; pixel += step) {
    int at[SLAB_AXES];
    slab_locate(made, pixel, at);
    double s = slab_position(made, SLAB_S, at[SLAB_S]), t = slab_position(made, SLAB_T, at[SLAB_T]);
    double weight = (double)step / pow(1 + s * s + t * t, 2), right = lamp_mean(lamp, made, at);
    double got = slab_luminance(slab_at((struct slab *)made, at[0], at[1], at[2], at[3]));
    sums[0] += weight * (got - right) * (got - right);
    sums[1] += weight * right * right;
  }
}

int main(int argc, char **argv) {
  struct slab *slabs[2] = {0};
  struct error error = {{0}};
  double sums[2] = {0};
  int count[2] = {0};
  for (int k = 0; k < 2; ++k)
    if (argc != 3 || slab_file_load_all(argv[1 + k], &slabs[k], &count[k], &error) != RESULT_OK) {
      fprintf(stderr, "cell_error: %s\n", argc == 3 ? error.text : "give LAMP and IMPORTED");
      return 1;
    }
  for (int page = 0; page < count[0] && page < count[1]; ++page)
    compare(&slabs[0][page], &slabs[1][page], sums);
  printf("%.6g\n", sqrt(sums[0] / sums[1]));
  for (int k = 0; k < 2; ++k) slab_file_free_all(slabs[k], count[k]);
  return 0;
}
