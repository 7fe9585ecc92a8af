/* test_ray_pages.c - apertures for rays: where they are laid, how large, and which ray goes to
 * which. */
#include <string.h>

#include "helpers.h"
#include "import/rays/ray_lay.h"
#include "oracle/random.h"

enum { RAYS = 20000, KEPT = 1000 };

static struct ray rays[RAYS];

/* Lambertian about the direction along an axis. */
static void set_lambertian(struct ray *ray, int axis, double sign, uint64_t *seed) {
  double r = sqrt(random_number(seed)), angle = random_between(seed, 0, 6.283185307179586);
  ray->direction[axis] = sign * sqrt(1 - r * r);
  ray->direction[(axis + 1) % 3] = r * cos(angle);
  ray->direction[(axis + 2) % 3] = r * sin(angle);
  for (int c = 0; c < 3; ++c) ray->flux[c] = 1.0 / RAYS;
}

static struct ray_look look_at_all(void) {
  struct ray_look look;
  struct error error = {{0}};
  assert_ok(ray_look_new(&look, RAYS, &error), &error);
  for (int n = 0; n < RAYS; n += 1000) ray_look_add(&look, rays + n, 1000);
  return look;
}

/* The part of the flux that reaches pages. Where a ray is said to cross its page is on its line. */
static double flux_to_pages(const struct ray_pages *pages) {
  double flux = 0, abst[SLAB_AXES];
  for (int n = 0; n < RAYS; ++n) {
    int found = ray_pages_find(pages, &rays[n], abst);
    if (found < 0) continue;
    const struct ray_page *page = &pages->page[found];
    const struct slab *slab = &page->geometry;
    double point[3], to[3], along = 0, off = 0, forward = 0;
    for (int c = 0; c < 3; ++c) {
      point[c] = slab->center[c] + abst[0] * page->u[c] + abst[1] * page->v[c];
      to[c] = point[c] - rays[n].origin[c];
      along += to[c] * rays[n].direction[c];
      forward += rays[n].direction[c] * slab->normal[c];
    }
    for (int c = 0; c < 3; ++c) {
      double slope = slab->normal[c] + abst[2] * page->u[c] + abst[3] * page->v[c];
      off = fmax(off, fabs(to[c] - along * rays[n].direction[c]));
      assert_near(slope * forward, rays[n].direction[c], 1e-9);
    }
    assert_true(off < 5e-6);
    flux += rays[n].flux[1];
  }
  return flux;
}

/* A flat lamp's best rectangle is the lamp, which shines to 1/800 of the light beyond each end of
 * the window: at the slope sqrt(200), for one that is Lambertian. */
TEST(test_flat) {
  uint64_t seed = 1;
  struct error error = {{0}};
  struct ray_pages pages;
  for (int n = 0; n < RAYS; ++n) {
    rays[n] =
        (struct ray){{random_between(&seed, -1, 3), 0.25, random_between(&seed, 0, 0.5)}, {0}, {0}};
    set_lambertian(&rays[n], 1, -1, &seed);
  }
  for (int box = 0; box < 2; ++box) {
    struct ray_look look = look_at_all();
    assert_ok((box ? ray_lay_box : ray_lay_best)(&look, &pages, &error), &error);
    assert_ok(ray_lay_windows(&look, &pages, &error), &error);
    ray_look_free(&look);
    const struct slab *page = &pages.page[0].geometry;
    assert_int_equal(pages.count, 1);
    assert_near(page->normal[1], -1, 0);
    assert_near(page->center[0], 1, 1e-3);
    assert_near(page->center[1], 0.25, 0);
    assert_near(page->center[2], 0.25, 1e-4);
    assert_near(fmax(fabs(page->u[0]), fabs(page->v[0])), 4, 4e-3);
    assert_near(fmax(fabs(page->u[2]), fabs(page->v[2])), 0.5, 5e-4);
    for (int k = 0; k < 4; ++k) assert_near(fabs(page->st_window[k]), sqrt(200), 4);
    assert_near(flux_to_pages(&pages), 1, 1e-9);
  }
}

/* Rays that start on a sphere around a small disc which they come from: the best rectangle is at
 * the disc, and of its size. */
TEST(test_virtual_focus) {
  uint64_t seed = 2;
  struct error error = {{0}};
  struct ray_pages pages;
  for (int n = 0; n < RAYS; ++n) {
    double r = sqrt(random_number(&seed)), angle = random_between(&seed, 0, 6.283185307179586);
    const double from[3] = {2 + 0.1 * r * cos(angle), 5, 0.1 * r * sin(angle)};
    set_lambertian(&rays[n], 1, 1, &seed);
    for (int c = 0; c < 3; ++c)
      rays[n].origin[c] = from[c] + (3 + 0.2 * n / RAYS) * rays[n].direction[c];
  }
  struct ray_look look = look_at_all();
  assert_ok(ray_lay_best(&look, &pages, &error), &error);
  ray_look_free(&look);
  const struct slab *page = &pages.page[0].geometry;
  assert_int_equal(pages.count, 1);
  assert_near(page->normal[1], 1, 0);
  assert_near(page->center[0], 2, 0.01);
  assert_near(page->center[1], 5, 0.01);
  assert_near(page->center[2], 0, 0.01);
  for (int c = 0; c < 3; c += 2) assert_near(fabs(page->u[c]) + fabs(page->v[c]), 0.2, 0.02);
  assert_true(flux_to_pages(&pages) > 0.98);
}

/* The sides of a box that shines to five sides: its faces, each with its own light. Most rays start
 * within it or behind it, on the lines on which they leave. */
