/* test_gl.c - the method gl against a plain sum over views, in double precision, whose
 * shadows are arithmetic on rectangles. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "helpers.h"
#include "oracle/oracle.h"
#include "slab/slab_resample.h"

static const double window[4] = {-1.3, 1.2, -1.1, 1.4};

/* A rectangle that casts a shadow, spanned by two edges; NULL: none. */
struct screen {
  double corner[3], along[2][3];
};

static bool meets(const struct screen *screen, const double from[3], const double to[3]) {
  double normal[3], step[3], offset[3];
  vector_cross(screen->along[0], screen->along[1], normal);
  vector_subtract(to, from, step);
  vector_subtract(screen->corner, from, offset);
  double share = vector_dot(offset, normal) / vector_dot(step, normal);
  if (!(share > 1e-9 && share < 1 - 1e-9)) return false;
  for (int axis = 0; axis < 2; ++axis) {
    double at = 0, square = vector_dot(screen->along[axis], screen->along[axis]);
    for (int c = 0; c < 3; ++c)
      at += (from[c] + share * step[c] - screen->corner[c]) * screen->along[axis][c];
    if (!(at > 0 && at < square)) return false;
  }
  return true;
}

/* Irradiance by one ray to the middle of each view's cell. */
static void sum_views(const struct slab *slab, const struct surfel *receiver,
                      const struct screen *screen, double rgb[3]) {
  struct oracle_place place;
  oracle_place(slab, receiver->p, receiver->n, &place);
  for (int j = 0; j < slab->samples[SLAB_V]; ++j)
    for (int i = 0; i < slab->samples[SLAB_U]; ++i) {
      double point[3];
      long double light[3];
      slab_point(slab, slab_position(slab, SLAB_U, i), slab_position(slab, SLAB_V, j), 0, point);
      if (screen && meets(screen, receiver->p, point)) continue;
      oracle_view(slab, &place, i, j, light, NULL);
      for (int c = 0; c < 3; ++c) rgb[c] += (double)light[c];
    }
}

static double got[COUNT_MAX][3], right[COUNT_MAX][3];
static struct surfel receivers[COUNT_MAX];

/* Relative root mean square of the difference of what was got. */
static double error_of(int count) {
  return relative_rms(got, right, count);
}

static void aim_some(const struct slab *slab, int count, double nearest, double farthest) {
  uint64_t seed = 7;
  aim(slab, (const double[]){nearest, farthest}, RECEIVER_KINDS, &seed, receivers, count);
}

static void expect_sums(const struct slab *slabs, int pages, const struct screen *screen,
                        int count) {
  memset(right, 0, sizeof right);
  for (int k = 0; k < count; ++k)
    for (int page = 0; page < pages; ++page)
      sum_views(&slabs[page], &receivers[k], screen, right[k]);
}

/* Every frame, mirrored ones too, both st planes, near and far; and a pass for each view. */
TEST(sums_over_views) {
  static const int samples[SLAB_AXES] = {5, 4, 9, 7};
  static const double distances[] = {INFINITY, 1.7};
  for (int frame = FRAME_PLAIN; frame <= FRAME_MIRRORED; ++frame)
    for (int d = 0; d < 2; ++d) {
      struct slab slab =
          rough_slab(samples, distances[d], window, (enum frame)frame, FILL_UNIFORM, 3);
      const char *file = write_light("views.tif", &slab, 1);
      aim_some(&slab, 300, 0.2, 50);
      expect_sums(&slab, 1, NULL, 300);
      irradiance(receivers, 300, got, "--light %s --method gl", file);
      assert_near(error_of(300), 0, 2e-5);
      irradiance(receivers, 300, got, "--light %s --method gl --gl-passes views", file);
      assert_near(error_of(300), 0, 2e-5);
      slab_free(&slab);
    }
}

