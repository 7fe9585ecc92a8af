/* test_occlusion.c - shadow rays (no acne, no leaks, at any scale and place) and nearest hits. */
#include <stdlib.h>

#include "base/vector.h"
#include "built.h"
#include "oracle/random.h"
#include "testing.h"

static const double level[2] = {0, 0}, tilted[2] = {0.37, -0.71}; /* no round numbers */
static const double up[3] = {0, 1, 0};

static void sphere_point(int i, int j, int n, double radius, double out[3]) {
  double a = M_PI * i / n, b = 2 * M_PI * (j % (2 * n)) / (2 * n);
  out[0] = radius * sin(a) * cos(b);
  out[1] = radius * cos(a);
  out[2] = radius * sin(a) * sin(b);
}

static void add_sphere(struct built *built, int n, double radius) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      double x[4][3];
      for (int k = 0; k < 4; ++k)
        sphere_point(i + (k >> 1), j + (k == 1 || k == 2), n, radius, x[k]);
      if (i < n - 1) built_triangle(built, x[0], x[2], x[3]);
      if (i > 0) built_triangle(built, x[0], x[1], x[2]);
    }
}

/* A random point of a triangle and its normal on the side of `out`. */
static void random_point(const struct built *built, size_t triangle, uint64_t *seed,
                         double position[3], double normal[3]) {
  double a = random_number(seed), b = random_number(seed), edge[2][3];
  const double *corner[3];
  for (int k = 0; k < 3; ++k) corner[k] = built->position[built->corners[triangle][k]];
  for (int k = 0; k < 2; ++k) vector_subtract(corner[k + 1], corner[0], edge[k]);
  if (a + b > 1) {
    a = 1 - a;
    b = 1 - b;
  }
  for (int c = 0; c < 3; ++c) position[c] = corner[0][c] + a * edge[0][c] + b * edge[1][c];
  vector_cross(edge[0], edge[1], normal);
  assert_true(vector_normalise(normal));
}

/* Whether the way from a place, lifted off the surface there, is blocked. */
static bool blocked(const struct occlusion *occlusion, const double from[3], const double normal[3],
                    const double to[3]) {
  const double points[1][3] = {{to[0], to[1], to[2]}};
  double lifted[3];
  bool answer;
  occlusion_lift(occlusion, from, normal, lifted);
  occlusion_blocked(occlusion, lifted, points, 1, &answer);
  return answer;
}

static const double scales[] = {1e-3, 1, 1e3};
static const double offsets[] = {0, 1e4};

/* Nothing convex shades itself: rays that leave a big floor, a slope or a sphere of flat triangles
 * above the plane of their triangle, however flat, are free. */
TEST(test_no_acne) {
  uint64_t seed = 1;
  for (int k = 0; k < 18; ++k) {
    struct built *built = built_start(scales[k % 3], offsets[k / 3 % 2]);
    bool ball = k / 6 == 1;
    if (ball)
      add_sphere(built, 40, 1);
    else if (k / 6 == 0)
      built_floor(built, 0, level, 100);
    else
      built_floor(built, 0, tilted, 100);
    struct occlusion *occlusion = built_occlusion(built);
    for (int r = 0; r < 20000; ++r) {
      double position[3], normal[3], direction[3], point[3];
      size_t triangle = (size_t)random_choose(&seed, (int)built->scene.triangles);
      random_point(built, triangle, &seed, position, normal);
      double center[3] = {0, 0, 0}, outwards[3];
      if (!ball) center[1] = -1000;
      built_place(built, center, outwards);
      vector_subtract(position, outwards, outwards);
      if (vector_dot(normal, outwards) < 0)
        for (int c = 0; c < 3; ++c) normal[c] = -normal[c];
      random_direction(&seed, direction);
      double height = vector_dot(direction, normal);
      double wanted = random_log(&seed, 1e-6, 1); /* sine above the plane */
      for (int c = 0; c < 3; ++c) {
        direction[c] += (wanted - height) * normal[c];
        point[c] = position[c] + built->scale * 300 * direction[c];
      }
      if (blocked(occlusion, position, normal, point))
        fail_msg("case %d ray %d: sine %g", k, r, wanted);
    }
    occlusion_free(occlusion);
    free(built);
  }
}

