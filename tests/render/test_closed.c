/* test_closed.c - the other methods of `renderslab irradiance` against
 * `reference` (which test_reference holds against the oracle): the closed form
 * to the digits printed, one sample a micro light within what it promises. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "helpers.h"
#include "oracle/oracle.h"

enum { COUNT = 400, FEW = 24, SEEDS = 64 };

static const double ordinary[4] = {-0.7, 1.1, -0.9, 0.6}, wide[4] = {-5, 5, -5, 5};
static const double lamp[4] = {-1.5, 1.5, -1.5, 1.5}, sliver[4] = {-3, 4, 0.1, 0.1001};

/* ---- The closed form. */

struct family {
  const char *name;
  int samples[SLAB_AXES];
  const double *window;
  double distance, z[2];
  enum frame frame;
};

static const struct family families[] = {
    {"ordinary", {8, 8, 16, 16}, ordinary, INFINITY, {0.02, 1000}, FRAME_TURNED},
    {"finite st", {6, 7, 9, 8}, ordinary, 0.7, {0.02, 100}, FRAME_MIRRORED},
    {"coarse st", {5, 4, 2, 3}, wide, INFINITY, {0.02, 100}, FRAME_TURNED},
    {"coarse finite st", {3, 4, 2, 2}, wide, 2, {0.02, 1.99}, FRAME_TURNED},
    {"1-wide uv", {1, 1, 5, 6}, wide, INFINITY, {1e-6, 1000}, FRAME_TURNED},
    {"1-wide st", {5, 6, 1, 1}, wide, INFINITY, {1e-6, 1000}, FRAME_MIRRORED},
    {"1-wide all, finite", {1, 1, 1, 1}, wide, 0.5, {1e-6, 1000}, FRAME_TURNED},
    {"1-wide u and t", {1, 7, 7, 1}, ordinary, 1, {0.01, 10}, FRAME_TURNED},
    {"slivers of st", {3, 3, 2, 9}, sliver, INFINITY, {0.02, 100}, FRAME_TURNED},
};
enum { FAMILIES = sizeof families / sizeof families[0] };

static void aim_all(const struct slab *slab, const double z[2], int count, uint64_t seed,
                    struct surfel receivers[]) {
  aim(slab, z, RECEIVER_KINDS, &seed, receivers, count);
}

/* Beyond half of the last of nine digits, in each of the two. */
static double off(double a, double b) {
  if (a == b) return 0;
  double one = pow(10, floor(log10(fmax(fabs(a), fabs(b)))) - 8);
  return larger(0, fabs(a - b) - one) / fabs(b);
}

TEST(test_closed) {
  int failed = 0;
  for (int f = 0; f < FAMILIES; ++f) {
    const struct family *family = &families[f];
    struct slab slab = rough_slab(family->samples, family->distance, family->window, family->frame,
                                  FILL_EXTREME, (uint64_t)f + 2);
    static struct surfel receivers[COUNT];
    static double closed[COUNT][3], reference[COUNT][3];
    double worst = 0, oracle = 0;
    int dark = 0;
    aim_all(&slab, family->z, COUNT, (uint64_t)f + 10, receivers);
    const char *light = write_light("closed.exr", &slab, 1);
    irradiance(receivers, COUNT, closed, "--light '%s' --method closed", light);
    irradiance(receivers, COUNT, reference, "--light '%s' --method reference --tolerance 1e-10",
               light);
    for (int k = 0; k < COUNT; ++k) {
      for (int c = 0; c < 3; ++c) worst = larger(worst, off(closed[k][c], reference[k][c]));
      dark += reference[k][0] + reference[k][1] + reference[k][2] == 0;
      if (k >= FEW) continue;
      struct oracle_value value = oracle_irradiance(&slab, receivers[k].p, receivers[k].n);
      for (int c = 0; c < 3; ++c) oracle = larger(oracle, off(closed[k][c], (double)value.e[c]));
    }
    print_message("%-20s closed - reference %.1e, - oracle %.1e, %d of %d dark\n", family->name,
                  worst, oracle, dark, COUNT);
    failed += !(worst <= 1e-9) || !(oracle <= 1e-9) || dark > COUNT / 2;
    slab_free(&slab);
  }
  assert_int_equal(failed, 0);
}

/* ---- One sample a micro light, on the paper's usual slab. */

