/* test_limits.c - the limits of a light slab's irradiance: at the uv plane and
 * behind it, on the lines of the grid, in any units; and what is linear: pages,
 * lights, gain, samples. Placements against receivers moved by hand. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "helpers.h"
#include "oracle/oracle.h"

enum { COUNT = 48 };

static const int grid[SLAB_AXES] = {4, 3, 6, 5};
static const double ordinary[4] = {-0.7, 1.1, -0.9, 0.6};
static const char *const methods[] = {"reference", "closed", "pi", "midpoint", "paper"};
enum { METHODS = sizeof methods / sizeof methods[0] };

/* Nine printed digits round by up to 5e-9; two of them by twice that. */
#define PRINTED 5.1e-9

static void aim_all(const struct slab *slab, struct surfel receivers[COUNT], uint64_t seed) {
  aim(slab, (const double[]){0.05, 10}, RECEIVER_KINDS, &seed, receivers, COUNT);
}

/* |a - b| <= tolerance * scale in each channel of each receiver. */
static void assert_close(double a[][3], double b[][3], int count, double tolerance) {
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < 3; ++c)
      assert_near(a[k][c], b[k][c], tolerance * fmax(fabs(a[k][c]), fabs(b[k][c])));
}

static void assert_oracle(double rgb[][3], const struct slab *slab, const struct surfel *receivers,
                          int count, double tolerance) {
  for (int k = 0; k < count; ++k) {
    struct oracle_value value = oracle_irradiance(slab, receivers[k].p, receivers[k].n);
    for (int c = 0; c < 3; ++c)
      assert_near(rgb[k][c], (double)value.e[c], tolerance * (double)fabsl(value.e[c]));
  }
}

/* ---- The uv plane. */

/* From above, a point of the aperture is all directions: what is left is the
 * integral over the window. */
TEST(test_touching) {
  static const double distances[] = {INFINITY, 0.7};
  for (int d = 0; d < 2; ++d) {
    struct slab slab = rough_slab(grid, distances[d], ordinary, FRAME_PLAIN, FILL_UNIFORM, 3);
    const char *light = write_light("touch.exr", &slab, 1);
    struct surfel at[COUNT], above[COUNT];
    double touching[COUNT][3], near[COUNT][3];
    uint64_t seed = 5;
    for (int k = 0; k < COUNT; ++k) {
      at[k] = (struct surfel){{0}, {0, 0, -1}};
      if (k % 2) random_direction(&seed, at[k].n);
      for (int c = 0; c < 2; ++c) at[k].p[c] = random_between(&seed, -0.499, 0.499);
      above[k] = at[k];
      above[k].p[2] = 1e-12;
    }
    irradiance(at, COUNT, touching, "--light '%s' --method reference", light);
    irradiance(above, COUNT, near, "--light '%s' --method reference", light);
    assert_oracle(touching, &slab, at, COUNT, 1e-6);
    assert_oracle(near, &slab, above, COUNT, 1e-6);
    assert_close(touching, near, COUNT, 2e-6);
    slab_free(&slab);
  }
}

TEST(test_beside_and_behind) {
  static const double distances[] = {INFINITY, 0.7};
  for (int d = 0; d < 2; ++d)
    for (int m = 0; m < METHODS; ++m) {
      struct slab slab = rough_slab(grid, distances[d], ordinary, FRAME_PLAIN, FILL_UNIFORM, 3);
      const char *light = write_light("dark.exr", &slab, 1);
      struct surfel receivers[COUNT] = {{{0}, {0}}};
      double rgb[COUNT][3];
      uint64_t seed = 7;
      for (int k = 0; k < COUNT; ++k) {
        double *p = receivers[k].p, far = 0.5 + random_log(&seed, 1e-3, 1e3);
        for (int c = 0; c < 3; ++c) p[c] = random_between(&seed, -2, 2);
        p[2] = k % 3 == 0 ? 0 : -far;
        if (p[2] == 0) p[k & 1] = k & 2 ? far : -far;
        random_direction(&seed, receivers[k].n);
      }
      irradiance(receivers, COUNT, rgb, "--light '%s' --method %s", light, methods[m]);
      for (int k = 0; k < COUNT; ++k)
        for (int c = 0; c < 3; ++c) assert_true(rgb[k][c] == 0);
      slab_free(&slab);
    }
}

/* ---- Lines of the grids under the receiver, and coinciding with each other:
 * cells of 1/8 in uv and in st, the foot on one of them. At distance 2 there
 * are receivers on the st plane too. Beside that plane more lines of st cross
 * the aperture: more micro lights, so other samples of them. */
