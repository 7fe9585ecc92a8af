/* test_projector.c - `bakeslab projector`: its samples against the image, and light on screens
 * against sums over the aperture that know only how a projector works: a ray has the colour of
 * the picture where it passes the focus plane. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_exr.h"
#include "helpers.h"
#include "oracle/lambert.h"

/* One projector for most tests, oblong in all ways. */
enum { COLUMNS = 6, ROWS = 4 };
static const double aperture[2] = {0.3, 0.2}, focus = 2, width = 1.5;
static const char *const geometry = "--aperture 0.3x0.2 --focus 2 --width 1.5";
static float pixels[ROWS][COLUMNS][3];

static void fill_pixels(void) {
  uint64_t seed = 7;
  for (int y = 0; y < ROWS; ++y)
    for (int x = 0; x < COLUMNS; ++x)
      for (int c = 0; c < 3; ++c) pixels[y][x][c] = (float)(0.05 + random_number(&seed));
}

/* Writes the image and runs bakeslab projector on it; the slab's path. */
static const char *project(const char *name, float *rgb, int columns, int rows,
                           const char *options) {
  const char *program = getenv("BAKESLAB");
  char command[2048];
  assert_non_null(program);
  struct picture picture = {.width = columns, .height = rows, .rgb = rgb};
  const char *image = scratch("image.exr"), *slab = scratch(name);
  assert_int_equal(slab_exr_write(image, &picture, 0, NULL, NULL), RESULT_OK);
  snprintf(command, sizeof command, "'%s' projector '%s' -o '%s' %s", program, image, slab,
           options);
  assert_int_equal(system(command), 0);
  return slab;
}

static struct slab load(const char *path) {
  struct slab *slabs = NULL;
  struct error error = {{0}};
  int count = 0;
  if (slab_file_load_all(path, &slabs, &count, &error) != RESULT_OK) fail_msg("%s", error.text);
  assert_int_equal(count, 1);
  struct slab slab = slabs[0];
  free(slabs);
  return slab;
}

/* The image's mean over cell (k, l) of columns x rows, in parts that divide both grids. */
static double cell_mean(int k, int l, int columns, int rows, int c) {
  double sum = 0;
  for (int y = l * ROWS; y < (l + 1) * ROWS; ++y)
    for (int x = k * COLUMNS; x < (k + 1) * COLUMNS; ++x)
      sum += (double)pixels[y / rows][x / columns][c];
  return sum / COLUMNS / ROWS;
}

/* Every view holds the image, its rows upwards with t; or means over coarser cells. */
TEST(test_samples) {
  static const struct {
    const char *options;
    int samples[SLAB_AXES];
    double white;
  } cases[] = {{"", {8, 8, COLUMNS, ROWS}, 1},
               {"--uv 1 --st 4x3 --white 5", {1, 1, 4, 3}, 5},
               {"--uv 2x3 --st 5x4", {2, 3, 5, 4}, 1}};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    char options[256];
    snprintf(options, sizeof options, "%s %s", geometry, cases[n].options);
    struct slab slab = load(project("samples.exr", &pixels[0][0][0], COLUMNS, ROWS, options));
    const int *samples = cases[n].samples;
    assert_memory_equal(slab.samples, samples, sizeof slab.samples);
    assert_near(slab.st_window[1], width / focus / 2, 1e-15);
    assert_near(slab.st_window[3], width / focus / 2 * ROWS / COLUMNS, 1e-15);
    assert_true(slab.u[0] == aperture[0] && slab.v[1] == aperture[1] && slab.normal[2] == 1);
    assert_string_equal(slab.name, "samples");
    int at[SLAB_AXES];
    for (size_t pixel = 0; pixel < slab_sample_count(&slab); ++pixel) {
      slab_locate(&slab, pixel, at);
      for (int c = 0; c < 3; ++c) {
        double mean = cell_mean(at[SLAB_S], samples[SLAB_T] - 1 - at[SLAB_T], samples[SLAB_S],
                                samples[SLAB_T], c);
        assert_near((double)slab.rgb[3 * pixel + (size_t)c], cases[n].white * mean, 2e-6);
      }
    }
    slab_free(&slab);
  }
}