/* Two pages, two lights, gains that differ by 10^12 and from colour to colour. */
TEST(lights_and_pages_add_up) {
  static const int samples[2][SLAB_AXES] = {{3, 4, 5, 6}, {6, 2, 4, 9}};
  static const double gains[3] = {1e12, 2e11, 3e12};
  struct slab slabs[2];
  for (int k = 0; k < 2; ++k)
    slabs[k] = rough_slab(samples[k], k ? 2 : INFINITY, window, FRAME_TURNED, FILL_SIGNED, 5);
  const char *file = write_light("pages.tif", slabs, 2);
  aim_some(&slabs[0], 200, 0.3, 30);
  expect_sums(slabs, 2, NULL, 200);
  for (int k = 0; k < 200; ++k)
    for (int c = 0; c < 3; ++c) right[k][c] *= gains[c] + 1;
  irradiance(receivers, 200, got, "--light '%s gain=1e12,2e11,3e12' --light %s --method gl", file,
             file);
  assert_near(error_of(200), 0, 2e-5);
  for (int k = 0; k < 2; ++k) slab_free(&slabs[k]);
}

/* 48 x 50 views are more than a texture array's 2048 layers; some of them are black. */
TEST(more_views_than_layers) {
  static const int samples[SLAB_AXES] = {48, 50, 3, 3};
  struct slab slab = rough_slab(samples, INFINITY, window, FRAME_TURNED, FILL_UNIFORM, 9);
  for (int j = 0; j < 4; ++j) memset(slab_at(&slab, 0, 3 * j, 0, 0), 0, 9 * sizeof(float));
  const char *file = write_light("many.tif", &slab, 1);
  aim_some(&slab, 60, 0.3, 30);
  expect_sums(&slab, 1, NULL, 60);
  irradiance(receivers, 60, got, "--light %s --method gl", file);
  assert_near(error_of(60), 0, 2e-5);
  slab_free(&slab);
}

/* Levels of the hierarchy have fewer views of the same energy: far away the same light. */
TEST(levels_keep_the_light) {
  static const int samples[SLAB_AXES] = {8, 8, 6, 6};
  struct slab slab = rough_slab(samples, INFINITY, window, FRAME_PLAIN, FILL_UNIFORM, 11), half;
  const char *file = write_light("level.tif", &slab, 1);
  static const int fewer[SLAB_AXES] = {2, 2, 6, 6};
  assert_int_equal(slab_resample(&slab, fewer, &half, NULL), RESULT_OK);
  aim_some(&slab, 200, 5, 50);
  expect_sums(&half, 1, NULL, 200);
  irradiance(receivers, 200, got, "--light %s --method gl --level 2", file);
  assert_near(error_of(200), 0, 2e-5);
  slab_free(&slab);
  slab_free(&half);
}

/* The flux through a plane in front is the slab's, whatever its resolution. */
TEST(energy_is_independent_of_resolution) {
  enum { SIDE = 60 };
  static const double narrow[4] = {-0.5, 0.5, -0.5, 0.5};
  static const int samples[SLAB_AXES] = {12, 12, 12, 12};
  struct slab slab = rough_slab(samples, INFINITY, narrow, FRAME_PLAIN, FILL_UNIFORM, 13), other;
  double flux[3];
  /* Black at the window's rim: the light on the plane is continuous. */
  for (size_t pixel = 0; pixel < slab_sample_count(&slab); ++pixel) {
    int at[SLAB_AXES];
    slab_locate(&slab, pixel, at);
    if (at[SLAB_S] % 11 == 0 || at[SLAB_T] % 11 == 0)
      memset(slab_at(&slab, at[0], at[1], at[2], at[3]), 0, 3 * sizeof(float));
  }
  slab_flux(&slab, flux, NULL);
  for (int n = 12; n >= 3; n /= 2) {
    int coarse[SLAB_AXES] = {n, n, 12, 12};
    double sum = 0, z = 2, half = 1.6, area = 4 * half * half / (SIDE * SIDE);
    assert_int_equal(slab_resample(&slab, coarse, &other, NULL), RESULT_OK);
    for (int k = 0; k < SIDE * SIDE; ++k) {
      double a = ((k % SIDE + 0.5) / SIDE * 2 - 1) * half;
      double b = ((k / SIDE + 0.5) / SIDE * 2 - 1) * half; /* NOLINT(bugprone-integer-division) */
      receivers[k] = (struct surfel){.n = {-slab.normal[0], -slab.normal[1], -slab.normal[2]}};
      slab_point(&slab, a, b, z, receivers[k].p);
    }
    irradiance(receivers, SIDE * SIDE, got, "--light %s --method gl",
               write_light("energy.tif", &other, 1));
    for (int k = 0; k < SIDE * SIDE; ++k) sum += area * got[k][1];
    assert_near(sum / flux[1], 1, 5e-3);
    slab_free(&other);
  }
  slab_free(&slab);
}