TEST(test_on_lines) {
  static const double window[4] = {-0.5, 0.5, -0.5, 0.5}, distances[] = {INFINITY, 16, 2};
  for (int d = 0; d < 3; ++d)
    for (int m = 0; m < (d == 2 ? 2 : 4); ++m) {
      struct slab slab =
          rough_slab((const int[]){8, 8, 8, 8}, distances[d], window, FRAME_PLAIN, FILL_EXTREME, 4);
      const char *light = write_light("lines.exr", &slab, 1);
      struct surfel at[COUNT], beside[COUNT];
      double on[COUNT][3], off[COUNT][3];
      for (int k = 0; k < COUNT; ++k) {
        at[k] = (struct surfel){{(k % 9 - 4) / 16.0, (k % 7 - 3) / 16.0, ldexp(1, k % 5 - 2)},
                                {0.25, 0.125 * (k % 3), -1}};
        vector_normalise(at[k].n);
        beside[k] = at[k];
        for (int c = 0; c < 3; ++c) beside[k].p[c] = nextafter(at[k].p[c], k & (1 << c) ? 9 : -9);
      }
      irradiance(at, COUNT, on, "--light '%s' --method %s", light, methods[m]);
      irradiance(beside, COUNT, off, "--light '%s' --method %s", light, methods[m]);
      assert_close(on, off, COUNT, 2 * PRINTED);
      if (m < 2) assert_oracle(on, &slab, at, COUNT, 1e-6);
      slab_free(&slab);
    }
}

/* ---- Units. */

static void scale_vector(double a[3], double by) {
  for (int k = 0; k < 3; ++k) a[k] *= by;
}

TEST(test_units) {
  static const double distances[] = {INFINITY, 0.7}, factors[] = {0x1p40, 0x1p-40};
  for (int d = 0; d < 2; ++d)
    for (int f = 0; f < 2; ++f)
      for (int m = 0; m < METHODS; ++m) {
        double by = factors[f];
        struct slab slab = rough_slab(grid, distances[d], ordinary, FRAME_TURNED, FILL_UNIFORM, 6);
        struct surfel receivers[COUNT];
        double plain[COUNT][3], stored[COUNT][3], placed[COUNT][3];
        aim_all(&slab, receivers, 11);
        const char *light = write_light("unit.exr", &slab, 1);
        irradiance(receivers, COUNT, plain, "--light '%s' --method %s", light, methods[m]);
        for (int k = 0; k < COUNT; ++k) scale_vector(receivers[k].p, by);
        irradiance(receivers, COUNT, placed, "--light '%s scale=%.17g' --method %s", light, by,
                   methods[m]);
        scale_vector(slab.center, by), scale_vector(slab.u, by), scale_vector(slab.v, by);
        slab.st_distance *= by;
        light = write_light("scaled.exr", &slab, 1);
        irradiance(receivers, COUNT, stored, "--light '%s' --method %s", light, methods[m]);
        assert_memory_equal(plain, stored, sizeof plain);
        assert_memory_equal(plain, placed, sizeof plain);
        slab_free(&slab);
      }
}

/* ---- What is linear. */

TEST(test_pages) {
  struct slab slabs[2] = {
      rough_slab(grid, INFINITY, ordinary, FRAME_TURNED, FILL_UNIFORM, 1),
      rough_slab((const int[]){1, 2, 3, 8}, 0.7, ordinary, FRAME_MIRRORED, FILL_EXTREME, 2)};
  memcpy(slabs[1].center, slabs[0].center, sizeof slabs[0].center);
  memcpy(slabs[1].normal, slabs[0].normal, sizeof slabs[0].normal);
  memcpy(slabs[1].u, slabs[0].v, sizeof slabs[0].u); /* mirrored */
  memcpy(slabs[1].v, slabs[0].u, sizeof slabs[0].v);
  struct surfel receivers[COUNT];
  double each[2][COUNT][3], both[COUNT][3], sum[COUNT][3], lights[COUNT][3];
  aim_all(&slabs[0], receivers, 21);
  const char *first = write_light("first.exr", &slabs[0], 1);
  const char *second = write_light("second.tif", &slabs[1], 1);
  const char *all = write_light("both.tif", slabs, 2);
  irradiance(receivers, COUNT, each[0], "--light '%s' --method reference", first);
  irradiance(receivers, COUNT, each[1], "--light '%s' --method reference", second);
  irradiance(receivers, COUNT, both, "--light '%s' --method reference", all);
  irradiance(receivers, COUNT, lights, "--light '%s' --light '%s' --method reference", first,
             second);
  int seen = 0;
  for (int k = 0; k < COUNT; ++k)
    for (int c = 0; c < 3; ++c) {
      sum[k][c] = each[0][k][c] + each[1][k][c];
      seen += each[0][k][c] > 0 && each[1][k][c] > 0;
    }
  assert_true(seen > 0);
  assert_close(both, sum, COUNT, 2 * PRINTED);
  assert_close(lights, sum, COUNT, 2 * PRINTED);
  slab_free(&slabs[0]), slab_free(&slabs[1]);
}

