/* test_gloss.c - highlights: the integral of L (N.H)^m over the solid angle, against a midpoint
 * sum over the aperture; and the methods' predicted errors hold for glossy receivers too. */
#include <string.h>

#include "base/vector.h"
#include "helpers.h"
#include "oracle/oracle.h"

enum { FINE = 1500 };

/* A slab over x, z in -1/2..1/2 that shines along -y. */
static struct light make_light(double distance) {
  static const double window[4] = {-1, 1, -1, 1}, v[3] = {0, 0, 1}, normal[3] = {0, -1, 0};
  struct slab slab =
      rough_slab((const int[]){5, 4, 9, 8}, distance, window, FRAME_PLAIN, FILL_UNIFORM, 1);
  memcpy(slab.v, v, sizeof v);
  memcpy(slab.normal, normal, sizeof normal);
  struct light light = load_light(&slab, 1);
  slab_free(&slab);
  return light;
}

/* Someone who looks near the mirror image of a part of the aperture. */
static struct receiver make_receiver(int index, double shininess) {
  struct receiver receiver = {.position = {0.2 * index - 0.3, -0.4 - 0.5 * index, 0.1},
                              .normal = {0.2, 1, 0.3 * index - 0.4},
                              .shininess = shininess};
  const double *p = receiver.position, to[3] = {0.3 - 0.1 * index - p[0], -p[1], 0.2 - p[2]};
  vector_normalise(receiver.normal);
  double along = vector_dot(to, receiver.normal);
  for (int c = 0; c < 3; ++c) receiver.eye[c] = 2 * along * receiver.normal[c] - to[c];
  vector_normalise(receiver.eye);
  memcpy(receiver.lift, receiver.normal, sizeof receiver.lift);
  return receiver;
}

static struct gathered gather_one(const struct light *light, const struct receiver *receiver,
                                  enum gather_method method, double tolerance) {
  const struct gather_settings settings = {.lights = light,
                                           .light_count = 1,
                                           .method = method,
                                           .tolerance = tolerance,
                                           .level = -1,
                                           .shadow_grid = 16,
                                           .shadow_edge = 256};
  struct gathered gathered;
  sum_light(&settings, receiver, 1, &gathered);
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
    light_free(&light);
  }
}

static double largest(const double rgb[3]) {
  return fmax(rgb[0], fmax(rgb[1], rgb[2]));
}

static void check_brute(const struct light *light, const struct receiver *receiver) {
  double exact[3];
  oracle_brute(&light->pages[0].slab, receiver->position, receiver->normal, receiver->eye,
               receiver->shininess, FINE, exact);
  struct gathered gathered = gather_one(light, receiver, GATHER_REFERENCE, 1e-6);
  assert_true(largest(exact) > 1e-3);
  for (int c = 0; c < 3; ++c)
    assert_true(fabs(gathered.gloss[c] - exact[c]) < 2e-3 * largest(exact));
}

TEST(test_brute_force) {
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

TEST(test_tolerance) {
  each_case(check_tolerance);
}

int main(void) {
  return testing_run(NULL, NULL);
}
