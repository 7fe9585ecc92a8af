/* test_bake_allocate.c - how an adaptive bake shares its rays: a lamp of which few rays meet the
 * source keeps its flux, whatever the first rays saw by chance (Kirk and Arvo, "Unbiased sampling
 * techniques for image synthesis", 1991); more rays go where there is more noise; the limits hold.
 * Rays are the test's own coins. */
#include <math.h>
#include <stdlib.h>

#include "batch/bake_plan.h"
#include "helpers.h"
#include "oracle/random.h"

enum { VIEWS = 16, SIDE = 8, ACROSS = 2, FIRST = 4, MOST = 64 };
enum { TILES = VIEWS * VIEWS * ACROSS * ACROSS, CELLS = SIDE * SIDE };

static struct slab slab;
static struct bake_tiles tiles;

/* Views of ACROSS x ACROSS tiles. */
static int begin(void **state) {
  (void)state;
  slab = (struct slab){.samples = {VIEWS, VIEWS, ACROSS * SIDE, ACROSS * SIDE}};
  return bake_tiles_init(&tiles, &slab, 1, false, SIDE, NULL) != RESULT_OK;
}

static int end(void **state) {
  (void)state;
  bake_tiles_free(&tiles);
  return 0;
}

/* The sum of so many rays of a tile, one of `rare` of which has the radiance `rare`: their mean is
 * 1. Adds the squares of what pairs differ by. */
static double shoot(int passes, double rare, uint64_t *seed, double *squares) {
  double sum = 0;
  for (int pair = 0; pair < CELLS * passes / 2; ++pair) {
    double a = random_number(seed) < 1 / rare ? rare : 0;
    double b = random_number(seed) < 1 / rare ? rare : 0;
    sum += a + b;
    *squares += (a - b) * (a - b);
  }
  return sum;
}

/* Whether a tile's view is one of every other in u and v. */
static bool is_odd(int tile) {
  int grid[SLAB_AXES], at[SLAB_AXES] = {0};
  bake_tile_grid(&tiles, 0, grid);
  while (bake_tile_number(&tiles, 0, at) != tile) assert_true(bake_tile_next(grid, at));
  return (at[SLAB_U] + at[SLAB_V]) % 2;
}

/* The mean over all cells of an adaptive bake: FIRST rays, then what they ask for. The odd views
 * may be dark. */
static double bake(double rare, bool odd_are_dark, uint64_t *seed) {
  static const struct bake_limits limits = {MOST / 4, MOST, 0};
  double sums[TILES], deviation[TILES], mean = 0, unused = 0;
  bool dark[TILES];
  int passes[TILES];
  for (int n = 0; n < TILES; ++n) {
    double squares = 0;
    dark[n] = odd_are_dark && is_odd(n);
    sums[n] = dark[n] ? 0 : shoot(FIRST, rare, seed, &squares);
    deviation[n] = sqrt(squares / (CELLS * FIRST));
    passes[n] = FIRST;
  }
  assert_int_equal(bake_plan_allocate(&tiles, deviation, &limits, passes, NULL), RESULT_OK);
  for (int n = 0; n < TILES; ++n) {
    if (!dark[n]) sums[n] += shoot(passes[n] - FIRST, rare, seed, &unused);
    mean += sums[n] / (CELLS * passes[n]);
  }
  return mean / TILES;
}

/* A tile's first rays meet the source 1.5 times on average, and in one of five tiles never: had
 * those no more rays, a fifth of their light would be missing. */
static double mean_bake(bool odd_are_dark) {
  enum { BAKES = 10 };
  uint64_t seed = 1;
  double mean = 0;
  for (int k = 0; k < BAKES; ++k) mean += bake(CELLS * FIRST / 1.5, odd_are_dark, &seed) / BAKES;
  return mean;
}

TEST(test_flux) {
  double mean = mean_bake(false);
  print_message("mean of adaptive bakes of a lamp of radiance 1: %.3f\n", mean);
  assert_true(fabs(mean - 1) < 0.03);
}

/* Small sources far apart: what one view sees, the next ones do not. */
TEST(test_flux_of_every_other_view) {
  double mean = mean_bake(true);
  print_message("mean of adaptive bakes, half of the views dark: %.3f\n", mean);
  assert_true(fabs(mean - 0.5) < 0.03);
}

/* Neyman's: in proportion to the deviation, in powers of two, within the rays that there are. */
TEST(test_shares) {
  static const struct bake_limits limits = {8, MOST, 0};
  double deviation[TILES], rays = 0;
  int passes[TILES];
  for (int n = 0; n < TILES; ++n) {
    deviation[n] = n < TILES / 2 ? 1 : 4; /* halves along v: few have neighbours of both kinds */
    passes[n] = FIRST;
  }
  assert_int_equal(bake_plan_allocate(&tiles, deviation, &limits, passes, NULL), RESULT_OK);
  for (int n = 0; n < TILES; ++n) rays += passes[n];
  assert_true(rays <= 8.0 * TILES && rays >= 6.0 * TILES);
  assert_int_equal(passes[0], FIRST);
  assert_true(passes[TILES - 1] >= 2 * FIRST);
}

/* Tiles without rays stay without; and where the variance may stay as it is, nothing is added. */
TEST(test_nothing_more) {
  double deviation[TILES];
  int passes[TILES];
  for (int n = 0; n < TILES; ++n) {
    deviation[n] = 1;
    passes[n] = n % 2 ? FIRST : 0;
  }
  const struct bake_limits many = {MOST, MOST, 0}, enough = {MOST, MOST, 1};
  assert_int_equal(bake_plan_allocate(&tiles, deviation, &enough, passes, NULL), RESULT_OK);
  for (int n = 0; n < TILES; ++n) assert_int_equal(passes[n], n % 2 ? FIRST : 0);
  assert_int_equal(bake_plan_allocate(&tiles, deviation, &many, passes, NULL), RESULT_OK);
  for (int n = 0; n < TILES; ++n) assert_int_equal(passes[n], n % 2 ? MOST : 0);
}

int main(void) {
  return testing_run(begin, end);
}