TEST(test_gain) {
  static const double gains[] = {0.5, 3, 1e-20, 1e20, 0};
  struct slab slab = rough_slab(grid, 0.7, ordinary, FRAME_TURNED, FILL_UNIFORM, 1);
  struct surfel receivers[COUNT];
  double one[COUNT][3], other[COUNT][3];
  aim_all(&slab, receivers, 23);
  const char *light = write_light("gain.exr", &slab, 1);
  for (int m = 0; m < METHODS; ++m) {
    irradiance(receivers, COUNT, one, "--light '%s' --method %s", light, methods[m]);
    for (int g = 0; g < 5; ++g) {
      double expected[COUNT][3];
      for (int k = 0; k < COUNT; ++k)
        for (int c = 0; c < 3; ++c) expected[k][c] = gains[g] * one[k][c];
      irradiance(receivers, COUNT, other, "--light '%s gain=%g' --method %s", light, gains[g],
                 methods[m]);
      assert_close(other, expected, COUNT, 2 * PRINTED);
    }
    for (int k = 0; k < COUNT; ++k)
      for (int c = 0; c < 3; ++c) one[k][c] *= gains[c];
    irradiance(receivers, COUNT, other, "--light '%s gain=0.5,3,1e-20' --method %s", light,
               methods[m]);
    assert_close(other, one, COUNT, 2 * PRINTED);
  }
  slab_free(&slab);
}

/* Relative. One sample a micro light is summed in single precision. */
static const double negative_rounding[METHODS] = {2e-6, 2 * PRINTED, 1e-6, 1e-6, 1e-6};

/* c = a - 2 b in the samples, exactly: 24 bits hold multiples of 1/1024. */
TEST(test_negative_samples) {
  struct slab slabs[3];
  struct surfel receivers[COUNT];
  double rgb[3][COUNT][3];
  for (int s = 0; s < 3; ++s) {
    slabs[s] = rough_slab(grid, 0.7, ordinary, FRAME_TURNED, FILL_UNIFORM, 1);
    fill_slab(&slabs[s], FILL_UNIFORM, (uint64_t)s + 40);
    for (size_t k = 0; k < 3 * slab_sample_count(&slabs[s]); ++k)
      slabs[s].rgb[k] =
          s < 2 ? rintf(1024 * slabs[s].rgb[k]) / 1024 : slabs[0].rgb[k] - 2 * slabs[1].rgb[k];
  }
  aim_all(&slabs[0], receivers, 29);
  for (int m = 0; m < METHODS; ++m) {
    for (int s = 0; s < 3; ++s) {
      const char *light = write_light("signed.exr", &slabs[s], 1);
      irradiance(receivers, COUNT, rgb[s], "--light '%s' --method %s", light, methods[m]);
    }
    int negative = 0;
    for (int k = 0; k < COUNT; ++k)
      for (int c = 0; c < 3; ++c) {
        double a = rgb[0][k][c], b = rgb[1][k][c], one = negative_rounding[m];
        assert_near(rgb[2][k][c], a - 2 * b, one * (a + 2 * b));
        negative += rgb[2][k][c] < 0;
      }
    assert_true(negative > COUNT);
  }
  for (int s = 0; s < 3; ++s) slab_free(&slabs[s]);
}

/* ---- Placement: receivers made in lamp space, moved by hand. */

/* Rows: images of x, y, z, then of the origin. */
static void place(const double matrix[4][3], double scale, const struct surfel *from,
                  struct surfel *to) {
  for (int c = 0; c < 3; ++c) {
    to->p[c] = matrix[3][c];
    to->n[c] = 0;
    for (int k = 0; k < 3; ++k) {
      to->p[c] += from->p[k] * matrix[k][c];
      to->n[c] += from->n[k] * matrix[k][c] / scale;
    }
  }
}

