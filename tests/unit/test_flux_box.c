/* test_flux_box.c - the flux on a closed box against Lambert's closed form, and what two
 * pages give twice against the form factor of parallel rectangles. */
#include <string.h>

#include "helpers.h"
#include "oracle/lambert.h"
#include "slab/flux_box.h"

static const int grid[4] = {3, 2, 5, 4};

static struct slab even_slab(const double window[4], double distance) {
  struct slab slab = awkward_slab(grid, distance);
  memcpy(slab.st_window, window, sizeof slab.st_window);
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) slab.rgb[k] = 1 + (float)(k % 3);
  return slab;
}

/* Through the lid alone, the walls alone, both; far to a side; nearly along the aperture. */
TEST(test_even) {
  static const double windows[][4] = {{-0.3, 0.4, -0.2, 0.1}, {-2, 2, -2, 2},   {5, 9, -1, 1},
                                      {-9, -5, 30, 31},       {-50, 50, 0, 40}, {200, 300, -1, 1}};
  for (size_t n = 0; n < sizeof windows / sizeof *windows; ++n) {
    struct slab slab = even_slab(windows[n], INFINITY);
    struct error error = {{0}};
    struct flux_box flux;
    assert_ok(flux_box_measure(&slab, &flux, &error), &error);
    for (int c = 0; c < 3; ++c) {
      double expected = (1 + c) * 0.4 * 0.7 * lambert_window(windows[n]);
      assert_near(flux.box[c] / expected, 1, 1e-2);
      assert_near(flux.aperture[c] / expected, 1, 1e-5);
    }
    assert_true(fabs(flux.difference) <= flux.uncertainty && flux.uncertainty < 0.04);
    slab_free(&slab);
  }
}

/* Coloured samples, negative too, both st planes: as many lumens as slab_flux has. */
TEST(test_colours) {
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
TEST(test_peaks) {
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
TEST(test_twice) {
  static const double wide[4] = {-3, 3, -3, 3}, narrow[4] = {-0.5, 0.5, -3, 3};
  struct slab slab = even_slab(wide, INFINITY), other = even_slab(wide, 2);
  struct error error = {{0}};
  static const double aperture[4] = {-0.2, 0.2, -0.35, 0.35};
  double share,
      expected = lambert_exchange(aperture, aperture, 0.25) / (0.28 * lambert_window(wide));
  for (int c = 0; c < 3; ++c) other.center[c] += 0.25 * slab.normal[c];
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

/* A page of radiance 1, 2 x 2, `ahead` of the first along its normal. */
static struct slab page_ahead(double ahead) {
  static const double window[4] = {-3, 3, -3, 3};
  struct slab slab = slab_default();
  for (int axis = 0; axis < SLAB_AXES; ++axis) slab.samples[axis] = axis < SLAB_S ? 4 : 48;
  memcpy(slab.st_window, window, sizeof window);
  slab.u[0] = slab.v[1] = 2;
  slab.u[1] = slab.u[2] = slab.v[0] = slab.v[2] = 0;
  slab.normal[0] = slab.normal[1] = 0;
  slab.normal[2] = 1;
  slab.center[0] = slab.center[1] = 0;
  slab.center[2] = ahead;
  assert_int_equal(slab_alloc(&slab, NULL), RESULT_OK);
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) slab.rgb[k] = 1;
  return slab;
}

/* Of two pages in a row, what passes both counts once: their sum less Lambert's exchange. */
TEST(test_lamp_counts_once) {
  static const double square[4] = {-1, 1, -1, 1}, window[4] = {-3, 3, -3, 3};
  struct slab pages[2] = {page_ahead(0), page_ahead(2)};
  double flux[3], one = 4 * lambert_window(window);
  for (int count = 1; count <= 2; ++count) {
    double expected = count == 1 ? one : 2 * one - lambert_exchange(square, square, 2);
    assert_int_equal(flux_box_lamp(pages, count, flux, NULL), RESULT_OK);
    for (int c = 0; c < 3; ++c) assert_near(flux[c] / expected, 1, 0.01);
  }
  for (int n = 0; n < 2; ++n) slab_free(&pages[n]);
}

/* Of two channels, in one aperture or one behind the other, all light counts. */
TEST(test_channels_add_up) {
  static const double window[4] = {-3, 3, -3, 3};
  for (int ahead = 0; ahead <= 2; ahead += 2) {
    struct slab pages[2] = {page_ahead(0), page_ahead(ahead)};
    double flux[3];
    strcpy(pages[1].channel, "cold");
    assert_int_equal(flux_box_lamp(pages, 2, flux, NULL), RESULT_OK);
    for (int c = 0; c < 3; ++c) assert_near(flux[c] / (8 * lambert_window(window)), 1, 0.001);
    for (int n = 0; n < 2; ++n) slab_free(&pages[n]);
  }
}

int main(void) {
  return testing_run(NULL, NULL);
}
