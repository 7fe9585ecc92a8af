/* test_cluster.c - fitting a slab by lights: what must be exact, and what is known. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "helpers.h"
#include "include/cluster/cluster.h"
#include "include/cluster/nnls.h"
#include "include/cluster/parallelogram.h"
#include "include/point/point.h"
#include "oracle/random.h"
#include "slab/plane.h"

static const double pi = 3.14159265358979323846;

static struct slab plain_slab(int uv, int st, double slope) {
  struct slab slab = slab_default();
  const int samples[SLAB_AXES] = {uv, uv, st, st};
  const double window[4] = {-slope, slope, -slope, slope};
  memcpy(slab.samples, samples, sizeof samples);
  memcpy(slab.st_window, window, sizeof window);
  slab.u[0] = slab.v[2] = 2;
  slab.u[1] = slab.u[2] = slab.v[0] = slab.v[1] = 0;
  slab.normal[0] = slab.normal[2] = 0;
  slab.normal[1] = -1;
  assert_int_equal(slab_alloc(&slab, NULL), RESULT_OK);
  return slab;
}

static void fill(struct slab *slab, double (*radiance)(const double abst[4], int channel)) {
  for (size_t k = 0; k < slab_sample_count(slab); ++k) {
    int at[SLAB_AXES];
    double abst[4];
    slab_locate(slab, k, at);
    for (int axis = 0; axis < SLAB_AXES; ++axis) abst[axis] = slab_position(slab, axis, at[axis]);
    for (int c = 0; c < 3; ++c) slab->rgb[3 * k + (size_t)c] = (float)radiance(abst, c);
  }
}

static struct cluster fit(const struct slab *slab, int lights) {
  struct cluster cluster;
  struct error error;
  assert_ok(cluster_make(slab, 1, &(struct cluster_wish){.lights = lights, .distance = 4}, &cluster,
                         &error),
            &error);
  return cluster;
}

/* ---- Parallelograms ---- */

/* Positive: edge[1] is counterclockwise of edge[0]. */
static double area_of(const struct parallelogram *p) {
  return p->edge[0][0] * p->edge[1][1] - p->edge[0][1] * p->edge[1][0];
}

/* Whether all points lie in it, by their coordinates along its edges. */
static void assert_holds(const struct parallelogram *p, double (*points)[2], int count) {
  double d = area_of(p);
  for (int k = 0; k < count; ++k) {
    double x = points[k][0] - p->center[0], y = points[k][1] - p->center[1];
    assert_near((x * p->edge[1][1] - y * p->edge[1][0]) / d, 0, 0.5 + 1e-9);
    assert_near((y * p->edge[0][0] - x * p->edge[0][1]) / d, 0, 0.5 + 1e-9);
  }
}

/* Of random points, against all pairs of directions on a fine grid; none may be smaller. */
TEST(test_parallelogram) {
  enum { COUNT = 12, DIRECTIONS = 180 };
  uint64_t seed = 5;
  for (int trial = 0; trial < 20; ++trial) {
    double points[COUNT][2], widths[DIRECTIONS], least = INFINITY;
    for (int k = 0; k < COUNT; ++k)
      for (int c = 0; c < 2; ++c) points[k][c] = random_number(&seed) * (c ? 0.3 : 1);
    for (int d = 0; d < DIRECTIONS; ++d) {
      double low = INFINITY, high = -INFINITY;
      for (int k = 0; k < COUNT; ++k) {
        double place =
            points[k][0] * cos(pi * d / DIRECTIONS) + points[k][1] * sin(pi * d / DIRECTIONS);
        low = fmin(low, place);
        high = fmax(high, place);
      }
      widths[d] = high - low;
    }
    for (int d = 0; d < DIRECTIONS; ++d)
      for (int e = 0; e < d; ++e)
        least = fmin(least, widths[d] * widths[e] / sin(pi * (d - e) / DIRECTIONS));
    struct parallelogram found;
    struct error error;
    assert_ok(parallelogram_around(points, COUNT, &found, &error), &error);
    assert_holds(&found, points, COUNT);
    assert_true(area_of(&found) <= least * (1 + 1e-12));
    assert_true(area_of(&found) > 0.9 * least);
  }
}

/* An oblong is found to the bit. Around the hexagon, three parallelograms are equally small: one
 * with sides along x wins. */