/* Unit vectors: forward, up made perpendicular to it, and their cross product. */
static void triad(const double forward[3], const double up[3], double to[3][3]) {
  memcpy(to[0], forward, sizeof to[0]);
  vector_normalise(to[0]);
  double along = vector_dot(up, to[0]);
  for (int k = 0; k < 3; ++k) to[1][k] = up[k] - along * to[0][k];
  vector_normalise(to[1]);
  vector_cross(to[0], to[1], to[2]);
}

struct placement {
  double at[3], toward[3], up[3], scale;
};

/* The turn that takes the first page's (normal, v) to (toward - at, up). */
static void placement_matrix(const struct placement *where, const struct slab *slab,
                             double matrix[4][3]) {
  double forward[3], from[3][3], to[3][3];
  vector_subtract(where->toward, where->at, forward);
  triad(slab->normal, slab->v, from);
  triad(forward, where->up, to);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      matrix[r][c] = 0;
      for (int k = 0; k < 3; ++k) matrix[r][c] += where->scale * from[k][r] * to[k][c];
    }
  memcpy(matrix[3], where->at, sizeof matrix[3]);
}

static const struct placement placements[] = {{{0, 0, 0}, {0, -1, 0}, {0, 0, 1}, 1},
                                              {{3, -2, 7}, {1, 1, 1}, {0.2, 1, 0.3}, 2.5},
                                              {{-10, 4, 0.5}, {-10, 4, -8}, {1, 0, 0}, 0.125}};

TEST(test_placement) {
  for (int p = 0; p < 3; ++p)
    for (int f = 0; f < 3; ++f) {
      const struct placement *w = &placements[p];
      struct slab slab = rough_slab(grid, f == 1 ? 0.7 : INFINITY, ordinary, (enum frame)f,
                                    FILL_EXTREME, (uint64_t)(p + 50));
      struct surfel receivers[COUNT], placed[COUNT];
      double matrix[4][3], rgb[COUNT][3];
      aim_all(&slab, receivers, (uint64_t)(60 + f));
      placement_matrix(w, &slab, matrix);
      for (int k = 0; k < COUNT; ++k) place(matrix, w->scale, &receivers[k], &placed[k]);
      const char *light = write_light("placed.exr", &slab, 1);
      irradiance(placed, COUNT, rgb,
                 "--light '%s scale=%.17g at=%.17g,%.17g,%.17g toward=%.17g,%.17g,%.17g "
                 "up=%.17g,%.17g,%.17g' --method reference",
                 light, w->scale, w->at[0], w->at[1], w->at[2], w->toward[0], w->toward[1],
                 w->toward[2], w->up[0], w->up[1], w->up[2]);
      assert_oracle(rgb, &slab, receivers, COUNT, 1.1e-6);
      slab_free(&slab);
    }
}

/* Turned, moved, scaled by 1.5, and mirrored where `mirrored`. */
static void any_matrix(bool mirrored, uint64_t seed, double matrix[4][3]) {
  random_frame(&seed, mirrored ? -1 : 1, matrix);
  for (int r = 0; r < 3; ++r) scale_vector(matrix[r], 1.5);
  for (int c = 0; c < 3; ++c) matrix[3][c] = random_between(&seed, -10, 10);
}

TEST(test_matrix) {
  for (int mirrored = 0; mirrored < 2; ++mirrored)
    for (int f = 0; f < 3; ++f) {
      struct slab slab = rough_slab(grid, f == 1 ? INFINITY : 0.7, ordinary, (enum frame)f,
                                    FILL_EXTREME, (uint64_t)(70 + f));
      struct surfel receivers[COUNT], placed[COUNT];
      double m[4][3], rgb[COUNT][3];
      aim_all(&slab, receivers, (uint64_t)(80 + f));
      any_matrix(mirrored, (uint64_t)(90 + f), m);
      for (int k = 0; k < COUNT; ++k) place(m, 1.5, &receivers[k], &placed[k]);
      const char *light = write_light("matrix.exr", &slab, 1);
      irradiance(placed, COUNT, rgb,
                 "--light '%s matrix=%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,"
                 "%.17g,%.17g,%.17g' --method reference",
                 light, m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1],
                 m[2][2], m[3][0], m[3][1], m[3][2]);
      assert_oracle(rgb, &slab, receivers, COUNT, 1.1e-6);
      slab_free(&slab);
    }
}

int main(void) {
  return testing_run(NULL, NULL);
}
