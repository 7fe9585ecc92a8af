/* test_slab.c - geometry and lookup against the format's text, which oracle/lookup.c reads too. */
#include <math.h>
#include <string.h>

#include "helpers.h"
#include "oracle/lookup.h"
#include "oracle/random.h"

TEST(test_positions) {
  struct slab slab = awkward_slab((const int[]){4, 5, 7, 2}, 3);
  assert_near(slab_position(&slab, SLAB_U, 0), -0.15, 1e-15);
  assert_near(slab_position(&slab, SLAB_V, 2), 0, 1e-15);
  assert_near(slab_position(&slab, SLAB_S, 0), -0.2, 1e-15);
  assert_near(slab_position(&slab, SLAB_T, 1), 0.725, 1e-15);
  assert_near(slab_spacing(&slab, SLAB_S), 0.2, 1e-15);
  assert_near(slab_kappa(&slab), 1.0 / 3, 1e-16);
  assert_int_equal(slab_width(&slab), 28);
  assert_int_equal(slab_height(&slab), 10);
  assert_ptr_equal(slab_at(&slab, 3, 2, 5, 1), slab.rgb + 3 * ((2 * 2 + 1) * 28 + 3 * 7 + 5));
  slab_free(&slab);
}

/* Where the format puts sample (i,j,k,l), lookup returns that sample. */
TEST(test_lookup_at_samples) {
  struct slab slab = awkward_slab((const int[]){3, 2, 4, 5}, INFINITY);
  fill_colours(&slab, 1);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 5; ++l) {
          double rgb[3];
          slab_lookup(&slab, ((i + 0.5) / 3 - 0.5) * 0.4, ((j + 0.5) / 2 - 0.5) * 0.7,
                      -0.3 + (k + 0.5) * 1.4 / 4, 0.2 + (l + 0.5) * 0.7 / 5, rgb);
          for (int c = 0; c < 3; ++c) assert_near(rgb[c], slab_at(&slab, i, j, k, l)[c], 1e-6);
        }
  slab_free(&slab);
}

TEST(test_lookup_against_oracle) {
  static const int grids[][4] = {{1, 1, 1, 1}, {3, 2, 4, 5}, {1, 4, 1, 3}, {2, 2, 2, 2}};
  uint64_t seed = 7;
  for (size_t g = 0; g < sizeof grids / sizeof *grids; ++g) {
    struct slab slab = awkward_slab(grids[g], 2);
    fill_colours(&slab, (uint64_t)g);
    for (int n = 0; n < 2000; ++n) {
      /* a tenth beyond each border */
      const double x[4] = {random_between(&seed, -0.24, 0.24), random_between(&seed, -0.42, 0.42),
                           random_between(&seed, -0.44, 1.24), random_between(&seed, 0.13, 0.97)};
      double rgb[3], expected[3];
      slab_lookup(&slab, x[0], x[1], x[2], x[3], rgb);
      oracle_lookup(&slab, x, expected);
      for (int c = 0; c < 3; ++c) assert_near(rgb[c], expected[c], 1e-12);
    }
    slab_free(&slab);
  }
}

TEST(test_lookup_outside_and_nan) {
  struct slab slab = awkward_slab((const int[]){2, 2, 2, 2}, INFINITY);
  for (size_t k = 0; k < 3 * 16; ++k) slab.rgb[k] = 1;
  static const double outside[][4] = {
      {0.2001, 0, 0, 0.5}, {0, -0.3501, 0, 0.5}, {0, 0, -0.3001, 0.5},
      {0, 0, 1.1001, 0.5}, {0, 0, 0, 0.1999},    {0, 0, 0, 0.9001},
      {NAN, 0, 0, 0.5},    {0, 0, NAN, 0.5},     {0, INFINITY, 0, 0.5}};
  double rgb[3];
  for (size_t k = 0; k < sizeof outside / sizeof *outside; ++k) {
    slab_lookup(&slab, outside[k][0], outside[k][1], outside[k][2], outside[k][3], rgb);
    assert_true(rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0);
  }
  /* The border itself, and the half cell within it, are inside. */
  slab_lookup(&slab, 0.2, 0.35, 1.1, 0.9, rgb);
  assert_near(rgb[1], 1, 1e-15);
  slab_lookup(&slab, -0.2, -0.35, -0.3, 0.2, rgb);
  assert_near(rgb[1], 1, 1e-15);
  slab_free(&slab);
}

/* The ray through (a,b,s,t) by the format's formula, and back; for finite D it
 * also passes C + D n + D s u' + D t v'. */
TEST(test_rays) {
  static const double distances[] = {INFINITY, 0.25, 40};
  const double up[3] = {0.6, 0, 0.8}, vp[3] = {0, 1, 0};
  uint64_t seed = 3;
  for (size_t d = 0; d < 3; ++d) {
    struct slab slab = awkward_slab((const int[]){2, 2, 2, 2}, distances[d]);
    double kappa = 1 / distances[d];
    for (int n = 0; n < 200; ++n) {
      double want[4], got[4], origin[3], direction[3];
      for (int k = 0; k < 4; ++k) want[k] = random_between(&seed, -0.5, 0.5);
      double steps = random_between(&seed, -5, 5), size = random_between(&seed, 0.1, 5.1);
      for (int c = 0; c < 3; ++c) {
        double along = slab.normal[c] + (want[2] - kappa * want[0]) * up[c] +
                       (want[3] - kappa * want[1]) * vp[c];
        double start = slab.center[c] + want[0] * up[c] + want[1] * vp[c];
        origin[c] = start + steps * along;
        direction[c] = size * along;
      }
      assert_true(slab_ray(&slab, origin, direction, got));
      for (int k = 0; k < 4; ++k) assert_near(got[k], want[k], 1e-12);
      if (isfinite(distances[d])) {
        for (int c = 0; c < 3; ++c)
          direction[c] = slab.center[c] +
                         distances[d] * (slab.normal[c] + want[2] * up[c] + want[3] * vp[c]) -
                         origin[c];
        double forward = 0;
        for (int c = 0; c < 3; ++c) forward += direction[c] * slab.normal[c];
        if (fabs(forward) > 1e-3 && forward > 0) {
          assert_true(slab_ray(&slab, origin, direction, got));
          for (int k = 0; k < 4; ++k) assert_near(got[k], want[k], 1e-9);
        }
      }
      for (int c = 0; c < 3; ++c) direction[c] = -direction[c];
      double forward = 0;
      for (int c = 0; c < 3; ++c) forward += direction[c] * slab.normal[c];
      if (forward < 0) assert_false(slab_ray(&slab, origin, direction, got));
    }
    slab_free(&slab);
  }
}

