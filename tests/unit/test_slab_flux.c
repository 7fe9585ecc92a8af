/* test_slab_flux.c - flux against Lambert's closed form and against brute
 * quadrature of slab_lookup; flux and means under resampling and cropping. */
#include <math.h>
#include <string.h>

#include "helpers.h"
#include "oracle/lambert.h"
#include "oracle/lookup.h"
#include "oracle/random.h"
#include "slab/slab_resample.h"

static const int grids[][4] = {{1, 1, 1, 1}, {2, 3, 4, 5}, {3, 1, 16, 2}, {1, 1, 64, 64}};

TEST(test_constant_infinite) {
  static const double windows[][4] = {
      {-1, 1, -1, 1},         {-1.5, 1.5, -1.5, 1.5}, {-0.2, 3, 0.5, 2},   {-100, 100, -100, 100},
      {-1e6, 1e6, -1e6, 1e6}, {2, 9, -7, -0.01},      {0, 1e-6, 5, 5.0001}};
  for (size_t g = 0; g < 4; ++g)
    for (size_t n = 0; n < 7; ++n) {
      struct slab slab = awkward_slab(grids[g], INFINITY);
      memcpy(slab.st_window, windows[n], sizeof slab.st_window);
      for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) slab.rgb[k] = 1 + (float)(k % 3);
      double flux[3], expected = 0.28 * lambert_window(windows[n]);
      slab_flux(&slab, flux, NULL);
      for (int c = 0; c < 3; ++c) assert_near(flux[c] / (1 + c) / expected, 1, 5e-7);
      slab_free(&slab);
    }
}

/* Whatever the unit of radiance, people read of metres. */
TEST(test_metric) {
  static const char *const units[3][2] = {
      {"W/(sr m2)", "W"}, {"cd/m2", "lm"}, {"relative", "relative m2 sr"}};
  struct slab slab = awkward_slab((const int[]){2, 2, 3, 3}, INFINITY);
  double flux[3], metric[3];
  fill_colours(&slab, 3);
  slab.metres_per_unit = 0.01;
  slab_flux(&slab, flux, NULL);
  for (int k = 0; k < 3; ++k) {
    strcpy(slab.radiance_unit, units[k][0]);
    slab_flux_metric(&slab, metric, NULL);
    assert_string_equal(slab_flux_unit(&slab), units[k][1]);
    for (int c = 0; c < 3; ++c) assert_near(metric[c] / flux[c], 1e-4, 1e-18);
  }
  slab_free(&slab);
}

/* The flux of a lamp of one colour survives LogLuv, channel by channel: its chromaticity is
 * not rounded, its luminance by 0.136 % at most. */
TEST(test_one_colour) {
  uint64_t seed = 2;
  for (int n = 0; n < 40; ++n) {
    struct slab slab = awkward_slab((const int[]){2, 2, 3, 3}, INFINITY);
    double before[3], after[3], colour[3];
    for (int c = 0; c < 3; ++c) colour[c] = pow(random_number(&seed), 2) + 1e-3;
    for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k)
      slab.rgb[k] = (float)(colour[k % 3] * (double)(k / 3 % 7));
    struct slab *back = write_and_load(scratch("one.tif"), &slab, 1, SLAB_PRECISION_LOGLUV);
    slab_flux(&slab, before, NULL), slab_flux(back, after, NULL);
    for (int c = 0; c < 3; ++c) assert_near(after[c] / before[c], 1, 1.4e-3);
    slab_file_free_all(back, 1);
    slab_free(&slab);
  }
}

/* The hemisphere: pi times the area. */
TEST(test_hemisphere) {
  struct slab slab = awkward_slab((const int[]){2, 2, 3, 3}, INFINITY);
  double flux[3];
  for (int k = 0; k < 4; ++k) slab.st_window[k] = k % 2 ? 1e7 : -1e7;
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) slab.rgb[k] = 1;
  slab_flux(&slab, flux, NULL);
  assert_near(flux[0], 3.14159265358979 * 0.28, 1e-6);
  slab_free(&slab);
}