TEST(test_exact_parallelograms) {
  double oblong[6][2] = {{0.3, 0.7}, {0.1, 0.7}, {0.2, 0.2}, {0.1, 0.2}, {0.3, 0.2}, {0.2, 0.7}};
  double hexagon[6][2] = {{0, 0}, {1, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 1}};
  struct parallelogram found;
  assert_int_equal(parallelogram_around(oblong, 6, &found, NULL), RESULT_OK);
  assert_near(found.center[0], (0.1 + 0.3) / 2, 0);
  assert_near(found.center[1], (0.2 + 0.7) / 2, 0);
  assert_near(found.edge[0][0], 0.3 - 0.1, 0);
  assert_near(found.edge[0][1], 0, 0);
  assert_near(found.edge[1][0], 0, 0);
  assert_near(found.edge[1][1], 0.7 - 0.2, 0);
  assert_int_equal(parallelogram_around(hexagon, 6, &found, NULL), RESULT_OK);
  assert_near(area_of(&found), 4, 0);
  assert_near(found.edge[0][1], 0, 0);
}

TEST(test_flat_parallelograms) {
  double one[3][2] = {{1, 2}, {1, 2}, {1, 2}}, line[4][2] = {{0, 0}, {2, 1}, {4, 2}, {2, 1}};
  struct parallelogram found;
  assert_int_equal(parallelogram_around(one, 3, &found, NULL), RESULT_OK);
  assert_near(found.center[1], 2, 0);
  assert_near(hypot(found.edge[0][0], found.edge[0][1]), 0, 0);
  assert_near(hypot(found.edge[1][0], found.edge[1][1]), 0, 0);
  assert_int_equal(parallelogram_around(line, 4, &found, NULL), RESULT_OK);
  assert_near(found.center[0], 2, 1e-15);
  assert_near(found.edge[0][0], 4, 0);
  assert_near(found.edge[0][1], 2, 0);
  assert_near(hypot(found.edge[1][0], found.edge[1][1]), 0, 0);
}

/* ---- Least squares ---- */

/* Nonnegative least squares satisfy Karush, Kuhn and Tucker's conditions. */
TEST(test_nonnegative) {
  enum { N = 7, ROWS = 12 };
  uint64_t seed = 9;
  for (int trial = 0; trial < 50; ++trial) {
    double rows[ROWS][N], a[N * N] = {0}, b[N] = {0}, x[N], scratch[N * (N + 4)];
    for (int r = 0; r < ROWS; ++r) {
      double value = random_between(&seed, -0.3, 0.7);
      for (int i = 0; i < N; ++i) rows[r][i] = random_between(&seed, -0.2, 0.8);
      for (int i = 0; i < N; ++i) {
        b[i] += rows[r][i] * value;
        for (int j = 0; j < N; ++j) a[i * N + j] += rows[r][i] * rows[r][j];
      }
    }
    nnls_solve(N, a, b, x, scratch);
    for (int i = 0; i < N; ++i) {
      double gradient = -b[i];
      for (int j = 0; j < N; ++j) gradient += a[i * N + j] * x[j];
      assert_true(x[i] >= 0);
      if (x[i] > 0)
        assert_near(gradient, 0, 1e-6);
      else
        assert_true(gradient > -1e-6);
    }
  }
}

/* ---- Lights ---- */

/* A cosine lobe's flux is pi; a lobe's is the sum of its intensity over a sphere. */
TEST(test_flux_of_lobes) {
  struct cluster_light light = {.tightness = 1, .size = {1, 1}};
  assert_near(cluster_flux(&light), pi, 1e-12);
  light.tightness = 7.5;
  assert_near(cluster_flux(&light), 2 * pi / 8.5, 1e-12);
  light.cos_falloff = 0.3;
  light.cos_radius = 0.8;
  double sum = 0;
  enum { STEPS = 200000 };
  for (int k = 0; k < STEPS; ++k) {
    double c = 0.3 + 0.7 * (k + 0.5) / STEPS, p = fmin((c - 0.3) / 0.5, 1);
    sum += 2 * pi * pow(c, 7.5) * p * p * (3 - 2 * p) * 0.7 / STEPS;
  }
  assert_near(cluster_flux(&light), sum, 1e-8);
}

