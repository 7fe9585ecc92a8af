/* test_slab_accuracy.c - what a slab says of its own error, against lamps whose radiance is
 * known everywhere: the irradiance by exact means over cells, interpolated, and by the lamp.
 * That these come out within a factor of 2 guards the estimate against changes. It doesn't say
 * that all lamps do (slab_accuracy.c tells how many did): with a radius of 0.6 instead of 0.65,
 * the edge is told 0.48 of its error from 16 apertures. */
#include <math.h>
#include <string.h>

#include "bench/lamp.h"
#include "file/slab_json.h"
#include "helpers.h"
#include "oracle/random.h"
#include "slab/plane.h"
#include "slab/slab_accuracy.h"
#include "slab/slab_sharpen_gain.h"

enum {
  RECEIVERS = 24,   /* along a side */
  POINTS = 72,      /* of the aperture, along a side */
  BAR_POINTS = 120, /* so that the bars of the paper's lamp, 1 % of it wide, are not missed */
  CELL_POINTS = 120 /* of a cell */
};

typedef double radiance(double a, double b, double s, double t);

/* Apertures are 1 wide, windows +-1.5. */
static double gauss(double x, double sigma) {
  return exp(-x * x / (2 * sigma * sigma));
}

static double lobe(double a, double b, double s, double t) {
  return (1 + 0.4 * a - 0.6 * b * b) * gauss(s, 0.5) * gauss(t - 0.2, 0.6);
}

static double peak(double a, double b, double s, double t) {
  return gauss(s + 0.5 * a, 0.07) * gauss(t + 0.5 * b, 0.07);
}

static double edge(double a, double b, double s, double t) {
  return hypot(s + 0.05 * a, t + 0.1 * b) < 0.65 && hypot(a, b) < 0.48 ? 1 : 0;
}

static double paper(double a, double b, double s, double t) {
  return lamp_radiance(lamp_aperture * a, lamp_aperture * b, s, t);
}

static struct slab slab_of(radiance *lamp, int uv, int st) {
  static const double middle[4] = {0.5, 0.5, 0.5, 0.5};
  struct slab slab = slab_default();
  struct error error = {{0}};
  const double window[4] = {-1.5, 1.5, -1.5, 1.5};
  const int samples[4] = {uv, uv, st, st};
  memcpy(slab.st_window, window, sizeof window);
  memcpy(slab.samples, samples, sizeof samples);
  assert_ok(slab_alloc(&slab, &error), &error);
  double points[CELL_POINTS][4];
  for (int p = 0; p < CELL_POINTS && lamp; ++p)
    for (int c = 0; c < 4; ++c)
      if (p % 2) /* so that their mean is the cell's middle */
        points[p][c] = 1 - points[p - 1][c];
      else if (c == 0)
        lamp_point(p, middle, points[p]);
  for (size_t n = 0; n < slab_sample_count(&slab) && lamp; ++n) {
    int at[4];
    double x[4], sum = 0;
    slab_locate(&slab, n, at);
    for (int p = 0; p < CELL_POINTS; ++p) {
      for (int axis = 0; axis < 4; ++axis)
        x[axis] = slab_position(&slab, axis, at[axis]) +
                  (points[p][axis] - 0.5) * slab_spacing(&slab, axis);
      sum += lamp(x[0], x[1], x[2], x[3]);
    }
    for (size_t c = 0; c < 3; ++c) slab.rgb[3 * n + c] = (float)(sum / CELL_POINTS);
  }
  return slab;
}

/* Mean of L cos^4 over the aperture, at a receiver that the slopes x and y from the centre
 * lead to; by the lamp, or where it is NULL by the slab. */
static double lit(radiance *lamp, const struct slab *slab, double x, double y, double distance,
                  int points) {
  double sum = 0;
  for (int j = 0; j < points; ++j)
    for (int i = 0; i < points; ++i) {
      double a = (i + 0.5) / points - 0.5, b = (j + 0.5) / points - 0.5;
      double s = x - a / distance, t = y - b / distance, r = 1 + s * s + t * t, rgb[3] = {0};
      if (fabs(s) > 1.5 || fabs(t) > 1.5) continue;
      if (lamp)
        rgb[0] = lamp(a, b, s, t);
      else
        slab_lookup(slab, a, b, s, t, rgb);
      sum += rgb[0] / (r * r);
    }
  return sum / (points * points);
}

