/* test_gloss.c - highlights: the integral of L (N.H)^m over the solid angle, against brute
 * force over the aperture that shares nothing with the renderer but slab_lookup; and the
 * methods' predicted errors hold for glossy receivers too. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "gather/gather.h"
#include "testing.h"

enum { FINE = 1500 };

/* A slab over x, z in -1/2..1/2 that shines along -y, as the default one does. */
static struct light make_light(double distance) {
  struct slab slab = slab_default();
  const int samples[SLAB_AXES] = {5, 4, 9, 8};
  struct error error;
  uint32_t seed = 1;
  memcpy(slab.samples, samples, sizeof samples);
  slab.st_distance = distance;
  assert_int_equal(slab_alloc(&slab, &error), RESULT_OK);
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) {
    seed = seed * 1664525 + 1013904223;
    slab.rgb[k] = (float)(seed >> 8) / (1 << 24);
  }
  struct light light = {.count = 1, .pages = calloc(1, sizeof *light.pages), .gain = 1, .scale = 1};
  assert_non_null(light.pages);
  struct light_page *page = &light.pages[0];
  page->slab = slab;
  page->frame[0][0] = page->frame[1][2] = 1;
  page->frame[2][1] = -1;
  for (int axis = 0; axis < 2; ++axis) {
    page->axes[axis].half = 0.5;
    page->axes[axis].far_low = -1;
    page->axes[axis].far_high = 1;
    page->axes[axis].kappa = 1 / distance;
  }
  assert_int_equal(light_page_set_samples(page, &error), RESULT_OK);
  return light;
}

static void unit(double x[3]) {
  double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  for (int c = 0; c < 3; ++c) x[c] /= length;
}

static double dot(const double x[3], const double y[3]) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* Midpoints of FINE x FINE parts of the aperture. */
static void brute_force(const struct slab *slab, const struct receiver *receiver, double rgb[3]) {
  const double *n = receiver->normal;
  memset(rgb, 0, 3 * sizeof *rgb);
  for (int j = 0; j < FINE; ++j)
    for (int i = 0; i < FINE; ++i) {
      double seen[3], abst[4], to[3] = {(i + 0.5) / FINE - 0.5, 0, (j + 0.5) / FINE - 0.5}, half[3];
      for (int c = 0; c < 3; ++c) to[c] -= receiver->position[c];
      double square = dot(to, to);
      unit(to);
      if (dot(to, n) <= 0) continue;
      double back[3] = {-to[0], -to[1], -to[2]};
      assert_true(slab_ray(slab, receiver->position, back, abst));
      slab_lookup(slab, abst[0], abst[1], abst[2], abst[3], seen);
      for (int c = 0; c < 3; ++c) half[c] = to[c] + receiver->eye[c];
      unit(half);
      double lobe = pow(fmax(dot(half, n), 0), receiver->shininess);
      for (int c = 0; c < 3; ++c) rgb[c] += seen[c] * lobe * to[1] / square / ((double)FINE * FINE);
    }
}

/* Someone who looks near the mirror image of a part of the aperture. */
static struct receiver make_receiver(int index, double shininess) {
  struct receiver receiver = {.position = {0.2 * index - 0.3, -0.4 - 0.5 * index, 0.1},
                              .normal = {0.2, 1, 0.3 * index - 0.4},
                              .shininess = shininess};
  const double *p = receiver.position, to[3] = {0.3 - 0.1 * index - p[0], -p[1], 0.2 - p[2]};
  unit(receiver.normal);
  double along = dot(to, receiver.normal);
  for (int c = 0; c < 3; ++c) receiver.eye[c] = 2 * along * receiver.normal[c] - to[c];
  unit(receiver.eye);
  memcpy(receiver.lift, receiver.normal, sizeof receiver.lift);
  return receiver;
}

static struct gathered gather_one(const struct light *light, const struct receiver *receiver,
                                  enum gather_method method, double tolerance) {
  struct gather_settings settings = {.lights = light,
                                     .light_count = 1,
                                     .method = method,
                                     .tolerance = tolerance,
                                     .level = -1,
                                     .shadow_grid = 16,
                                     .shadow_edge = 256};
  struct gather *gather = NULL;
  struct gathered gathered;
  struct error error;
  assert_int_equal(gather_create(&settings, &gather, &error), RESULT_OK);
  assert_int_equal(gather_light(gather, receiver, 1, &gathered, &error), RESULT_OK);
  gather_free(gather);
  return gathered;
}

static void each_case(void (*check)(const struct light *, const struct receiver *)) {
  static const double distances[] = {INFINITY, 2}, exponents[] = {1, 10, 100, 1000};
  for (int d = 0; d < 2; ++d) {
    struct light light = make_light(distances[d]);
    for (int k = 0; k < 4; ++k) {
      struct receiver receiver = make_receiver(k, exponents[(k + d) % 4]);
      check(&light, &receiver);
    }
    light_page_free(&light.pages[0]);
    free(light.pages);
  }
}

static double largest(const double rgb[3]) {
  return fmax(rgb[0], fmax(rgb[1], rgb[2]));
}

static void check_brute(const struct light *light, const struct receiver *receiver) {
  double exact[3];
  brute_force(&light->pages[0].slab, receiver, exact);
  struct gathered gathered = gather_one(light, receiver, GATHER_REFERENCE, 1e-6);
  assert_true(largest(exact) > 1e-3);
  for (int c = 0; c < 3; ++c)
    assert_true(fabs(gathered.gloss[c] - exact[c]) < 2e-3 * largest(exact));
}

static void test_brute_force(void **state) {
  (void)state;
  each_case(check_brute);
}

static void check_tolerance(const struct light *light, const struct receiver *receiver) {
  static const double tolerances[] = {1e-2, 1e-3, 1e-5};
  struct gathered exact = gather_one(light, receiver, GATHER_REFERENCE, 1e-9);
  for (int t = 0; t < 3; ++t) {
    struct gathered gathered = gather_one(light, receiver, GATHER_AUTO, tolerances[t]);
    for (int c = 0; c < 3; ++c) {
      assert_true(fabs(gathered.gloss[c] - exact.gloss[c]) < tolerances[t] * largest(exact.gloss));
      assert_true(fabs(gathered.irradiance[c] - exact.irradiance[c]) <
                  tolerances[t] * largest(exact.irradiance));
    }
  }
}

static void test_tolerance(void **state) {
  (void)state;
  each_case(check_tolerance);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_brute_force),
                                     cmocka_unit_test(test_tolerance)};
  return cmocka_run_group_tests_name("highlights", tests, NULL, NULL);
}