TEST(test_one_sample) {
  static const double distances[] = {INFINITY, 2}, z[2][2] = {{0.5, 8}, {0.3, 1.5}};
  static struct surfel receivers[COUNT];
  static double reference[COUNT][3], pi[COUNT][3], midpoint[COUNT][3], paper[COUNT][3];
  for (int d = 0; d < 2; ++d) {
    struct slab slab = rough_slab((const int[]){16, 16, 64, 64}, distances[d], lamp, FRAME_TURNED,
                                  FILL_UNIFORM, 5);
    aim_all(&slab, z[d], COUNT, 6, receivers);
    const char *light = write_light("usual.exr", &slab, 1);
    irradiance(receivers, COUNT, reference, "--light '%s' --method reference", light);
    irradiance(receivers, COUNT, pi, "--light '%s' --method pi", light);
    irradiance(receivers, COUNT, midpoint, "--light '%s' --method midpoint", light);
    irradiance(receivers, COUNT, paper, "--light '%s' --method paper --seed 1", light);
    double by_pi = relative_rms(pi, reference, COUNT),
           by_paper = relative_rms(paper, reference, COUNT);
    double by_midpoint = relative_rms(midpoint, reference, COUNT);
    print_message("relative RMSE: pi %.1e, midpoint %.1e, paper %.1e\n", by_pi, by_midpoint,
                  by_paper);
    assert_true(by_pi <= 2e-3);
    assert_true(by_paper >= 10 * by_pi);
    assert_true(by_midpoint <= by_paper);
    slab_free(&slab);
  }
}

/* The random samples' mean is the integral: 64 seeds, within 4 standard errors. */
TEST(test_paper_mean) {
  static const double distances[] = {INFINITY, 0.7}, z[2] = {0.05, 20};
  static double reference[FEW][3], paper[SEEDS][FEW][3];
  struct surfel receivers[FEW];
  for (int d = 0; d < 2; ++d) {
    struct slab slab = rough_slab((const int[]){4, 5, 8, 6}, distances[d], ordinary, FRAME_TURNED,
                                  FILL_EXTREME, 7);
    double largest = 0;
    int seen = 0;
    aim_all(&slab, z, FEW, 8, receivers);
    const char *light = write_light("mean.exr", &slab, 1);
    irradiance(receivers, FEW, reference, "--light '%s' --method reference", light);
    for (int s = 0; s < SEEDS; ++s)
      irradiance(receivers, FEW, paper[s], "--light '%s' --method paper --seed %d", light, s + 1);
    for (int k = 0; k < FEW; ++k) {
      double mean = 0, square = 0, exact = reference[k][1];
      for (int s = 0; s < SEEDS; ++s) mean += paper[s][k][1] / SEEDS;
      for (int s = 0; s < SEEDS; ++s) square += pow(paper[s][k][1] - mean, 2) / (SEEDS - 1);
      double error = sqrt(square / SEEDS);
      if (exact == 0) assert_true(mean == 0);
      if (error > 1e-6 * exact) largest = larger(largest, fabs(mean - exact) / error);
      seen += error > 1e-6 * exact;
    }
    print_message("paper's mean of %d seeds: %.2f standard errors at most, %d receivers\n", SEEDS,
                  largest, seen);
    assert_true(seen > FEW / 2);
    assert_true(largest <= 4);
    slab_free(&slab);
  }
}

/* ---- The same bits. */

TEST(test_seeds) {
  static const double z[2] = {0.1, 5};
  double first[FEW][3], again[FEW][3], other[FEW][3];
  struct surfel receivers[FEW];
  struct slab slab =
      rough_slab((const int[]){4, 5, 8, 6}, INFINITY, ordinary, FRAME_TURNED, FILL_EXTREME, 7);
  aim_all(&slab, z, FEW, 8, receivers);
  const char *light = write_light("seeds.exr", &slab, 1);
  irradiance(receivers, FEW, first, "--light '%s' --method paper --seed 5", light);
  irradiance(receivers, FEW, again, "--light '%s' --method paper --seed 5", light);
  irradiance(receivers, FEW, other, "--light '%s' --method paper --seed 6", light);
  assert_memory_equal(first, again, sizeof first);
  int lit = 0, differ = 0;
  for (int k = 0; k < FEW; ++k) {
    lit += first[k][0] > 0;
    differ += first[k][0] != other[k][0];
  }
  assert_true(lit > FEW / 2);
  assert_true(differ >= lit - 1);
  slab_free(&slab);
}

TEST(test_threads) {
  static const char *const methods[] = {"reference", "closed", "pi", "midpoint", "paper", "auto"};
  static const int threads[] = {2, 3, 7};
  static const double z[2] = {0.1, 5};
  static struct surfel receivers[COUNT];
  static double one[COUNT][3], more[COUNT][3];
  struct slab slab =
      rough_slab((const int[]){4, 5, 8, 6}, 0.7, ordinary, FRAME_TURNED, FILL_EXTREME, 7);
  aim_all(&slab, z, COUNT, 9, receivers);
  const char *light = write_light("threads.exr", &slab, 1);
  for (int m = 0; m < 6; ++m) {
    irradiance(receivers, COUNT, one, "--light '%s' --method %s --threads 1", light, methods[m]);
    for (int t = 0; t < 3; ++t) {
      irradiance(receivers, COUNT, more, "--light '%s' --method %s --threads %d", light, methods[m],
                 threads[t]);
      assert_memory_equal(one, more, sizeof one);
    }
  }
  slab_free(&slab);
}

int main(void) {
  return testing_run(NULL, NULL);
}