/* RMS of the difference over the RMS, on the part of the floor that lamps here light. */
static double true_error(radiance *lamp, const struct slab *clean, const struct slab *slab,
                         double distance) {
  double wrong = 0, all = 0;
  int points = lamp == paper ? BAR_POINTS : POINTS;
  for (int n = 0; n < RECEIVERS * RECEIVERS; ++n) {
    double wide = 1.2 + 0.5 / distance;
    double x = ((n % RECEIVERS + fmod(n * 0.618034, 1)) / RECEIVERS * 2 - 1) * wide;
    double y = ((n / RECEIVERS + fmod(n * 0.754878, 1)) / RECEIVERS * 2 - 1) * wide;
    double e = lit(lamp, clean, x, y, distance, points);
    double by_slab = lit(NULL, slab, x, y, distance, points);
    wrong += (by_slab - e) * (by_slab - e);
    all += e * e;
  }
  return sqrt(wrong / all);
}

static void estimate(const struct slab *slab, int count, const double *distances,
                     struct slab_accuracy *accuracy) {
  struct slab_sampling sampling = sampling_of(slab);
  struct error error;
  assert_ok(slab_accuracy_estimate(slab, &sampling, count, distances, accuracy, &error), &error);
}

static void check_lamp(const char *name, radiance *lamp, int uv, int st) {
  struct slab slab = slab_of(lamp, uv, st);
  struct slab_accuracy floors[SLAB_ACCURACY_DISTANCES];
  estimate(&slab, SLAB_ACCURACY_DISTANCES, slab_accuracy_apertures, floors);
  for (int n = 0; n < SLAB_ACCURACY_DISTANCES; ++n) {
    double truth = true_error(lamp, NULL, &slab, slab_accuracy_apertures[n]);
    print_message("# %s, %g apertures: %.3g %% estimated, %.3g %% true\n", name,
                  slab_accuracy_apertures[n], 100 * floors[n].all, 100 * truth);
    assert_true(isnan(floors[n].noise));
    assert_true(floors[n].all > truth / 2 && floors[n].all < truth * 2);
  }
  slab_free(&slab);
}

TEST(test_lobe) {
  check_lamp("smooth lobe", lobe, 8, 32);
}

TEST(test_peak) {
  check_lamp("thin peak", peak, 8, 32);
}

TEST(test_edge) {
  check_lamp("edge", edge, 8, 32);
}

TEST(test_paper) {
  check_lamp("the paper's lamp", paper, 16, 32);
}

/* A sharpened slab errs less, and says so. */
TEST(test_sharpened) {
  struct slab slab = slab_of(lobe, 8, 32);
  struct slab_accuracy before, after;
  struct error error = {{0}};
  const double distance = 4;
  estimate(&slab, 1, &distance, &before);
  assert_ok(slab_sharpen(&slab, SLAB_SHARPEN_EXACT, &error), &error);
  assert_ok(slab_json_record_sharpening(&slab, SLAB_SHARPEN_EXACT, &error), &error);
  estimate(&slab, 1, &distance, &after);
  double truth = true_error(lobe, NULL, &slab, distance);
  assert_true(after.all < before.all / 5);
  assert_true(after.all > truth / 2 && after.all < truth * 2);
  slab_free(&slab);
}

/* A thin beam whose directions spread over the aperture: its blurs along s and u cancel in part. */
static double spread(double a, double b, double s, double t) {
  return fabs(s - 0.3 * a) < 0.05 && fabs(t - 0.3 * b) < 0.05 ? 1 : 0;
}

/* The largest of the true errors of a sharpened slab over those of the slab itself; *gain is what
 * was to be expected. */
static double sharpen_truly(radiance *lamp, double *gain) {
  struct slab slab = slab_of(lamp, 8, 32);
  struct slab_sampling sampling = sampling_of(&slab);
  struct error error = {{0}};
  double before[SLAB_ACCURACY_DISTANCES], worst = 0;
  assert_ok(slab_sharpen_gain(&slab, &sampling, SLAB_SHARPEN_EXACT, gain, &error), &error);
  for (int n = 0; n < SLAB_ACCURACY_DISTANCES; ++n)
    before[n] = true_error(lamp, NULL, &slab, slab_accuracy_apertures[n]);
  assert_ok(slab_sharpen(&slab, SLAB_SHARPEN_EXACT, &error), &error);
  for (int n = 0; n < SLAB_ACCURACY_DISTANCES; ++n)
    worst = fmax(worst, true_error(lamp, NULL, &slab, slab_accuracy_apertures[n]) / before[n]);
  print_message("# sharpened: %.2g times the error expected, %.2g true\n", *gain, worst);
  slab_free(&slab);
  return worst;
}