TEST(test_box) {
  static const double low[3] = {-1, 0, 2}, high[3] = {1, 4, 2.5};
  uint64_t seed = 3;
  struct error error = {{0}};
  struct ray_pages pages;
  double flux[3][2] = {{0}}, abst[SLAB_AXES];
  int faces[RAYS];
  for (int n = 0; n < RAYS; ++n) {
    int face = faces[n] = 1 + random_choose(&seed, 5), axis = face / 2;
    for (int c = 0; c < 3; ++c) rays[n].origin[c] = random_between(&seed, low[c], high[c]);
    rays[n].origin[axis] = face % 2 ? high[axis] : low[axis];
    set_lambertian(&rays[n], axis, face % 2 ? 1 : -1, &seed);
    flux[axis][face % 2] += 1.0 / RAYS;
  }
  struct ray_look look = look_at_all();
  assert_ok(ray_lay_box(&look, &pages, &error), &error);
  ray_look_free(&look);
  assert_int_equal(pages.count, 5);
  assert_near(flux_to_pages(&pages), 1, 1e-9);
  for (int n = 0; n < RAYS; ++n) { /* from elsewhere on their lines */
    double back = random_between(&seed, -1, 3);
    for (int c = 0; c < 3; ++c) rays[n].origin[c] -= back * rays[n].direction[c];
    int found = ray_pages_find(&pages, &rays[n], abst);
    assert_true(found >= 0);
    assert_near(pages.page[found].geometry.normal[faces[n] / 2], faces[n] % 2 ? 1 : -1, 0);
  }
}

/* Of two pages that a ray crosses, that which is closer to where it starts has it. */
TEST(test_closest) {
  static const double u[3] = {1, 0, 0}, v[3] = {0, 0, 1}, down[3] = {0, -2, 0};
  struct ray_pages pages = {0};
  struct error error = {{0}};
  struct ray ray = {{0.2, 0.1, 0}, {0, -1, 0}, {1, 1, 1}};
  double abst[SLAB_AXES];
  assert_ok(ray_pages_add(&pages, (const double[]){0, 0, 0}, u, v, down, &error), &error);
  assert_ok(ray_pages_add(&pages, (const double[]){0, -1, 0}, u, v, down, &error), &error);
  assert_int_equal(ray_pages_find(&pages, &ray, abst), 0);
  assert_near(abst[0], 0.2, 1e-6);
  ray.origin[1] = -0.6;
  assert_int_equal(ray_pages_find(&pages, &ray, abst), 1);
  ray.origin[1] = -3; /* behind it, it is carried back */
  assert_int_equal(ray_pages_find(&pages, &ray, abst), 1);
  ray.direction[1] = 1; /* inwards */
  assert_int_equal(ray_pages_find(&pages, &ray, abst), -1);
  ray = (struct ray){{0.6, 0.1, 0}, {0, -1, 0}, {1, 1, 1}}; /* beside */
  assert_int_equal(ray_pages_find(&pages, &ray, abst), -1);
  ray = (struct ray){{0, 0, 0}, {1, 0, 0}, {1, 1, 1}}; /* along */
  assert_int_equal(ray_pages_find(&pages, &ray, abst), -1);
  assert_refused(ray_pages_add(&pages, u, u, u, down, &error), &error, "page 3", NULL);
  assert_refused(ray_pages_add(&pages, u, u, v, (const double[]){0, 0, 0}, &error), &error,
                 "page 3", NULL);
}

/* Rays that are all alike have a page and a window all the same. */
TEST(test_one_line) {
  struct error error = {{0}};
  struct ray_pages pages;
  for (int n = 0; n < RAYS; ++n)
    rays[n] = (struct ray){{3, 4, 5}, {0.6, 0, -0.8}, {1.0 / RAYS, 1.0 / RAYS, 1.0 / RAYS}};
  for (int box = 0; box < 2; ++box) {
    struct ray_look look = look_at_all();
    assert_ok((box ? ray_lay_box : ray_lay_best)(&look, &pages, &error), &error);
    assert_ok(ray_lay_windows(&look, &pages, &error), &error);
    ray_look_free(&look);
    assert_int_equal(pages.count, 1);
    assert_ok(slab_check(&pages.page[0].geometry, &error), &error);
    assert_near(flux_to_pages(&pages), 1, 1e-9);
  }
  /* And a page that none of them reaches is refused. */
  pages.count = 0;
  assert_ok(ray_pages_add(&pages, (const double[]){9, 9, 9}, (const double[]){1, 0, 0},
                          (const double[]){0, 1, 0}, (const double[]){0, 0, -1}, &error),
            &error);
  struct ray_look look = look_at_all();
  assert_refused(ray_lay_windows(&look, &pages, &error), &error, "page 1", "no ray", NULL);
  ray_look_free(&look);
}

/* What is kept of many rays is evenly taken from all. */
TEST(test_kept) {
  struct ray_look look;
  struct error error = {{0}};
  struct ray ray = {{0}, {0, 0, 1}, {1, 1, 1}};
  assert_ok(ray_look_new(&look, KEPT, &error), &error);
  for (int n = 0; n < 5 * KEPT + 7; ++n) {
    ray.origin[0] = n;
    ray_look_add(&look, &ray, 1);
  }
  assert_int_equal(look.rays, 5 * KEPT + 7);
  assert_int_equal(look.every, 8);
  assert_int_equal(look.kept_count, (5 * KEPT + 7 + 7) / 8);
  for (size_t n = 0; n < look.kept_count; ++n)
    assert_near(look.kept[n].origin[0], 8.0 * (double)n, 0);
  assert_near(look.high[0], 5.0 * KEPT + 6, 0);
  ray_look_free(&look);
}

int main(void) {
  return testing_run(NULL, NULL);
}