/* On a screen at the focus a point gets the picture's colour there, from all of the aperture. */
TEST(test_focus) {
  struct surfel screen[COLUMNS * ROWS];
  double rgb[COLUMNS * ROWS][3], h = width * ROWS / COLUMNS;
  const char *slab = project("focus.exr", &pixels[0][0][0], COLUMNS, ROWS, geometry);
  for (int y = 0; y < ROWS; ++y)
    for (int x = 0; x < COLUMNS; ++x)
      screen[y * COLUMNS + x] = (struct surfel){
          {width * ((x + 0.5) / COLUMNS - 0.5), h * (0.5 - (y + 0.5) / ROWS), focus}, {0, 0, -1}};
  irradiance(screen, COLUMNS * ROWS, rgb, "--light '%s' --method reference", slab);
  for (int k = 0; k < COLUMNS * ROWS; ++k) {
    double window[4];
    for (int side = 0; side < 4; ++side)
      window[side] = (screen[k].p[side / 2] + (side % 2 - 0.5) * aperture[side / 2]) / focus;
    double factor = lambert_window(window);
    for (int c = 0; c < 3; ++c)
      assert_near(rgb[k][c] / (factor * (double)pixels[k / COLUMNS][k % COLUMNS][c]), 1, 2e-6);
  }
}

/* The picture at a point of the focus plane: bilinear between pixels, even at its rim. */
static double picture_at(double x, double y, int c) {
  double column = (x / width + 0.5) * COLUMNS - 0.5;
  double row = (0.5 - y * COLUMNS / ROWS / width) * ROWS - 0.5;
  column = fmin(fmax(column, 0), COLUMNS - 1);
  row = fmin(fmax(row, 0), ROWS - 1);
  int i = (int)fmin(column, COLUMNS - 2), j = (int)fmin(row, ROWS - 2);
  double fx = column - i, fy = row - j;
  return (1 - fy) * ((1 - fx) * (double)pixels[j][i][c] + fx * (double)pixels[j][i + 1][c]) +
         fy * ((1 - fx) * (double)pixels[j + 1][i][c] + fx * (double)pixels[j + 1][i + 1][c]);
}

static void sum_over_aperture(const struct surfel *at, double rgb[3]) {
  enum { N = 300 };
  double cell = aperture[0] / N * aperture[1] / N;
  memset(rgb, 0, 3 * sizeof *rgb);
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      double a = aperture[0] * ((i + 0.5) / N - 0.5), b = aperture[1] * ((j + 0.5) / N - 0.5);
      const double *p = at->p, *n = at->n;
      double x = p[0] - a, y = p[1] - b, z = p[2], square = x * x + y * y + z * z;
      double here = -(n[0] * x + n[1] * y + n[2] * z);
      for (int c = 0; c < 3 && here > 0; ++c)
        rgb[c] += cell * here * z / (square * square) *
                  picture_at(a + x * focus / z, b + y * focus / z, c);
    }
}

/* Before the focus, at it and behind, on surfaces turned any way, within the picture. */
TEST(test_anywhere) {
  static const double distances[] = {0.5, 1.2, 2, 3.3, 20};
  enum { EACH = 6, COUNT = 5 * EACH };
  struct surfel receivers[COUNT];
  double rgb[COUNT][3], expected[3];
  uint64_t seed = 3;
  const char *slab = project("anywhere.exr", &pixels[0][0][0], COLUMNS, ROWS, geometry);
  for (int k = 0; k < COUNT; ++k) {
    struct surfel *r = &receivers[k];
    double d = distances[k / EACH], blur = fabs(d - focus) / d, h = width * ROWS / COLUMNS;
    r->p[0] = random_between(&seed, -0.5, 0.5) * fmax(0, width - blur * aperture[0]) * d / focus;
    r->p[1] = random_between(&seed, -0.5, 0.5) * fmax(0, h - blur * aperture[1]) * d / focus;
    r->p[2] = d;
    do random_direction(&seed, r->n);
    while (r->n[2] > -0.3);
  }
  irradiance(receivers, COUNT, rgb, "--light '%s' --method reference", slab);
  for (int k = 0; k < COUNT; ++k) {
    sum_over_aperture(&receivers[k], expected);
    for (int c = 0; c < 3; ++c) assert_near(rgb[k][c] / expected[c], 1, 3e-5);
  }
}

/* How wide the image of an edge is on a screen at distance d: from a tenth to nine tenths of the
 * light that a white picture gives there, which is 0.8 of a ramp. */