/* A mesh that is written corner by corner; OBJ files have z mirrored. */
struct mesh {
  FILE *file;
  const char *path;
  int corners;
};

static struct mesh mesh_start(const char *name) {
  struct mesh mesh = {.path = scratch(name)};
  mesh.file = fopen(mesh.path, "w");
  assert_non_null(mesh.file);
  return mesh;
}

static void mesh_add(struct mesh *mesh, const double (*corners)[3], int count) {
  for (int k = 0; k < count; ++k)
    fprintf(mesh->file, "v %.17g %.17g %.17g\n", corners[k][0], corners[k][1], -corners[k][2]);
  fputs("f", mesh->file);
  for (int k = 0; k < count; ++k) fprintf(mesh->file, " %d", ++mesh->corners);
  fputs("\n", mesh->file);
}

static void mesh_add_screen(struct mesh *mesh, const struct screen *screen) {
  double corners[4][3];
  for (int c = 0; c < 3; ++c) {
    corners[0][c] = screen->corner[c];
    corners[1][c] = corners[0][c] + screen->along[0][c];
    corners[2][c] = corners[1][c] + screen->along[1][c];
    corners[3][c] = corners[0][c] + screen->along[1][c];
  }
  mesh_add(mesh, (const double(*)[3])corners, 4);
}

/* A lamp at the origin, 1 x 1, that shines along z (FRAME_PLAIN). */
static struct slab lamp(const char **file) {
  static const int samples[SLAB_AXES] = {6, 6, 8, 8};
  struct slab slab = rough_slab(samples, INFINITY, window, FRAME_PLAIN, FILL_UNIFORM, 17);
  *file = write_light("lamp.tif", &slab, 1);
  return slab;
}

/* SIDE x SIDE receivers on a square at height z, as wide, that face the lamp. */
static void spread(int side, double z, double half) {
  for (int k = 0; k < side * side; ++k) {
    int row = k / side;
    receivers[k] = (struct surfel){
        .p = {((k % side + 0.37) / side * 2 - 1) * half, ((row + 0.41) / side * 2 - 1) * half, z},
        .n = {0, 0, -1}};
  }
}

/* The shadow of a rectangle that stands askew, from each view a sharp one. */
TEST(shadows_are_where_rays_are_stopped) {
  static const struct screen screen = {{-0.3, -0.2, 1.1}, {{0.7, 0.1, 0.3}, {-0.1, 0.7, 0}}};
  const char *file;
  struct slab slab = lamp(&file);
  struct mesh mesh = mesh_start("screen.obj");
  mesh_add_screen(&mesh, &screen);
  fclose(mesh.file);
  spread(60, 3, 3);
  expect_sums(&slab, 1, &screen, 3600);
  irradiance(receivers, 3600, got, "--light %s --method gl --mesh %s", file, mesh.path);
  double fine = error_of(3600);
  irradiance(receivers, 3600, got, "--light %s --method gl --mesh %s --shadow-map 128", file,
             mesh.path);
  double coarse = error_of(3600);
  print_message("# shadows: %.2g with 2048 texels, %.2g with 128\n", fine, coarse);
  assert_true(fine < 0.03 && coarse < 0.15);
  irradiance(receivers, 3600, got, "--light %s --method gl --mesh %s --gl-passes views", file,
             mesh.path);
  assert_near(error_of(3600), fine, 1e-6);
  slab_free(&slab);
}

/* A map for 2 x 2 views takes all of their light or none: in the rim of a shadow at most half
 * of a group's share is wrong, and beside it nothing. */