/* Derivatives, by differences. */
TEST(test_gradient) {
  static const double at[3] = {0.5, -0.3, 1.2}, apart = 1e-6;
  const struct cluster_light light = {.center = {0.1, -0.05},
                                      .edge = {{0.4, 0.1}, {-0.1, 0.3}},
                                      .axis = {0.2, 0.1},
                                      .tightness = 3,
                                      .cos_radius = 0.99,
                                      .cos_falloff = 0.6,
                                      .size = {2, 4}};
  const struct cluster_numbers gradient = cluster_gradient(&light, at);
  for (int n = 0; n < CLUSTER_NUMBERS; ++n) {
    double values[2];
    for (int side = 0; side < 2; ++side) {
      struct cluster_numbers numbers = cluster_to_numbers(&light);
      numbers.x[n] += side ? apart : -apart;
      struct cluster_light moved = cluster_from_numbers(&numbers, &light);
      values[side] = cluster_irradiance(&moved, at);
    }
    assert_true(fabs(gradient.x[n]) > 1e-3);
    assert_near((values[1] - values[0]) / (2 * apart), gradient.x[n], 1e-7);
  }
}

static double soft_lamp(const double x[4], int channel) {
  double p = x[0] - x[2], q = x[1] - x[3];
  return (1 + 0.2 * x[0]) * (0.5 + 3 * exp(-(p * p + q * q))) *
         (channel == 2 ? 0.5 + 0.2 * x[2] : 1);
}

/* The lights' flux is the slab's in each channel, and no cone reaches behind. */
TEST(test_flux) {
  struct slab slab = plain_slab(6, 12, 1.5);
  fill(&slab, soft_lamp);
  for (int lights = 1; lights <= 9; lights += 4) {
    struct cluster cluster = fit(&slab, lights);
    double flux[3] = {0, 0, 0}, wanted[3], width = plane_width(&slab);
    slab_flux(&slab, wanted, NULL);
    for (int k = 0; k < cluster.pages[0].count; ++k) {
      const struct cluster_light *light = &cluster.pages[0].lights[k];
      double tilt = atan(hypot(light->axis[0], light->axis[1]));
      assert_true(tilt + acos(light->cos_falloff) <= pi / 2 + 1e-9);
      for (int c = 0; c < 3; ++c) {
        assert_true(light->rgb[c] >= 0);
        flux[c] += light->rgb[c] * cluster_flux(light) * width * width;
        double reach = fabs(light->edge[0][c % 2]) + fabs(light->edge[1][c % 2]);
        assert_true(fabs(light->center[c % 2]) + reach / 2 <= 0.5 + 1e-9);
      }
    }
    for (int c = 0; c < 3; ++c) assert_near(flux[c] / wanted[c], 1, 1e-9);
    assert_true(cluster.pages[0].count <= lights);
    cluster_free(&cluster);
  }
  slab_free(&slab);
}

/* The same bits, twice; and times a power of 2 with the radiance. */
TEST(test_determinism) {
  struct slab slab = plain_slab(5, 10, 1.2);
  fill(&slab, soft_lamp);
  struct cluster first = fit(&slab, 5), second = fit(&slab, 5);
  size_t bytes = (size_t)first.pages[0].count * sizeof *first.pages[0].lights;
  assert_memory_equal(first.pages[0].lights, second.pages[0].lights, bytes);
  assert_true(first.lamp.stamp == second.lamp.stamp);
  cluster_free(&second);
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) slab.rgb[k] *= 0x1p40F;
  second = fit(&slab, 5);
  assert_int_equal(first.pages[0].count, second.pages[0].count);
  for (int k = 0; k < first.pages[0].count; ++k)
    assert_near(second.pages[0].lights[k].rgb[0], first.pages[0].lights[k].rgb[0] * 0x1p40, 0);
  cluster_free(&first);
  cluster_free(&second);
  slab_free(&slab);
}

/* Two beams of known lobes, each of the whole aperture. */
static const double known_axes[2][2] = {{-0.5, 0}, {0.45, 0.3}}, known_powers[2] = {30, 60};

static double two_beams(const double x[4], int channel) {
  double sum = 0, r = sqrt(1 + x[2] * x[2] + x[3] * x[3]);
  for (int k = 0; k < 2; ++k) {
    const double *axis = known_axes[k];
    double size = sqrt(1 + axis[0] * axis[0] + axis[1] * axis[1]);
    double cosine = (1 + x[2] * axis[0] + x[3] * axis[1]) / (r * size);
    /* Radiance times the cosine to the normal, 1/r, is intensity. */
    sum += (k == channel ? 2 : 1) * pow(cosine, known_powers[k]) * r;
  }
  return sum;
}