/* Constant radiance through a finite window: the exchange of two parallel rectangles. */
TEST(test_constant_finite) {
  static const double distances[] = {0.1, 0.5, 2, 1e9}, aperture[4] = {-0.2, 0.2, -0.35, 0.35};
  for (size_t g = 0; g < 3; ++g)
    for (size_t d = 0; d < 4; ++d) {
      struct slab slab = awkward_slab(grids[g], distances[d]);
      double window[4], flux[3];
      for (int k = 0; k < 4; ++k) window[k] = slab.st_window[k] * distances[d];
      for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) slab.rgb[k] = 1;
      slab_flux(&slab, flux, NULL);
      assert_near(flux[0] / lambert_exchange(aperture, window, distances[d]), 1, 1e-6);
      slab_free(&slab);
    }
}

/* Midpoint sums on n^4 points, twice, extrapolated. Kinks lie on cell limits
 * when n is a multiple of twice the samples. */
static double brute_flux(const struct slab *slab, int n) {
  const double *w = slab->st_window;
  double kappa = slab_kappa(slab), sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        for (int l = 0; l < n; ++l) {
          double a = 0.4 * ((i + 0.5) / n - 0.5), b = 0.7 * ((j + 0.5) / n - 0.5), rgb[3];
          double s = w[0] + (k + 0.5) / n * (w[1] - w[0]), t = w[2] + (l + 0.5) / n * (w[3] - w[2]);
          double q = 1 + pow(s - kappa * a, 2) + pow(t - kappa * b, 2);
          slab_lookup(slab, a, b, s, t, rgb);
          sum += rgb[1] / (q * q);
        }
  return sum / pow(n, 4) * 0.28 * (w[1] - w[0]) * (w[3] - w[2]);
}

TEST(test_against_lookup) {
  static const int small[][4] = {{1, 1, 1, 1}, {2, 1, 3, 2}, {3, 2, 1, 3}};
  static const double distances[] = {INFINITY, 0.1, 0.5, 3};
  for (size_t g = 0; g < 3; ++g)
    for (size_t d = 0; d < 4; ++d) {
      struct slab slab = awkward_slab(small[g], distances[d]);
      double flux[3];
      fill_colours(&slab, (uint64_t)(g + 3));
      slab_flux(&slab, flux, NULL);
      double coarse = brute_flux(&slab, 12), fine = brute_flux(&slab, 24);
      assert_near(flux[1] / ((4 * fine - coarse) / 3), 1, 2e-5);
      slab_free(&slab);
    }
}

/* Linear in the samples, negative ones too. */
TEST(test_superposition) {
  struct slab a = awkward_slab(grids[1], 0.7), b = awkward_slab(grids[1], 0.7);
  struct slab c = awkward_slab(grids[1], 0.7);
  fill_colours(&a, 1);
  fill_colours(&b, 2);
  for (size_t k = 0; k < 3 * slab_sample_count(&a); ++k) c.rgb[k] = a.rgb[k] - 2 * b.rgb[k];
  double x[3], y[3], z[3];
  slab_flux(&a, x, NULL), slab_flux(&b, y, NULL), slab_flux(&c, z, NULL);
  for (int k = 0; k < 3; ++k) assert_near(z[k], x[k] - 2 * y[k], 1e-8);
  slab_free(&a), slab_free(&b), slab_free(&c);
}

static double mean(const struct slab *slab, int c) {
  double sum = 0;
  size_t count = slab_sample_count(slab);
  for (size_t k = 0; k < count; ++k) sum += (double)slab->rgb[3 * k + (size_t)c];
  return sum / (double)count;
}

/* Any ratio of reduction keeps the mean: an odd last cell weighs by its area. */
TEST(test_reduction_keeps_energy) {
  static const int to[][4] = {{1, 1, 1, 1}, {2, 3, 4, 3}, {5, 2, 6, 1}, {3, 5, 7, 2}};
  struct slab slab = awkward_slab((const int[]){5, 6, 7, 3}, 2);
  struct error error = {{0}};
  fill_colours(&slab, 8);
  for (size_t n = 0; n < 4; ++n) {
    struct slab small = {0};
    assert_ok(slab_resample(&slab, to[n], &small, &error), &error);
    assert_memory_equal(small.samples, to[n], sizeof small.samples);
    for (int c = 0; c < 3; ++c) assert_near(mean(&small, c), mean(&slab, c), 2e-7);
    slab_free(&small);
  }
  slab_free(&slab);
}