/* Any unit of length: nothing over- or underflows. */
TEST(test_units) {
  static const double units[] = {1e-150, 0x1p-40, 0x1p40, 1e150};
  for (size_t n = 0; n < 4; ++n) {
    struct slab slab = awkward_slab((const int[]){3, 2, 2, 2}, 2 * units[n]);
    fill_colours(&slab, 5);
    double small[3], large[3];
    struct error error = {{0}};
    struct slab plain = slab;
    plain.st_distance = 2;
    slab_lookup(&plain, 0.07, -0.11, 0.4, 0.5, small);
    for (int c = 0; c < 3; ++c) slab.u[c] *= units[n], slab.v[c] *= units[n];
    assert_ok(slab_check(&slab, &error), &error);
    slab_lookup(&slab, 0.07 * units[n], -0.11 * units[n], 0.4, 0.5, large);
    for (int c = 0; c < 3; ++c) assert_near(small[c], large[c], 1e-13);
    slab_free(&slab);
  }
}

static void refuse(void (*spoil)(struct slab *), const char *why) {
  struct slab slab = awkward_slab((const int[]){1, 1, 1, 1}, 1);
  struct error error = {{0}};
  assert_ok(slab_check(&slab, &error), &error);
  spoil(&slab);
  assert_refused(slab_check(&slab, &error), &error, why, NULL);
  slab_free(&slab);
}

static void no_samples(struct slab *slab) {
  slab->samples[2] = 0;
}
static void too_many(struct slab *slab) {
  slab->samples[0] = slab->samples[2] = 65536;
}
static void skew(struct slab *slab) {
  slab->v[0] = 0.01;
}
static void lean(struct slab *slab) {
  slab->normal[1] = 0.001;
}
static void flat(struct slab *slab) {
  slab->u[0] = slab->u[2] = 0;
}
static void long_normal(struct slab *slab) {
  slab->normal[0] *= 2, slab->normal[2] *= 2;
}
static void nowhere(struct slab *slab) {
  slab->center[1] = NAN;
}
static void infinite(struct slab *slab) {
  slab->v[1] = INFINITY;
}
static void empty(struct slab *slab) {
  slab->st_window[1] = slab->st_window[0];
}
static void reversed(struct slab *slab) {
  slab->st_window[3] = 0.1;
}
static void endless(struct slab *slab) {
  slab->st_window[3] = INFINITY;
}
static void behind(struct slab *slab) {
  slab->st_distance = -1;
}
static void on_plane(struct slab *slab) {
  slab->st_distance = 0;
}
static void no_distance(struct slab *slab) {
  slab->st_distance = NAN;
}
static void tiny_distance(struct slab *slab) {
  slab->st_distance = 1e-320;
}
static void tiny_share(struct slab *slab) { /* 1/D alone is finite */
  slab->st_distance = 1e-300;
  for (int c = 0; c < 3; ++c) slab->u[c] *= 1e20;
}
static void huge_unit(struct slab *slab) {
  slab->metres_per_unit = 1e200;
}
static void tiny_unit(struct slab *slab) {
  slab->metres_per_unit = 1e-200;
}
static void huge_area(struct slab *slab) {
  for (int c = 0; c < 3; ++c) slab->u[c] *= 1e160, slab->v[c] *= 1e160;
}
static void no_unit(struct slab *slab) {
  slab->metres_per_unit = 0;
}
static void other_unit(struct slab *slab) {
  strcpy(slab->radiance_unit, "nit");
}

TEST(test_refusals) {
  refuse(no_samples, "must be at least 1");
  refuse(too_many, "too many");
  refuse(skew, "u and v are not perpendicular");
  refuse(lean, "v and normal are not perpendicular");
  refuse(flat, "u has zero length");
  refuse(long_normal, "normal has length 2");
  refuse(nowhere, "center is not finite");
  refuse(infinite, "v is not finite");
  refuse(empty, "is empty");
  refuse(reversed, "is empty");
  refuse(endless, "st_window is not finite");
  refuse(behind, "st_distance");
  refuse(on_plane, "st_distance");
  refuse(no_distance, "st_distance");
  refuse(tiny_distance, "too small to divide by");
  refuse(tiny_share, "too small to divide by");
  refuse(huge_unit, "too large to square");
  refuse(tiny_unit, "too small");
  refuse(huge_area, "span the area");
  refuse(no_unit, "metres_per_unit");
  refuse(other_unit, "radiance_unit");
}

TEST(test_absurd_allocation) {
  struct slab slab = slab_default();
  struct error error = {{0}};
  for (int axis = 0; axis < SLAB_AXES; ++axis) slab.samples[axis] = 11000;
  assert_refused(slab_alloc(&slab, &error), &error, "11000", NULL);
  assert_null(slab.rgb);
}

int main(void) {
  return testing_run(NULL, NULL);
}
