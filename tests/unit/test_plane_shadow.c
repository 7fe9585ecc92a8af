/* test_plane_shadow.c - the shadow of an edge half way, against closed forms; and that a bound on
 * the fit of lights to it counts work, not time. */
#include <math.h>
#include <string.h>

#include "helpers.h"
#include "include/cluster/cluster.h"
#include "oracle/lambert.h"
#include "slab/plane_shadow.h"

/* Radiance 1, an aperture of 2 x 2 and slopes up to `slope`. */
static struct slab even_slab(double slope) {
  struct slab slab = slab_default();
  const double window[4] = {-slope, slope, -slope, slope};
  for (int axis = 0; axis < SLAB_AXES; ++axis) slab.samples[axis] = 4;
  memcpy(slab.st_window, window, sizeof window);
  slab.u[0] = slab.v[1] = 2;
  slab.u[1] = slab.u[2] = slab.v[0] = slab.v[2] = 0;
  slab.normal[0] = slab.normal[1] = 0;
  slab.normal[2] = 1;
  assert_int_equal(slab_alloc(&slab, NULL), RESULT_OK);
  for (size_t k = 0; k < 3 * slab_sample_count(&slab); ++k) slab.rgb[k] = 1;
  return slab;
}

TEST(test_penumbra_is_lamberts) {
  struct slab slab = even_slab(1);
  struct plane_shadow shadow;
  int part = 0, whole = 0;
  assert_int_equal(plane_shadow_make(&slab, 8, &shadow, NULL), RESULT_OK);
  for (int n = 0; n < shadow.count; ++n) {
    const struct plane_shadow_receiver *receiver = &shadow.receivers[n];
    double window[4];
    if (fabs(receiver->at[0]) > 7 || fabs(receiver->at[1]) > 7) continue; /* the st window's edge */
    ++whole;
    part += fabs(receiver->until[0]) < 1 || fabs(receiver->until[1]) < 1;
    for (int k = 0; k < 2; ++k) {
      /* What the edge, at half the distance, leaves of the aperture. */
      double x = receiver->at[k], end = fmin(1, 2 * receiver->edge[k] - x);
      window[2 * k] = fmax((x - end) / 8, -1);
      window[2 * k + 1] = fmin((x + 1) / 8, 1);
    }
    double exact = window[1] > window[0] ? lambert_window(window) : 0;
    assert_true(fabs(receiver->rgb[1] - exact) <
                0.004 * lambert_window((double[4]){-0.125, 0.125, -0.125, 0.125}));
  }
  assert_true(whole > shadow.count / 2 && part > whole / 3);
  plane_shadow_free(&shadow);
  slab_free(&slab);
}

/* All light from the aperture's middle. */
static void one_point(const void *of, int k, const struct plane_shadow_receiver *receiver,
                      double rgb[3]) {
  static const double middle[3] = {0, 0, 0};
  const int points[2] = {32, 32};
  (void)k;
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!plane_shadow_hides(receiver, middle))
    plane_irradiance(of, points, receiver->at, receiver->at[2], rgb);
}

/* Far away irradiance along an axis is 1 up to 4 from the middle and falls to 0 at 6; the exact
 * shadow falls from 1 to 0 between -1 and 1. Squares: of the step minus that, 2/12; of what is
 * lit, 2/3 + 3 + 2/3. */
TEST(test_hard_shadow_is_off_by_a_closed_form) {
  struct slab slab = even_slab(0.05);
  struct plane_shadow shadow;
  assert_int_equal(plane_shadow_make(&slab, 100, &shadow, NULL), RESULT_OK);
  double error = plane_shadow_error(&shadow, one_point, &slab, 0);
  assert_near(error, sqrt((2.0 / 12) / (13.0 / 3)), 0.01);
  plane_shadow_free(&shadow);
  slab_free(&slab);
}

TEST(test_bound_gives_the_same_lights) {
  struct slab slab = even_slab(1);
  struct cluster clusters[2];
  const struct cluster_wish wish = {.tolerance = 1e-6, .distance = 4, .shadows = true, .work = 1};
  for (int k = 0; k < 2; ++k)
    assert_int_equal(cluster_make(&slab, 1, &wish, &clusters[k], NULL), RESULT_OK);
  assert_true(clusters[0].cut_short);
  assert_int_equal(clusters[0].pages[0].count, 1);
  assert_true(clusters[0].pages[0].shadow_at > 0 && clusters[0].pages[0].shadow_at < 1);
  assert_memory_equal(clusters[0].pages[0].lights, clusters[1].pages[0].lights,
                      sizeof clusters[0].pages[0].lights[0]);
  for (int k = 0; k < 2; ++k) cluster_free(&clusters[k]);
  slab_free(&slab);
}

int main(void) {
  return testing_run(NULL, NULL);
}