/* A wall that stands on a floor, or is sunk into it, lets nothing through at its foot. */
TEST(test_no_leak) {
  uint64_t seed = 2;
  for (int k = 0; k < 12; ++k) {
    struct built *built = built_start(scales[k % 3], offsets[k / 3 % 2]);
    double foot = k / 6 ? -0.5 : 0;
    const double wall[4][3] = {{0, foot, -10}, {0, foot, 10}, {0, 5, 10}, {0, 5, -10}};
    built_floor(built, 0, level, 10);
    built_quad(built, wall);
    struct occlusion *occlusion = built_occlusion(built);
    for (int r = 0; r < 20000; ++r) {
      /* from 1e-3 to 1 before the wall, to points low behind it */
      double here[3] = {random_log(&seed, 1e-3, 1), 0, random_between(&seed, -4, 4)};
      double there[3] = {random_between(&seed, -9, -0.01), random_log(&seed, 4e-5, 4),
                         random_between(&seed, -4, 4)};
      double position[3], point[3];
      built_place(built, here, position);
      built_place(built, there, point);
      if (!blocked(occlusion, position, up, point))
        fail_msg("case %d ray %d: from %g to %g %g", k, r, here[0], there[0], there[1]);
    }
    occlusion_free(occlusion);
    free(built);
  }
}

/* A ceiling in whose plane the point lies does not hide it; one a thousandth below does. */
TEST(test_ceiling) {
  uint64_t seed = 3;
  for (int k = 0; k < 6; ++k) {
    struct built *built = built_start(scales[k % 3], offsets[k / 3]);
    built_floor(built, 0, level, 3);
    built_floor(built, 2.5, level, 3);
    struct occlusion *occlusion = built_occlusion(built);
    for (int r = 0; r < 5000; ++r) {
      double here[3] = {random_between(&seed, -3, 3), 0, random_between(&seed, -3, 3)};
      double there[3] = {random_between(&seed, -3, 3), 2.5, random_between(&seed, -3, 3)};
      double position[3], point[3];
      built_place(built, here, position);
      built_place(built, there, point);
      assert_false(blocked(occlusion, position, up, point));
      there[1] += 0.0025;
      built_place(built, there, point);
      assert_true(blocked(occlusion, position, up, point));
    }
    occlusion_free(occlusion);
    free(built);
  }
}

/* Hits on a sphere from near and very far, against the closed form. */
TEST(test_nearest) {
  uint64_t seed = 4;
  struct built *built = built_start(10, 50);
  add_sphere(built, 40, 1);
  struct occlusion *occlusion = built_occlusion(built);
  for (int r = 0; r < 2000; ++r) {
    double center[3] = {0, 0, 0}, direction[3], origin[3], way[3];
    built_place(built, center, center);
    random_direction(&seed, direction);
    double far = random_log(&seed, 1e2, 1e9), unit = random_log(&seed, 1e-3, 1e3);
    for (int c = 0; c < 3; ++c) {
      origin[c] = center[c] + far * direction[c];
      way[c] = -direction[c] * unit;
    }
    struct occlusion_hit hit;
    assert_true(occlusion_nearest(occlusion, origin, way, &hit));
    double distance = hit.distance * unit;
    assert_near(distance, far - 10, 0.02 + 1e-12 * far); /* 40 facets */
    const int *corners = built->corners[hit.triangle];
    for (int c = 0; c < 3; ++c) {
      double x = (1 - hit.share[0] - hit.share[1]) * built->position[corners[0]][c] +
                 hit.share[0] * built->position[corners[1]][c] +
                 hit.share[1] * built->position[corners[2]][c];
      assert_near(x, origin[c] + hit.distance * way[c], 1e-4 + 1e-12 * far);
    }
    for (int c = 0; c < 3; ++c) way[c] = -way[c];
    assert_false(occlusion_nearest(occlusion, origin, way, &hit));
    for (int c = 0; c < 3; ++c) way[c] = 0;
    assert_false(occlusion_nearest(occlusion, origin, way, &hit));
  }
  occlusion_free(occlusion);
  free(built);
}

TEST(test_refused) {
  struct built *built = built_start(1, 0);
  struct occlusion *occlusion = built_occlusion(built); /* nothing is there */
  struct occlusion_hit hit;
  const double zero[3] = {0, 0, 0};
  assert_false(occlusion_nearest(occlusion, zero, up, &hit));
  assert_false(blocked(occlusion, zero, up, up));
  occlusion_free(occlusion);
  built_floor(built, 0, level, 1);
  built->position[2][1] = NAN;
  struct error error = {""};
  assert_int_equal(occlusion_create(&built->scene, &occlusion, &error), RESULT_BAD);
  assert_null(occlusion);
  free(built);
}

int main(void) {
  return testing_run(NULL, NULL);
}
