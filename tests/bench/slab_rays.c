/* slab_rays.c - rays that leave a lamp, drawn from a fine slab of it, as text for `bakeslab
 * import`:
 *
 *   slab_rays SLAB COUNT SEED >RAYS
 *
 * some COUNT rays of equal flux, each drawn by itself: a Poisson process along the raster, by the
 * samples' flux, uniform in their cells. The first page only; luminance. Lengths in lamp units,
 * flux by metres. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "file/slab_file.h"
#include "oracle/random.h"

static void die(const char *text) {
  fprintf(stderr, "slab_rays: %s\n", text);
  exit(1);
}

static double length(const double x[3]) {
  return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

/* Flux of a sample's cell, by its middle: L cos^4 da db ds dt. */
static double cell_flux(const struct slab *slab, size_t pixel) {
  int at[SLAB_AXES];
  slab_locate(slab, pixel, at);
  double kappa = slab_kappa(slab), square = 1, volume = 1;
  for (int k = 0; k < 2; ++k) {
    double a = slab_position(slab, SLAB_U + k, at[k]), s = slab_position(slab, 2 + k, at[2 + k]);
    square += (s - kappa * a) * (s - kappa * a);
    volume *= slab_spacing(slab, SLAB_U + k) * slab_spacing(slab, SLAB_S + k);
  }
  return slab_luminance(slab->rgb + 3 * pixel) / (square * square) * volume;
}

static void print_ray(const struct slab *slab, size_t pixel, double flux, uint64_t *seed) {
  int at[SLAB_AXES];
  double x[SLAB_AXES], origin[3], direction[3], kappa = slab_kappa(slab);
  slab_locate(slab, pixel, at);
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    x[axis] = slab_position(slab, axis, at[axis]) +
              (random_number(seed) - 0.5) * slab_spacing(slab, axis);
  for (int n = 0; n < 3; ++n) {
    double u = slab->u[n] / length(slab->u), v = slab->v[n] / length(slab->v);
    origin[n] = slab->center[n] + x[0] * u + x[1] * v;
    direction[n] = slab->normal[n] + (x[2] - kappa * x[0]) * u + (x[3] - kappa * x[1]) * v;
  }
  printf("%.6g %.6g %.6g %.6g %.6g %.6g %.6g\n", origin[0], origin[1], origin[2], direction[0],
         direction[1], direction[2], flux);
}

int main(int argc, char **argv) {
  struct slab *slabs;
  struct error error;
  int pages;
  if (argc != 4) die("SLAB COUNT SEED");
  if (slab_file_load_all(argv[1], &slabs, &pages, &error) != RESULT_OK) die(error.text);
  double count = atof(argv[2]), sum = 0, all = 0;
  uint64_t seed = (uint64_t)atoi(argv[3]);
  double metric = slabs->metres_per_unit * slabs->metres_per_unit;
  size_t pixels = slab_sample_count(slabs);
  for (size_t n = 0; n < pixels; ++n) all += cell_flux(slabs, n);
  double next = -log(1 - random_number(&seed)); /* where the next ray is, in rays */
  for (size_t n = 0; n < pixels; ++n) {
    sum += cell_flux(slabs, n) / all * count;
    while (next < sum) {
      print_ray(slabs, n, metric * all / count, &seed);
      next -= log(1 - random_number(&seed));
    }
  }
  slab_file_free_all(slabs, pages);
  return 0;
}