/* 5 cells to 2: the middle one counts half in each. */
TEST(test_reduction_by_share) {
  struct slab slab = awkward_slab((const int[]){1, 1, 5, 1}, 2), small = {0};
  struct error error = {{0}};
  for (int k = 0; k < 5; ++k) slab.rgb[3 * k] = (float)(1 << k);
  assert_ok(slab_resample(&slab, (const int[]){1, 1, 2, 1}, &small, &error), &error);
  assert_near((double)small.rgb[0], (1 + 2 + 2) / 2.5, 1e-6);
  assert_near((double)small.rgb[3], (2 + 8 + 16) / 2.5, 1e-6);
  slab_free(&small);
  /* 2x2 blocks of uv are the paper's next level. */
  struct slab views = awkward_slab((const int[]){4, 4, 3, 2}, 2);
  fill_colours(&views, 3);
  assert_ok(slab_resample(&views, (const int[]){2, 2, 3, 2}, &small, &error), &error);
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int n = 0; n < 4; ++n) sum += (double)slab_at(&views, 2 + n % 2, n / 2, k, 1)[c];
      assert_near((double)slab_at(&small, 1, 0, k, 1)[c], sum / 4, 1e-7);
    }
  slab_free(&small);
  slab_free(&views);
  slab_free(&slab);
}

/* Enlarging interpolates: new samples are the oracle's values there. */
TEST(test_enlargement) {
  struct slab slab = awkward_slab((const int[]){2, 3, 2, 1}, 2), large = {0};
  struct error error = {{0}};
  fill_colours(&slab, 6);
  assert_ok(slab_resample(&slab, (const int[]){5, 4, 6, 3}, &large, &error), &error);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 6; ++k)
        for (int l = 0; l < 3; ++l) {
          const double at[4] = {((i + 0.5) / 5 - 0.5) * 0.4, ((j + 0.5) / 4 - 0.5) * 0.7,
                                -0.3 + (k + 0.5) / 6 * 1.4, 0.2 + (l + 0.5) / 3 * 0.7};
          double rgb[3];
          oracle_lookup(&slab, at, rgb);
          for (int c = 0; c < 3; ++c)
            assert_near((double)slab_at(&large, i, j, k, l)[c], rgb[c], 3e-7);
        }
  slab_free(&large);
  slab_free(&slab);
}

/* A ray through the cropped part sees the same sample, both st planes. */
TEST(test_crop) {
  static const double distances[] = {INFINITY, 0.3};
  const int first[4] = {2, 1, 2, 1}, end[4] = {5, 2, 7, 3}; /* off-centre in u and v */
  for (int d = 0; d < 2; ++d) {
    struct slab slab = awkward_slab((const int[]){5, 2, 8, 4}, distances[d]), part = {0};
    struct error error = {{0}};
    fill_colours(&slab, 12);
    assert_ok(slab_crop(&slab, first, end, &part, &error), &error);
    assert_ok(slab_check(&part, &error), &error);
    double kappa = slab_kappa(&slab);
    for (int i = first[0]; i < end[0]; ++i)
      for (int j = first[1]; j < end[1]; ++j)
        for (int k = first[2]; k < end[2]; ++k)
          for (int l = first[3]; l < end[3]; ++l) {
            double a = slab_position(&slab, 0, i), b = slab_position(&slab, 1, j);
            double s = slab_position(&slab, 2, k), t = slab_position(&slab, 3, l);
            const double up[3] = {0.6, 0, 0.8}, vp[3] = {0, 1, 0};
            double origin[3], direction[3], abst[4], rgb[3];
            for (int c = 0; c < 3; ++c) {
              origin[c] = slab.center[c] + a * up[c] + b * vp[c];
              direction[c] = slab.normal[c] + (s - kappa * a) * up[c] + (t - kappa * b) * vp[c];
            }
            assert_true(slab_ray(&part, origin, direction, abst));
            slab_lookup(&part, abst[0], abst[1], abst[2], abst[3], rgb);
            for (int c = 0; c < 3; ++c)
              assert_near(rgb[c], (double)slab_at(&slab, i, j, k, l)[c], 1e-6);
          }
    slab_free(&part);
    assert_refused(slab_crop(&slab, first, (const int[]){4, 3, 7, 3}, &part, &error), &error,
                   "crop v", NULL);
    slab_free(&slab);
  }
}

int main(void) {
  return testing_run(NULL, NULL);
}
