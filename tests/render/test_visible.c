/* test_visible.c - shadow rays (no acne, no leaks, at any scale and place) and the visible
 * part of an aperture against exact areas. */
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/vector.h"
#include "helpers.h"
#include "scene/scene.h"
#include "shadow/occlusion.h"
#include "shadow/visible.h"

enum { MOST = 20000 };

/* A scene that is put together by hand. */
struct built {
  struct scene scene;
  double position[MOST][3];
  int corners[MOST][3];
  double scale, offset;
};

static struct built *build_start(double scale, double offset) {
  struct built *built = calloc(1, sizeof *built);
  assert_non_null(built);
  built->scene.position = built->position;
  built->scene.corners = built->corners;
  built->scale = scale;
  built->offset = offset;
  return built;
}

static void place(const struct built *built, const double x[3], double out[3]) {
  for (int c = 0; c < 3; ++c) out[c] = (x[c] + built->offset) * built->scale;
}

static void add_triangle(struct built *built, const double (*x)[3]) {
  assert_true(built->scene.vertices + 3 <= MOST);
  for (int k = 0; k < 3; ++k) {
    built->corners[built->scene.triangles][k] = (int)built->scene.vertices;
    place(built, x[k], built->position[built->scene.vertices++]);
  }
  ++built->scene.triangles;
}

static void add_quad(struct built *built, const double (*x)[3]) {
  add_triangle(built, x);
  const double other[3][3] = {
      {x[0][0], x[0][1], x[0][2]}, {x[2][0], x[2][1], x[2][2]}, {x[3][0], x[3][1], x[3][2]}};
  add_triangle(built, other);
}

/* Level with the xz plane. */
static void add_floor(struct built *built, double y, double half) {
  const double x[4][3] = {{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}};
  add_quad(built, x);
}

static void sphere_point(int i, int j, int n, double radius, double out[3]) {
  double a = M_PI * i / n, b = 2 * M_PI * (j % (2 * n)) / (2 * n);
  out[0] = radius * sin(a) * cos(b);
  out[1] = radius * cos(a);
  out[2] = radius * sin(a) * sin(b);
}

/* The same, tilted: nothing is a round number. */
static void add_slope(struct built *built, double half) {
  double x[4][3];
  for (int k = 0; k < 4; ++k) {
    x[k][0] = k == 1 || k == 2 ? half : -half;
    x[k][2] = k > 1 ? half : -half;
    x[k][1] = 0.37 * x[k][0] - 0.71 * x[k][2];
  }
  add_quad(built, (const double(*)[3])x);
}

static void add_sphere(struct built *built, int n, double radius) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      double x[4][3];
      for (int k = 0; k < 4; ++k)
        sphere_point(i + (k >> 1), j + (k == 1 || k == 2), n, radius, x[k]);
      const double one[3][3] = {
          {x[0][0], x[0][1], x[0][2]}, {x[2][0], x[2][1], x[2][2]}, {x[3][0], x[3][1], x[3][2]}};
      const double two[3][3] = {
          {x[0][0], x[0][1], x[0][2]}, {x[1][0], x[1][1], x[1][2]}, {x[2][0], x[2][1], x[2][2]}};
      if (i < n - 1) add_triangle(built, one);
      if (i > 0) add_triangle(built, two);
    }
}

static struct occlusion *build_finish(struct built *built) {
  struct occlusion *occlusion;
  struct error error = {""};
  if (occlusion_create(&built->scene, &occlusion, &error)) fail_msg("%s", error.text);
  return occlusion;
}