/* What is smooth becomes better by it; what would become worse is known beforehand. */
TEST(test_sharpening_that_pays) {
  double gain;
  assert_true(sharpen_truly(lobe, &gain) < 0.5);
  assert_true(gain < slab_sharpen_pays);
  assert_true(sharpen_truly(spread, &gain) > 1);
  assert_true(gain > slab_sharpen_pays);
}

/* Noise of known size, independent from sample to sample; and some that all share. */
TEST(test_noise) {
  struct slab clean = slab_of(NULL, 8, 32), noisy = slab_of(NULL, 8, 32);
  struct error error = {{0}};
  struct slab_accuracy floors[2];
  const double distances[2] = {1, 8};
  uint64_t seed = 9;
  for (size_t n = 0; n < slab_sample_count(&clean); ++n)
    for (size_t c = 0; c < 3; ++c) {
      clean.rgb[3 * n + c] = 1;
      noisy.rgb[3 * n + c] =
          c ? noisy.rgb[3 * n] : (float)(1 + sqrt(12) * 0.3 * random_between(&seed, -0.5, 0.5));
    }
  const char *stated = "{\"noise\": {\"sample\": 0.3, \"flux\": 0}}";
  assert_ok(slab_json_set(&noisy, "provenance", stated, &error), &error);
  estimate(&noisy, 2, distances, floors);
  for (int n = 0; n < 2; ++n) {
    double truth = true_error(NULL, &clean, &noisy, distances[n]);
    assert_near(floors[n].noise / truth, 1, 0.35);
  }
  const char *shared = "{\"noise\": {\"sample\": 0, \"flux\": 0.25}}";
  assert_ok(slab_json_set(&clean, "provenance", shared, &error), &error);
  estimate(&clean, 2, distances, floors);
  assert_near(floors[0].noise, 0.25, 1e-6);
  assert_near(floors[0].all, 0.25, 1e-6);
  assert_near(floors[0].st, 0, 1e-6);
  slab_free(&clean), slab_free(&noisy);
}

/* Whatever the unit of length and of light. */
TEST(test_units) {
  struct slab small = slab_of(lobe, 4, 8), large = slab_of(lobe, 4, 8);
  struct slab_accuracy floors[2];
  for (size_t n = 0; n < 3 * slab_sample_count(&large); ++n) large.rgb[n] *= 1e6F;
  for (int c = 0; c < 3; ++c) large.u[c] *= 1e-3, large.v[c] *= 1e-3, large.center[c] = 7;
  assert_near(plane_width(&large), 1e-3, 1e-18);
  for (int d = 0; d < 2; ++d) {
    double distance = d ? 3 : 0.5, scaled = 1e-3 * distance;
    small.st_distance = d ? 3 : INFINITY; /* at 3, every point sees one sample of st */
    large.st_distance = d ? scaled : INFINITY;
    estimate(&small, 1, &distance, &floors[0]);
    estimate(&large, 1, &scaled, &floors[1]);
    assert_true(floors[0].all > 0 && isfinite(floors[0].all));
    assert_near(floors[1].st / floors[0].st, 1, 1e-4);
    assert_near(floors[1].uv / floors[0].uv, 1, 1e-4);
    assert_near(floors[1].all / floors[0].all, 1, 1e-4);
  }
  slab_free(&small), slab_free(&large);
}

/* Nothing to halve, nothing to see, light at the very border. */
TEST(test_corners) {
  static const int grids[][4] = {
      {1, 1, 1, 1}, {1, 1, 16, 16}, {5, 4, 1, 3}, {1, 9, 2, 31}, {3, 3, 3, 3}};
  struct slab_accuracy floors[SLAB_ACCURACY_DISTANCES];
  for (int g = 0; g < 5; ++g)
    for (int light = 0; light < 3; ++light) {
      struct slab slab = awkward_slab(grids[g], g % 2 ? 0.7 : INFINITY);
      if (light == 1) fill_colours(&slab, 3);
      if (light == 2) slab.rgb[3 * slab_sample_count(&slab) - 2] = -1;
      estimate(&slab, SLAB_ACCURACY_DISTANCES, slab_accuracy_apertures, floors);
      bool st = grids[g][2] > 3 || grids[g][3] > 3, uv = grids[g][0] > 3 || grids[g][1] > 3;
      for (int n = 0; n < SLAB_ACCURACY_DISTANCES; ++n) {
        assert_int_equal(isnan(floors[n].st), !st);
        assert_int_equal(isnan(floors[n].uv), !uv);
        assert_int_equal(isnan(floors[n].all), !st && !uv);
        if (!light && (st || uv)) assert_near(floors[n].all, 0, 0);
      }
      slab_free(&slab);
    }
}

int main(void) {
  return testing_run(NULL, NULL);
}
