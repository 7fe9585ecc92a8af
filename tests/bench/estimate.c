/* estimate.c - estimate SOURCE RAYS SEEDS [UV ST]: rays of a source of known radiance become
 * samples, 16 x 16 x 64 x 64 or as given, once for each seed. Prints, as the RMS over the seeds,
 * the true error of the samples, the told one and that of plain bins; then CPU seconds to add a
 * million rays and to estimate; of the last seed what the rays held out show. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "import/rays/ray_estimate.h"
#include "oracle/known_rays.h"

struct sums {
  double error, told, bins, adding, estimating;
};

static double seconds(void) {
  return (double)clock() / CLOCKS_PER_SEC;
}

/* Squared, of the samples against the means over their cells of a source with flux 1. */
static double true_error(enum known_kind kind, const struct slab *slab) {
  size_t count = slab_sample_count(slab);
  double *mean = malloc(2 * count * sizeof *mean), error = 0, square = 0;
  if (!mean) exit(1);
  const double *etendue = mean + count;
  double flux = known_cells(kind, slab->samples, mean, mean + count);
  for (size_t n = 0; n < count; ++n) {
    double truth = mean[n] / flux, difference = (double)slab->rgb[3 * n] - truth;
    error += etendue[n] * difference * difference;
    square += etendue[n] * truth * truth;
  }
  free(mean);
  return error / square;
}

static void add_rays(struct ray_estimate *estimate, enum known_kind kind, double rays,
                     uint64_t *seed, struct sums *sums) {
  enum { BATCH = 100000 };
  static double abst[BATCH][SLAB_AXES];
  const double flux[3] = {1 / rays, 1 / rays, 1 / rays};
  for (int batch = 0; batch < rays / BATCH; ++batch) {
    for (int n = 0; n < BATCH; ++n) known_ray(kind, seed, abst[n]);
    double start = seconds();
    for (int n = 0; n < BATCH; ++n) ray_estimate_add(estimate, abst[n], flux);
    sums->adding += seconds() - start;
  }
}

static enum result try_seed(enum known_kind kind, double rays, uint64_t seed, const int grid[2],
                            struct sums *sums, struct ray_estimate_told *told) {
  struct slab page = known_page(kind, grid[0], grid[1]), slab;
  struct ray_estimate *estimate;
  struct error error;
  enum result result =
      ray_estimate_new(&page, &(struct ray_estimate_wish){.threads = 1}, &estimate, &error);
  if (result != RESULT_OK) return result;
  add_rays(estimate, kind, rays, &seed, sums);
  ray_estimate_whole(estimate, 1);
  double start = seconds();
  result = ray_estimate_finish(estimate, &slab, told, &error);
  sums->estimating += seconds() - start;
  ray_estimate_free(estimate);
  if (result != RESULT_OK) return result;
  sums->error += true_error(kind, &slab);
  sums->told += told->noise * told->noise;
  sums->bins += told->bins * told->bins;
  slab_free(&slab);
  return RESULT_OK;
}

int main(int argc, char **argv) {
  enum known_kind kind = KNOWN_SQUARE;
  if (argc < 4) return 2;
  while (kind < KNOWN_KINDS && strcmp(argv[1], known_sources[kind].name)) ++kind;
  if (kind == KNOWN_KINDS) return 2;
  double rays = strtod(argv[2], NULL);
  int seeds = atoi(argv[3]);
  const int grid[] = {argc > 5 ? atoi(argv[4]) : 16, argc > 5 ? atoi(argv[5]) : 64};
  struct sums sums = {0};
  struct ray_estimate_told told = {0};
  for (int seed = 1; seed <= seeds; ++seed)
    if (try_seed(kind, rays, (uint64_t)seed, grid, &sums, &told) != RESULT_OK) return 1;
  printf("%.6f %.6f %.5f %.3f %.2f %.5f\n", sqrt(sums.error / seeds), sqrt(sums.told / seeds),
         sqrt(sums.bins / seeds), sums.adding / seeds / rays * 1e6, sums.estimating / seeds,
         told.held_out);
  return 0;
}