TEST(groups_err_in_the_rim_alone) {
  static const struct screen screen = {{-9, 0, 1.5}, {{18, 0, 0}, {0, 9, 0}}}; /* half a plane */
  const char *file;
  struct slab slab = lamp(&file);
  fill_slab(&slab, FILL_CONSTANT, 1);
  file = write_light("even.tif", &slab, 1);
  struct mesh mesh = mesh_start("half.obj");
  mesh_add_screen(&mesh, &screen);
  fclose(mesh.file);
  spread(60, 3, 0.7); /* all views reach them, about equally */
  static double grouped[COUNT_MAX][3];
  expect_sums(&slab, 1, NULL, 3600);
  irradiance(receivers, 3600, grouped, "--light %s --method gl --mesh %s --shadow-groups 3", file,
             mesh.path);
  irradiance(receivers, 3600, got, "--light %s --method gl --mesh %s", file, mesh.path);
  double worst = 0;
  for (int k = 0; k < 3600; ++k) {
    double off = fabs(got[k][0] - grouped[k][0]) / right[k][0];
    /* The lamp's edges, through the screen's, meet the receivers at y = -0.5 and 0.5. */
    if (fabs(receivers[k].p[1]) > 0.51) assert_near(off, 0, 1e-6);
    worst = larger(worst, off);
  }
  print_message("# a group of 2 x 2 views: up to %.2g of the light\n", worst);
  assert_true(worst > 0.1 && worst <= 1.1 / 6);
  slab_free(&slab);
}

/* Nothing that is convex, as seen from the lamp, casts a shadow on itself: a slope down to
 * grazing light, and a bowl of flat facets. */
TEST(no_acne) {
  enum { N = 24 };
  const char *file;
  struct slab slab = lamp(&file);
  uint64_t seed = 23;
  for (int kind = 0; kind < 4; ++kind) {
    struct mesh mesh = mesh_start("acne.obj");
    int count = 0;
    double tilt = (const double[]){0, 1, 1.5, 1.565}[kind];
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) {
        double corner[3][3], across[2][3];
        for (int k = 0; k < 3; ++k) {
          double x = (double)(i + (k == 1)) / N * 2 - 1, y = (double)(j + (k == 2)) / N * 2 - 1;
          const double slope[3] = {x * cos(tilt), y, 2 + x * sin(tilt)};
          const double bowl[3] = {x, y, 2.5 - (x * x + y * y) / 2};
          memcpy(corner[k], kind == 0 ? bowl : slope, sizeof corner[k]);
        }
        mesh_add(&mesh, (const double(*)[3])corner, 3);
        for (int k = 0; k < 2; ++k) vector_subtract(corner[k + 1], corner[0], across[k]);
        struct surfel *receiver = &receivers[count++];
        double a = random_number(&seed), b = random_number(&seed) * (1 - a);
        for (int c = 0; c < 3; ++c)
          receiver->p[c] = corner[0][c] + a * across[0][c] + b * across[1][c];
        vector_cross(across[1], across[0], receiver->n);
        vector_normalise(receiver->n);
      }
    fclose(mesh.file);
    expect_sums(&slab, 1, NULL, count);
    irradiance(receivers, count, got, "--light %s --method gl --mesh %s", file, mesh.path);
    print_message("# acne, tilt %g: %.2g\n", tilt, error_of(count));
    assert_near(error_of(count), 0, 2e-5);
  }
  slab_free(&slab);
}

/* Behind a wall it is dark, two texels of the map behind it too, and in the foot of a wall. */
TEST(no_leaks) {
  static const struct screen plate = {{-9, -9, 3}, {{18, 0, 0}, {0, 18, 0}}};
  static const struct screen wall = {{0.3, -9, 1}, {{0, 18, 0}, {0, 0, 2.0000001}}};
  const char *file;
  struct slab slab = lamp(&file);
  struct mesh mesh = mesh_start("leak.obj");
  mesh_add_screen(&mesh, &plate);
  mesh_add_screen(&mesh, &wall);
  fclose(mesh.file);
  spread(60, 3 + 3 * 2 * 2.5 / 2048, 3); /* under the plate */
  irradiance(receivers, 3600, got, "--light %s --method gl --mesh %s", file, mesh.path);
  for (int k = 0; k < 3600; ++k) assert_true(got[k][0] == 0 && got[k][1] == 0 && got[k][2] == 0);
  spread(60, 3, 3); /* on it, on both sides of the wall */
  for (int k = 0; k < 30; ++k) receivers[k].p[0] = 0.3 + 3 * 2.5 / 2048 * (k + 2);
  memset(right, 0, sizeof right);
  expect_sums(&slab, 1, &wall, 3600);
  irradiance(receivers, 3600, got, "--light %s --method gl --mesh %s", file, mesh.path);
  print_message("# a wall on the floor: %.2g; in its foot %.2g\n", error_of(3600), error_of(30));
  assert_true(error_of(3600) < 0.03 && error_of(30) < 0.05);
  slab_free(&slab);
}

int main(void) {
  return testing_run(NULL, NULL);
}
