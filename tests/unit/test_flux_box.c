/* test_flux_box.c - the flux on a closed box against Lambert's closed form, and what two
 * pages give twice against the form factor of parallel rectangles. */
#include <math.h>
#include <string.h>

#include "helpers.h"
#include "slab/flux_box.h"

/* int int 1/(1 + x^2 + y^2)^2 over [0,x] x [0,y]: Lambert's corner sum. */
static double corner(double x, double y) {
  double cx = sqrt(1 + x * x), cy = sqrt(1 + y * y);
  return (x / cx * atan(y / cx) + y / cy * atan(x / cy)) / 2;
}

static double window_sum(const double w[4]) {
  return corner(w[1], w[3]) - corner(w[0], w[3]) - corner(w[1], w[2]) + corner(w[0], w[2]);
}

static const int grid[4] = {3, 2, 5, 4};

static struct slab even_slab(const double window[4], double distance) {
  struct slab slab = awkward_slab(grid, distance);
  memcpy(slab.st_window, window, sizeof slab.st_window);
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) slab.rgb[k] = 1 + (float)(k % 3);
  return slab;
}

/* Through the lid alone, the walls alone, both; far to a side; nearly along the aperture. */
static void test_even(void **state) {
  (void)state;
  static const double windows[][4] = {{-0.3, 0.4, -0.2, 0.1}, {-2, 2, -2, 2},   {5, 9, -1, 1},
                                      {-9, -5, 30, 31},       {-50, 50, 0, 40}, {200, 300, -1, 1}};
  for (size_t n = 0; n < sizeof windows / sizeof *windows; ++n) {
    struct slab slab = even_slab(windows[n], INFINITY);
    struct error error = {{0}};
    struct flux_box flux;
    assert_ok(flux_box_measure(&slab, &flux, &error), &error);
    for (int c = 0; c < 3; ++c) {
      double expected = (1 + c) * 0.4 * 0.7 * window_sum(windows[n]);
      assert_near(flux.box[c] / expected, 1, 1e-2);
      assert_near(flux.aperture[c] / expected, 1, 1e-5);
    }
    assert_true(fabs(flux.difference) <= flux.uncertainty && flux.uncertainty < 0.04);
    slab_free(&slab);
  }
}

/* Coloured samples, negative too, both st planes: as many lumens as slab_flux has. */
static void test_colours(void **state) {
  (void)state;
  static const double distances[] = {INFINITY, 3, 0.4};
  for (size_t d = 0; d < 3; ++d) {
    struct slab slab = awkward_slab(grid, distances[d]);
    struct error error = {{0}};
    struct flux_box flux;
    fill_colours(&slab, 5);
    for (size_t k = 0; k < 3 * slab_sample_count(&slab); k += 4) slab.rgb[k] *= -0.5F;
    assert_ok(flux_box_measure(&slab, &flux, &error), &error);
    assert_true(fabs(flux.difference) <= flux.uncertainty && flux.uncertainty < 0.02);
    for (int c = 0; c < 3; ++c) assert_near(flux.box[c] / flux.aperture[c], 1, 0.01);
    slab_free(&slab);
  }
}

/* A sample that shines alone is found; dark ones are no light; a peak that the points miss
 * next to faint light is not taken for lost. */
static void test_peaks(void **state) {
  (void)state;
  struct slab slab = awkward_slab((const int[]){16, 16, 32, 32}, INFINITY);
  struct error error = {{0}};
  struct flux_box flux;
  assert_ok(flux_box_measure(&slab, &flux, &error), &error);
  assert_true(flux.difference == 0 && flux.uncertainty == 0);
  slab_at(&slab, 3, 15, 7, 0)[1] = 40;
  assert_ok(flux_box_measure(&slab, &flux, &error), &error);
  assert_true(fabs(flux.difference) <= flux.uncertainty && flux.uncertainty < 0.02);
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) slab.rgb[k] += 1e-12F;
  assert_ok(flux_box_measure(&slab, &flux, &error), &error);
  assert_true(isinf(flux.uncertainty));
  slab_free(&slab);
}

/* A page whose light goes through another one in front of it, in part. */
static void test_twice(void **state) {
  (void)state;
  static const double wide[4] = {-3, 3, -3, 3}, narrow[4] = {-0.5, 0.5, -3, 3};
  enum { N = 40 };
  struct slab slab = even_slab(wide, INFINITY), other = even_slab(wide, 2);
  struct error error = {{0}};
  double share, expected = 0;
  for (int c = 0; c < 3; ++c) other.center[c] += 0.25 * slab.normal[c];
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      double a = 0.4 * ((i + 0.5) / N - 0.5), b = 0.7 * ((j + 0.5) / N - 0.5);
      const double seen[4] = {(-0.2 - a) / 0.25, (0.2 - a) / 0.25, (-0.35 - b) / 0.25,
                              (0.35 - b) / 0.25};
      expected += window_sum(seen) / window_sum(wide) / N / N;
    }
  assert_ok(flux_box_twice(&slab, &other, &share, &error), &error);
  assert_near(share, expected, 3e-3);
  /* Not inside the other's window; not backwards; not beside; side by side; in one place. */
  memcpy(other.st_window, narrow, sizeof narrow);
  double less;
  assert_ok(flux_box_twice(&slab, &other, &less, &error), &error);
  assert_true(less > 0.1 && less < 0.9 * share);
  assert_ok(flux_box_twice(&other, &slab, &share, &error), &error);
  assert_true(share == 0);
  for (int c = 0; c < 3; ++c) other.center[c] = slab.center[c] + slab.u[c];
  assert_ok(flux_box_twice(&slab, &other, &share, &error), &error);
  assert_near(share, 0, 1e-3);
  memcpy(other.center, slab.center, sizeof slab.center);
  memcpy(other.st_window, wide, sizeof wide);
  other.st_distance = INFINITY;
  assert_ok(flux_box_twice(&slab, &other, &share, &error), &error);
  assert_near(share, 1, 1e-9);
  for (int c = 0; c < 3; ++c) other.normal[c] = -slab.normal[c];
  assert_ok(flux_box_twice(&slab, &other, &share, &error), &error);
  assert_true(share == 0);
  slab_free(&slab);
  slab_free(&other);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_even), cmocka_unit_test(test_colours),
                                     cmocka_unit_test(test_peaks), cmocka_unit_test(test_twice)};
  return cmocka_run_group_tests_name("flux on a box", tests, NULL, NULL);
}