/* A random point of a triangle and its normal on the side of `out`. */
static void random_point(const struct built *built, size_t triangle, uint32_t *seed,
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

static const double scales[] = {1e-3, 1, 1e3};
static const double offsets[] = {0, 1e4};

/* Nothing convex shades itself: rays that leave a big floor, a slope or a sphere of flat triangles
 * above the plane of their triangle, however flat, are free. */
static void test_no_acne(void **state) {
  (void)state;
  uint32_t seed = 1;
  for (int k = 0; k < 18; ++k) {
    struct built *built = build_start(scales[k % 3], offsets[k / 3 % 2]);
    bool ball = k / 6 == 1;
    if (ball)
      add_sphere(built, 40, 1);
    else if (k / 6 == 0)
      add_floor(built, 0, 100);
    else
      add_slope(built, 100);
    struct occlusion *occlusion = build_finish(built);
    for (int r = 0; r < 20000; ++r) {
      double position[3], normal[3], lifted[3], direction[3], point[1][3];
      size_t triangle = (size_t)(random_number(&seed) * (double)built->scene.triangles);
      random_point(built, triangle, &seed, position, normal);
      double center[3] = {0, 0, 0}, outwards[3];
      if (!ball) center[1] = -1000;
      place(built, center, outwards);
      vector_subtract(position, outwards, outwards);
      if (vector_dot(normal, outwards) < 0)
        for (int c = 0; c < 3; ++c) normal[c] = -normal[c];
      random_direction(&seed, direction);
      double height = vector_dot(direction, normal);
      double wanted = pow(10, -6 * random_number(&seed)); /* sine above the plane */
      for (int c = 0; c < 3; ++c) direction[c] += (wanted - height) * normal[c];
      double length = built->scale * 300;
      for (int c = 0; c < 3; ++c) point[0][c] = position[c] + length * direction[c];
      occlusion_lift(occlusion, position, normal, lifted);
      bool blocked;
      occlusion_blocked(occlusion, lifted, (const double(*)[3])point, 1, &blocked);
      if (blocked) fail_msg("case %d ray %d: sine %g", k, r, wanted);
    }
    occlusion_free(occlusion);
    free(built);
  }
}

/* A wall that stands on a floor (and one that is sunk into it) lets nothing through at its
 * foot, nor does a closed box at its edges. */
static void test_no_leak(void **state) {
  (void)state;
  uint32_t seed = 2;
  for (int k = 0; k < 12; ++k) {
    struct built *built = build_start(scales[k % 3], offsets[k / 3 % 2]);
    double foot = k / 6 ? -0.5 : 0;
    const double wall[4][3] = {{0, foot, -10}, {0, foot, 10}, {0, 5, 10}, {0, 5, -10}};
    add_floor(built, 0, 10);
    add_quad(built, wall);
    struct occlusion *occlusion = build_finish(built);
    for (int r = 0; r < 20000; ++r) {
      /* from 1e-3 to 1 before the wall, to points low behind it */
      double here[3] = {pow(10, -3 * random_number(&seed)), 0, 8 * random_number(&seed) - 4};
      double there[3] = {-9 * random_number(&seed) - 0.01, 4 * pow(10, -5 * random_number(&seed)),
                         8 * random_number(&seed) - 4};
      double position[3], point[1][3], lifted[3];
      const double up[3] = {0, 1, 0};
      place(built, here, position);
      place(built, there, point[0]);
      occlusion_lift(occlusion, position, up, lifted);
      bool blocked;
      occlusion_blocked(occlusion, lifted, (const double(*)[3])point, 1, &blocked);
      if (!blocked) fail_msg("case %d ray %d: from %g to %g %g", k, r, here[0], there[0], there[1]);
    }
    occlusion_free(occlusion);
    free(built);
  }
}

/* A ceiling in whose plane the point lies does not hide it; one a thousandth below does. */
static void test_ceiling(void **state) {
  (void)state;
  uint32_t seed = 3;
  for (int k = 0; k < 6; ++k) {
    struct built *built = build_start(scales[k % 3], offsets[k / 3]);
    add_floor(built, 0, 3);
    add_floor(built, 2.5, 3);
    struct occlusion *occlusion = build_finish(built);
    for (int r = 0; r < 5000; ++r) {
      double here[3] = {6 * random_number(&seed) - 3, 0, 6 * random_number(&seed) - 3};
      double there[3] = {6 * random_number(&seed) - 3, 2.5, 6 * random_number(&seed) - 3};
      double position[3], points[2][3], lifted[3];
      const double up[3] = {0, 1, 0};
      place(built, here, position);
      place(built, there, points[0]);
      there[1] += 0.0025;
      place(built, there, points[1]);
      occlusion_lift(occlusion, position, up, lifted);
      bool blocked[2];
      occlusion_blocked(occlusion, lifted, (const double(*)[3])points, 2, blocked);
      assert_false(blocked[0]);
      assert_true(blocked[1]);
    }
    occlusion_free(occlusion);
    free(built);
  }
}

/* Hits on a sphere from near and very far, against the closed form. */
static void test_nearest(void **state) {
  (void)state;
  uint32_t seed = 4;
  struct built *built = build_start(10, 50);
  add_sphere(built, 40, 1);
  struct occlusion *occlusion = build_finish(built);
  for (int r = 0; r < 2000; ++r) {
    double center[3] = {0, 0, 0}, direction[3], origin[3], way[3];
    place(built, center, center);
    random_direction(&seed, direction);
    double far = pow(10, 2 + 7 * random_number(&seed)),
           unit = pow(10, 6 * random_number(&seed) - 3);
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

/* An aperture at height 2 over a receiver at the origin, and what hides it at height 1:
 * shadows on the aperture are twice as large. */
static struct visible_query query_over(const struct occlusion *occlusion, int grid, int edge) {
  struct visible_query query = {.occlusion = occlusion,
                                .lifted = {0, 0, 0},
                                .origin = {0, 2, 0},
                                .along = {{1, 0, 0}, {0, 0, 1}},
                                .whole = {{-1, -1}, {1, 1}},
                                .grid = grid,
                                .edge = edge};
  return query;
}

static void find(const struct visible_query *query, struct visible *visible) {
  struct error error = {""};
  if (visible_find(query, visible, &error)) fail_msg("%s", error.text);
}

static double rectangle_area(const struct visible_rectangle *r) {
  return (r->high[0] - r->low[0]) * (r->high[1] - r->low[1]);
}

/* The area, after checking that the rectangles are disjoint and inside. */
static double area(const struct visible_query *query, const struct visible *visible) {
  double sum = 0;
  for (int k = 0; k < visible->count; ++k) {
    const struct visible_rectangle *r = &visible->rectangles[k];
    for (int c = 0; c < 2; ++c)
      assert_true(r->low[c] >= query->whole.low[c] && r->high[c] <= query->whole.high[c] &&
                  r->low[c] < r->high[c]);
    for (int m = 0; m < k; ++m) {
      const struct visible_rectangle *s = &visible->rectangles[m];
      assert_true(r->low[0] >= s->high[0] || s->low[0] >= r->high[0] || r->low[1] >= s->high[1] ||
                  s->low[1] >= r->high[1]);
    }
    sum += rectangle_area(r);
  }
  return sum;
}

static const double far_away[3][3] = {{50, -3, 50}, {51, -3, 50}, {50, -3, 51}};

static void test_all_or_none(void **state) {
  (void)state;
  struct built *built = build_start(1, 0);
  add_triangle(built, far_away);
  struct occlusion *open = build_finish(built);
  add_floor(built, 1, 5);
  struct occlusion *shut = build_finish(built);
  struct visible visible = {0};
  for (int grid = 1; grid <= 16; grid *= 2) {
    struct visible_query query = query_over(open, grid, 4 * grid);
    query.whole = (struct visible_rectangle){{-0.1, 1.0 / 3}, {0.7, 0.9}};
    visible.shadow_rays = 0;
    find(&query, &visible);
    assert_int_equal(visible.count, 1);
    assert_memory_equal(&visible.rectangles[0], &query.whole, sizeof query.whole);
    assert_int_equal(visible.shadow_rays, (grid + 1) * (grid + 1) + grid * grid);
    query.occlusion = shut;
    find(&query, &visible);
    assert_int_equal(visible.count, 0);
    query.whole.high[0] = query.whole.low[0]; /* nothing to see */
    visible.shadow_rays = 0;
    find(&query, &visible);
    assert_int_equal(visible.count, 0);
    assert_int_equal(visible.shadow_rays, 0);
  }
  visible_free(&visible);
  occlusion_free(open);
  occlusion_free(shut);
  free(built);
}

/* An occluder at half height, over an aperture of 2 x 2, and what it leaves of that. */
struct shadow {
  double visible, edge; /* area, length of the shadow's edge */
};

/* Covers x cos + z sin > 0: half of the aperture. */
static struct shadow add_half_plane(struct built *built, double angle) {
  double ca = cos(angle), sa = sin(angle);
  const double x[4][3] = {{-9 * sa, 1, 9 * ca},
                          {9 * sa, 1, -9 * ca},
                          {9 * sa + 9 * ca, 1, -9 * ca + 9 * sa},
                          {-9 * sa + 9 * ca, 1, 9 * ca + 9 * sa}};
  add_quad(built, x);
  return (struct shadow){2, 2 * sqrt(2)};
}

/* Sides of 0.3, so 0.6 on the aperture. */
static struct shadow add_square(struct built *built, double angle) {
  double h = 0.15 * sqrt(2), x[4][3];
  for (int k = 0; k < 4; ++k) {
    x[k][0] = 0.1 + h * cos(angle + M_PI / 2 * k);
    x[k][1] = 1;
    x[k][2] = -0.07 + h * sin(angle + M_PI / 2 * k);
  }
  add_quad(built, (const double(*)[3])x);
  return (struct shadow){4 - 0.36, 2.4};
}

/* Radius 0.4, so 0.8 on the aperture; 720 corners. */
static struct shadow add_disc(struct built *built) {
  for (int k = 0; k < 720; ++k) {
    const double x[3][3] = {{0, 1, 0},
                            {0.4 * cos(M_PI / 360 * k), 1, 0.4 * sin(M_PI / 360 * k)},
                            {0.4 * cos(M_PI / 360 * (k + 1)), 1, 0.4 * sin(M_PI / 360 * (k + 1))}};
    add_triangle(built, x);
  }
  return (struct shadow){4 - 360 * 0.64 * sin(M_PI / 360), 1.6 * M_PI};
}

static void check_area(const struct occlusion *occlusion, const struct shadow *shadow, int edge,
                       struct visible *visible) {
  struct visible_query query = query_over(occlusion, 16, edge);
  visible->shadow_rays = 0;
  find(&query, visible);
  double cell = 2.0 / edge, found = area(&query, visible);
  assert_near(found, shadow->visible, shadow->edge * cell / 2);
  /* a few rays for each cell along the edge, and a rectangle for each row of them */
  double cells = 2 * shadow->edge / cell + 8; /* crossed by the edge */
  assert_true((double)visible->shadow_rays < 545 + 8 * cells);
  assert_true(visible->count <= 2 * edge + 2);
  /* what the shadow hides is what a mirrored aperture's mirrored shadow hides */
  struct visible_query mirrored = query;
  for (int c = 0; c < 3; ++c) {
    mirrored.along[0][c] = -query.along[1][c];
    mirrored.along[1][c] = query.along[0][c];
  }
  find(&mirrored, visible);
  assert_near(area(&mirrored, visible), found, cell * cell * 4);
}

/* The error of the area is at most the length of the shadow's edge times half a cell, and
 * falls with it. */
static void test_areas(void **state) {
  (void)state;
  struct visible visible = {0};
  for (int shape = 0; shape < 3; ++shape)
    for (int turn = 0; turn < 4; ++turn) {
      struct built *built = build_start(1, 0);
      double angle = 0.1 + turn;
      add_triangle(built, far_away);
      struct shadow shadow = shape == 0   ? add_half_plane(built, angle)
                             : shape == 1 ? add_square(built, angle)
                                          : add_disc(built);
      struct occlusion *occlusion = build_finish(built);
      for (int edge = 16; edge <= 1024; edge *= 4) check_area(occlusion, &shadow, edge, &visible);
      occlusion_free(occlusion);
      free(built);
    }
  visible_free(&visible);
}

/* Where the edges of the shadow are on the lattice the answer is exact, and few rectangles
 * tell it. */
static void test_aligned(void **state) {
  (void)state;
  struct built *built = build_start(1, 0);
  const double e = 1e-4; /* off the lattice, to the outside */
  const double x[4][3] = {{-0.25 - e, 1, -0.25 - e},
                          {0.25 + e, 1, -0.25 - e},
                          {0.25 + e, 1, 0.25 + e},
                          {-0.25 - e, 1, 0.25 + e}};
  add_triangle(built, far_away);
  add_quad(built, x);
  struct occlusion *occlusion = build_finish(built);
  struct visible visible = {0}, again = {0};
  struct visible_query query = query_over(occlusion, 8, 64);
  find(&query, &visible);
  assert_int_equal(visible.count, 4);
  assert_near(area(&query, &visible), 3, 1e-15);
  find(&query, &again);
  assert_int_equal(again.count, visible.count);
  assert_memory_equal(again.rectangles, visible.rectangles,
                      (size_t)visible.count * sizeof *visible.rectangles);
  query.edge = 8;
  find(&query, &again);
  assert_near(area(&query, &again), 3, 1e-15);
  query.whole = (struct visible_rectangle){{-1, -1e-9}, {1, 1e-9}}; /* a thin strip */
  query.edge = 64;
  find(&query, &again);
  assert_near(area(&query, &again) / 2e-9, 1, 1e-6);
  struct error error = {""};
  query.edge = 4;
  assert_int_equal(visible_find(&query, &again, &error), RESULT_BAD);
  query.edge = 1 << 20;
  assert_int_equal(visible_find(&query, &again, &error), RESULT_BAD);
  visible_free(&visible);
  visible_free(&again);
  occlusion_free(occlusion);
  free(built);
}

static void test_refused(void **state) {
  (void)state;
  struct built *built = build_start(1, 0);
  struct occlusion *occlusion = build_finish(built); /* nothing is there */
  struct occlusion_hit hit;
  const double zero[3] = {0, 0, 0}, up[3] = {0, 1, 0}, point[1][3] = {{0, 1, 0}};
  bool blocked = true;
  assert_false(occlusion_nearest(occlusion, zero, up, &hit));
  occlusion_blocked(occlusion, zero, point, 1, &blocked);
  assert_false(blocked);
  occlusion_free(occlusion);
  add_floor(built, 0, 1);
  built->position[2][1] = NAN;
  struct error error = {""};
  assert_int_equal(occlusion_create(&built->scene, &occlusion, &error), RESULT_BAD);
  assert_null(occlusion);
  free(built);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_no_acne),     cmocka_unit_test(test_no_leak),
      cmocka_unit_test(test_ceiling),     cmocka_unit_test(test_nearest),
      cmocka_unit_test(test_all_or_none), cmocka_unit_test(test_areas),
      cmocka_unit_test(test_aligned),     cmocka_unit_test(test_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