static double edge_width(const char *edge, const char *white, int axis, double d, double most) {
  enum { COUNT = 400 };
  struct surfel line[COUNT];
  double dim[COUNT][3], full[COUNT][3], crossed[2] = {NAN, NAN};
  for (int k = 0; k < COUNT; ++k) {
    line[k] = (struct surfel){{0, 0, d}, {0, 0, -1}};
    line[k].p[axis] = most * ((double)k / (COUNT - 1) - 0.5);
  }
  irradiance(line, COUNT, dim, "--light '%s' --method reference", edge);
  irradiance(line, COUNT, full, "--light '%s' --method reference", white);
  for (int k = 1; k < COUNT; ++k)
    for (int n = 0; n < 2; ++n) {
      double level = n ? 0.9 : 0.1;
      double before = dim[k - 1][0] / full[k - 1][0], after = dim[k][0] / full[k][0];
      if ((before < level) == (after < level)) continue;
      crossed[n] = (k - 1 + (level - before) / (after - before)) * most / (COUNT - 1);
    }
  return fabs(crossed[1] - crossed[0]) / 0.8;
}

/* The rectangle of confusion: the aperture times |d - focus|/focus, in both directions. */
TEST(test_blur) {
  enum { N = 1024 }; /* so many that interpolation between pixels does not show */
  static const double distances[] = {0.5, 1, 1.6, 2.5, 4, 8};
  static float edge[3 * N], white[3 * N];
  for (int k = 0; k < 3 * N; ++k) {
    edge[k] = k / 3 >= N / 2;
    white[k] = 1;
  }
  for (int axis = 0; axis < 2; ++axis) {
    int columns = axis ? 1 : N, rows = axis ? N : 1;
    char options[128], paths[2][600];
    snprintf(options, sizeof options, "--aperture 0.05x0.03 --focus 2 --width %g --uv 1 --st %dx%d",
             axis ? 0.8 / N : 0.8, columns, rows);
    snprintf(paths[0], sizeof paths[0], "%s", project("edge.exr", edge, columns, rows, options));
    snprintf(paths[1], sizeof paths[1], "%s", project("white.exr", white, columns, rows, options));
    for (size_t k = 0; k < sizeof distances / sizeof *distances; ++k) {
      double d = distances[k], blur = (axis ? 0.03 : 0.05) * fabs(d - focus) / focus;
      assert_near(edge_width(paths[0], paths[1], axis, d, 2 * blur) / blur, 1, 0.003);
    }
    /* At the focus only the pixel next to the edge is left. */
    assert_true(edge_width(paths[0], paths[1], axis, focus, 0.02) < 1.01 * 0.8 / N);
  }
}

/* The flux of unit radiance from the aperture to a picture w x h, so far away. */
static double exchange(double w, double h, double away) {
  const double from[4] = {-aperture[0] / 2, aperture[0] / 2, -aperture[1] / 2, aperture[1] / 2};
  return lambert_exchange(from, (const double[]){-w / 2, w / 2, -h / 2, h / 2}, away);
}

/* --flux is that of a white picture, whatever the image; the flux of the slab agrees. */
TEST(test_flux) {
  static float white[3] = {1, 1, 1};
  double flux[3], unit = exchange(width, width * ROWS / COLUMNS, focus) * 1e-4;
  char options[256];
  assert_true(fabs(unit / (aperture[0] * aperture[1] * 1.5 / 4 * 1e-4) - 1) < 0.2);
  snprintf(options, sizeof options, "%s --flux 1200 --unit cd/m2 --metres-per-unit 0.01", geometry);
  struct slab slab = load(project("flux.exr", &pixels[0][0][0], COLUMNS, ROWS, options));
  assert_string_equal(slab.radiance_unit, "cd/m2");
  for (int c = 0; c < 3; ++c)
    assert_near((double)slab_at(&slab, 3, 2, 0, ROWS - 1)[c] * unit / 1200 /
                    (double)pixels[0][0][c],
                1, 1e-6);
  slab_free(&slab);
  slab = load(project("dot.exr", white, 1, 1, "--aperture 0.3x0.2 --focus 2 --width 1.5"));
  slab_flux(&slab, flux, NULL);
  assert_near(flux[0] / exchange(width, width, focus), 1, 1e-6);
  slab_free(&slab);
}

int main(void) {
  fill_pixels();
  return testing_run(NULL, NULL);
}
