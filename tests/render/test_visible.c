/* test_visible.c - the visible part of an aperture against exact areas. */
#include <stdlib.h>

#include "built.h"
#include "shadow/visible.h"
#include "testing.h"

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

TEST(test_all_or_none) {
  struct built *built = built_start(1, 0);
  built_triangle(built, far_away[0], far_away[1], far_away[2]);
  struct occlusion *open = built_occlusion(built);
  built_floor(built, 1, (const double[]){0, 0}, 5);
  struct occlusion *shut = built_occlusion(built);
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
  double missed;        /* area of what may hide between the rays of a block: corners */
};

/* Covers x cos + z sin > 0: half of the aperture. */
static struct shadow add_half_plane(struct built *built, double angle) {
  double ca = cos(angle), sa = sin(angle);
  const double x[4][3] = {{-9 * sa, 1, 9 * ca},
                          {9 * sa, 1, -9 * ca},
                          {9 * sa + 9 * ca, 1, -9 * ca + 9 * sa},
                          {-9 * sa + 9 * ca, 1, 9 * ca + 9 * sa}};
  built_quad(built, x);
  return (struct shadow){2, 2 * sqrt(2), 0};
}

/* Sides of 0.3, so 0.6 on the aperture. */
static struct shadow add_square(struct built *built, double angle) {
  double h = 0.15 * sqrt(2), x[4][3];
  for (int k = 0; k < 4; ++k) {
    x[k][0] = 0.1 + h * cos(angle + M_PI / 2 * k);
    x[k][1] = 1;
    x[k][2] = -0.07 + h * sin(angle + M_PI / 2 * k);
  }
  built_quad(built, (const double(*)[3])x);
  return (struct shadow){4 - 0.36, 2.4, 0.125 * 0.125 / 8};
}

/* Radius 0.4, so 0.8 on the aperture; 720 corners. */
static struct shadow add_disc(struct built *built) {
  for (int k = 0; k < 720; ++k) {
    const double from = M_PI / 360 * k, to = M_PI / 360 * (k + 1);
    built_triangle(built, (const double[]){0, 1, 0},
                   (const double[]){0.4 * cos(from), 1, 0.4 * sin(from)},
                   (const double[]){0.4 * cos(to), 1, 0.4 * sin(to)});
  }
  return (struct shadow){4 - 360 * 0.64 * sin(M_PI / 360), 1.6 * M_PI, 0};
}

static void check_area(const struct occlusion *occlusion, const struct shadow *shadow, int edge,
                       struct visible *visible) {
  struct visible_query query = query_over(occlusion, 16, edge);
  visible->shadow_rays = 0;
  find(&query, visible);
  double cell = 2.0 / edge;
  double most = shadow->edge * cell / 16 + shadow->missed;
  assert_near(area(&query, visible), shadow->visible, most);
  /* a few rays for each cell along the edge, and a rectangle for each row of them */
  double cells = 2 * shadow->edge / cell + 8; /* crossed by the edge */
  assert_true((double)visible->shadow_rays < 545 + 8 * cells);
  assert_true(visible->count <= 2 * edge + 2);
  /* and a mirrored aperture's mirrored shadow hides as much */
  struct visible_query mirrored = query;
  for (int c = 0; c < 3; ++c) {
    mirrored.along[0][c] = -query.along[1][c];
    mirrored.along[1][c] = query.along[0][c];
  }
  find(&mirrored, visible);
  assert_near(area(&mirrored, visible), shadow->visible, most);
}

/* The error of the area is at most the length of the shadow's edge times 1/16 of a cell, and falls
 * with it. */
TEST(test_areas) {
  struct visible visible = {0};
  for (int shape = 0; shape < 3; ++shape)
    for (int turn = 0; turn < 4; ++turn) {
      struct built *built = built_start(1, 0);
      double angle = 0.1 + turn;
      built_triangle(built, far_away[0], far_away[1], far_away[2]);
      struct shadow shadow = shape == 0   ? add_half_plane(built, angle)
                             : shape == 1 ? add_square(built, angle)
                                          : add_disc(built);
      struct occlusion *occlusion = built_occlusion(built);
      for (int edge = 16; edge <= 1024; edge *= 4) check_area(occlusion, &shadow, edge, &visible);
      occlusion_free(occlusion);
      free(built);
    }
  visible_free(&visible);
}

/* An edge along the aperture's sides, anywhere in a cell: the worst case of cells that their
 * middles decide. */
TEST(test_along) {
  for (int turn = 0; turn < 4; ++turn) {
    struct built *built = built_start(1, 0);
    built_triangle(built, far_away[0], far_away[1], far_away[2]);
    add_half_plane(built, M_PI / 2 * turn);
    struct occlusion *occlusion = built_occlusion(built);
    struct visible visible = {0};
    struct visible_query query = query_over(occlusion, 8, 64);
    const double cell = 2.0 / 64;
    for (int step = 1; step < 20; ++step) {
      double off = cell * step / 20, right = 2 * (turn < 2 ? 1 - off : 1 + off);
      query.whole = (struct visible_rectangle){{off - 1, off - 1}, {off + 1, off + 1}};
      find(&query, &visible);
      assert_int_equal(visible.count, 1);
      assert_near(area(&query, &visible), right, 2 * cell / 16 + 1e-6);
    }
    visible_free(&visible);
    occlusion_free(occlusion);
    free(built);
  }
}

/* Where the edges of the shadow are on the lattice few rectangles tell it. */
TEST(test_aligned) {
  struct built *built = built_start(1, 0);
  const double e = 1e-4; /* off the lattice, to the outside */
  const double x[4][3] = {{-0.25 - e, 1, -0.25 - e},
                          {0.25 + e, 1, -0.25 - e},
                          {0.25 + e, 1, 0.25 + e},
                          {-0.25 - e, 1, 0.25 + e}};
  built_triangle(built, far_away[0], far_away[1], far_away[2]);
  built_quad(built, x);
  struct occlusion *occlusion = built_occlusion(built);
  struct visible visible = {0}, again = {0};
  struct visible_query query = query_over(occlusion, 8, 64);
  find(&query, &visible);
  assert_int_equal(visible.count, 4);
  assert_near(area(&query, &visible), 3, 4 * 2.0 / 64 / 16);
  find(&query, &again);
  assert_int_equal(again.count, visible.count);
  assert_memory_equal(again.rectangles, visible.rectangles,
                      (size_t)visible.count * sizeof *visible.rectangles);
  query.edge = 8;
  find(&query, &again);
  assert_near(area(&query, &again), 3, 4 * 2.0 / 8 / 16);
  query.whole = (struct visible_rectangle){{-1, -1e-9}, {1, 1e-9}}; /* a thin strip */
  query.edge = 64;
  find(&query, &again);
  assert_near(area(&query, &again) / 2e-9, 1, 2 * 2.0 / 64 / 16 + 1e-6);
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

int main(void) {
  return testing_run(NULL, NULL);
}
