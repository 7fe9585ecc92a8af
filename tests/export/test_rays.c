/* test_rays.c - ray files of a slab: the flux through each half of the aperture into each half of
 * the window, against sums over the slab; and TM-25 against the text. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lamps.h"
#include "oracle/lookup.h"
#include "oracle/random.h"
#include "testing.h"

enum { RAYS = 20000, GRID = 14, BINS = 16 };

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Which halves along a, b, s and t. */
static int bin_of(const struct slab *slab, const double abst[4]) {
  const double *w = slab->st_window;
  return (abst[0] > 0) + 2 * (abst[1] > 0) + 4 * (abst[2] > (w[0] + w[1]) / 2) +
         8 * (abst[3] > (w[2] + w[3]) / 2);
}

/* Luminance times cosine, by the middles of cells: a, b, s and t take GRID values each. */
static void integrate(const struct slab *slab, double flux[BINS]) {
  const double *w = slab->st_window;
  double u = sqrt(dot(slab->u, slab->u)), v = sqrt(dot(slab->v, slab->v));
  double kappa = isinf(slab->st_distance) ? 0 : 1 / slab->st_distance;
  double volume = u * v * (w[1] - w[0]) * (w[3] - w[2]) / pow(GRID, 4);
  memset(flux, 0, BINS * sizeof *flux);
  for (int k = 0; k < GRID * GRID * GRID * GRID; ++k) {
    double at[4], rgb[3];
    for (int axis = 0, rest = k; axis < 4; ++axis, rest /= GRID)
      at[axis] = (rest % GRID + 0.5) / GRID;
    const double abst[4] = {(at[0] - 0.5) * u, (at[1] - 0.5) * v, w[0] + at[2] * (w[1] - w[0]),
                            w[2] + at[3] * (w[3] - w[2])};
    oracle_lookup(slab, abst, rgb);
    double p = abst[2] - kappa * abst[0], q = abst[3] - kappa * abst[1], r2 = 1 + p * p + q * q;
    flux[bin_of(slab, abst)] +=
        volume * (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) / (r2 * r2);
  }
}

/* The rays of a text file. */
static void read_rays(const char *path, double (*rays)[7]) {
  char line[512];
  FILE *in = fopen(path, "r");
  assert_non_null(in);
  int count = 0;
  while (fgets(line, sizeof line, in)) {
    if (line[0] == '#') continue;
    assert_true(count < RAYS);
    double *r = rays[count++];
    assert_int_equal(
        sscanf(line, "%lf %lf %lf %lf %lf %lf %lf", r, r + 1, r + 2, r + 3, r + 4, r + 5, r + 6),
        7);
  }
  fclose(in);
  assert_int_equal(count, RAYS);
}

static double rays[RAYS][7];

static const char *prepare(const struct lamp *lamp, struct slab pages[LAMP_PAGES]) {
  const char *path = lamp_write(lamp, pages);
  read_rays(lamp_export(path, "rays.txt", "--rays 20000"), rays);
  return path;
}

/* A ray of the page, by its normal: two pages face away from each other. */
static const struct slab *page_of(const struct lamp *lamp, const struct slab *pages,
                                  const double ray[7]) {
  for (int k = 0; k < lamp->pages; ++k)
    if (dot(ray + 3, pages[k].normal) > 0) return &pages[k];
  fail_msg("a ray leaves no page");
  return pages;
}

TEST(flux_where_the_slab_has_it) {
  for (int n = 0; n < lamp_count; ++n) {
    const struct lamp *lamp = &lamps[n];
    struct slab pages[LAMP_PAGES];
    double wanted[LAMP_PAGES][BINS] = {{0}}, got[LAMP_PAGES][BINS] = {{0}}, all = 0;
    prepare(lamp, pages);
    for (int k = 0; k < lamp->pages; ++k) integrate(&pages[k], wanted[k]);
    for (int k = 0; k < RAYS; ++k) {
      const struct slab *page = page_of(lamp, pages, rays[k]);
      const double *ray = rays[k], *w = page->st_window;
      double u = sqrt(dot(page->u, page->u)), v = sqrt(dot(page->v, page->v)), from[3];
      double cosine = dot(ray + 3, page->normal),
             kappa = isinf(page->st_distance) ? 0 : 1 / page->st_distance;
      for (int c = 0; c < 3; ++c) from[c] = ray[c] - page->center[c];
      double a = dot(from, page->u) / u, b = dot(from, page->v) / v;
      const double abst[4] = {a, b, dot(ray + 3, page->u) / u / cosine + kappa * a,
                              dot(ray + 3, page->v) / v / cosine + kappa * b};
      assert_near(dot(from, page->normal), 0, 1e-6);
      assert_true(fabs(a) <= u / 2 + 1e-6 && fabs(b) <= v / 2 + 1e-6);
      assert_true(abst[2] > w[0] - 1e-6 && abst[2] < w[1] + 1e-6);
      assert_true(abst[3] > w[2] - 1e-6 && abst[3] < w[3] + 1e-6);
      got[page - pages][bin_of(page, abst)] += ray[6];
      all += ray[6];
    }
    for (int k = 0; k < lamp->pages; ++k)
      for (int bin = 0; bin < BINS; ++bin) /* noise of 20000 rays is some 0.2 % */
        assert_near(got[k][bin] / all, wanted[k][bin] / all, 0.008);
    lamp_free(pages);
  }
}

/* Little-endian, 28 bytes a ray behind 288 + 36000; millimetres. */
TEST(tm25_is_the_text) {
  struct slab pages[LAMP_PAGES];
  const char *path = prepare(&lamps[1], pages);
  lamp_free(pages);
  FILE *in = fopen(lamp_export(path, "rays.tm25ray", "--rays 20000"), "rb");
  char type[5] = "";
  float ray[7];
  assert_non_null(in);
  assert_int_equal(fread(type, 1, 4, in), 4);
  assert_string_equal(type, "TM25");
  assert_int_equal(fseek(in, 288 + 36000, SEEK_SET), 0);
  for (int k = 0; k < RAYS; ++k) {
    assert_int_equal(fread(ray, sizeof ray, 1, in), 1);
    for (int n = 0; n < 7; ++n) {
      double wanted = rays[k][n] * (n < 3 ? 1000 : 1);
      assert_near((double)ray[n], wanted, 1e-6 * fmax(fabs(wanted), n < 3 ? 100 : 1e-4));
    }
  }
  assert_int_equal(fgetc(in), EOF);
  fclose(in);
}

int main(void) {
  return testing_run(NULL, NULL);
}