TEST(test_known_mixture) {
  struct slab slab = plain_slab(4, 48, 1.5);
  fill(&slab, two_beams);
  struct cluster cluster = fit(&slab, 2);
  assert_int_equal(cluster.pages[0].count, 2);
  assert_true(cluster.pages[0].error[1] < 0.02 && cluster.pages[0].error[2] < 0.02);
  for (int k = 0; k < 2; ++k) {
    const struct cluster_light *light = &cluster.pages[0].lights[0];
    if (light->axis[0] * known_axes[k][0] < 0) ++light;
    for (int c = 0; c < 2; ++c) assert_near(light->axis[c], known_axes[k][c], 0.02);
    /* Beams of intensity 1 times the aperture's area, 4; in squares of its width, 2. */
    assert_near(light->rgb[k] / light->rgb[2], 2, 0.05);
    assert_near(light->rgb[2], 1, 0.1);
  }
  cluster_free(&cluster);
  slab_free(&slab);
}

static double one_sample_of_all(const double x[4], int channel) {
  return channel != 1 && fabs(x[0] - 0.25) < 0.1 && fabs(x[1] + 0.25) < 0.1 &&
                 fabs(x[2] - 0.375) < 0.1 && fabs(x[3] - 0.375) < 0.1
             ? 100
             : 0;
}

/* All light in one sample is one small light; its missing channel stays dark. */
TEST(test_one_sample) {
  struct slab slab = plain_slab(8, 8, 1);
  for (int axis = 0; axis < 2; ++axis) slab.samples[axis] = 4;
  fill(&slab, one_sample_of_all);
  struct cluster cluster = fit(&slab, 8);
  double wanted[3], flux = 0, error = cluster.pages[0].error[2];
  slab_flux(&slab, wanted, NULL);
  assert_true(wanted[0] > 0);
  for (int k = 0; k < cluster.pages[0].count; ++k) {
    const struct cluster_light *light = &cluster.pages[0].lights[k];
    flux += light->rgb[0] * cluster_flux(light) * 4;
    assert_near(light->rgb[1], 0, 0);
    assert_true(isfinite(light->tightness) && isfinite(light->axis[0]));
  }
  assert_near(flux / wanted[0], 1, 1e-9);
  print_message("one sample: %d lights, error %.3g\n", cluster.pages[0].count, error);
  assert_true(error < 0.5);
  cluster_free(&cluster);
  slab_free(&slab);
}

TEST(test_refusals) {
  struct slab slab = plain_slab(2, 4, 1);
  struct error error;
  struct cluster cluster;
  struct point point;
  assert_refused(
      cluster_make(&slab, 1, &(struct cluster_wish){.lights = 4, .distance = 4}, &cluster, &error),
      &error, "all radiance is zero", NULL);
  cluster_free(&cluster);
  assert_refused(point_make(&slab, 1, NULL, 4, NULL, &point, &error), &error,
                 "all radiance is zero", NULL);
  point_free(&point);
  slab.rgb[0] = 1;
  slab.rgb[7] = -1;
  assert_refused(
      cluster_make(&slab, 1, &(struct cluster_wish){.lights = 4, .distance = 4}, &cluster, &error),
      &error, "is negative", NULL);
  cluster_free(&cluster);
  assert_refused(point_make(&slab, 1, NULL, 4, NULL, &point, &error), &error, "is negative", NULL);
  point_free(&point);
  slab.rgb[7] = 3e38F;
  assert_refused(
      cluster_make(&slab, 1, &(struct cluster_wish){.lights = 4, .distance = 4}, &cluster, &error),
      &error, "1e37", NULL);
  cluster_free(&cluster);
  slab_free(&slab);
}

/* The image's light, summed as POV-Ray interpolates it, is the slab's. */
TEST(test_point_flux) {
  struct slab slab = plain_slab(3, 12, 1.5);
  struct point point;
  struct error error;
  fill(&slab, soft_lamp);
  assert_ok(point_make(&slab, 1, NULL, 20, NULL, &point, &error), &error);
  double wanted[3], flux[3] = {0, 0, 0};
  slab_flux(&slab, wanted, NULL);
  int width = point.columns - 1, height = point.rows - 1; /* of the patches between nodes */
  for (int k = 0; k < 3 * point.columns * point.rows; ++k) {
    double latitude = (0.5 - (double)(k / 3 / point.columns) / height) * pi;
    if (k / 3 % point.columns == width) continue; /* the first column once more */
    flux[k % 3] += (double)point.picture.rgb[k] * point.intensity[0] * cos(latitude) *
                   (2 * pi / width) * (pi / height);
  }
  for (int c = 0; c < 3; ++c) assert_near(flux[c] / wanted[c], 1, 1e-4);
  assert_true(point.error[0] > point.error[1] && point.error[1] > point.error[2]);
  point_free(&point);
  slab_free(&slab);
}

int main(void) {
  return testing_run(NULL, NULL);
}
