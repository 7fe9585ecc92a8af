/* test_import_rays.c - lamps of known rays become slabs: their radiance, their flux, and what they
 * give to a floor close by, counted ray by ray. */
#include <stdio.h>
#include <string.h>

#include "helpers.h"
#include "import/import.h"
#include "oracle/oracle.h"
#include "oracle/random.h"

enum { RAYS = 60000 };

/* Where a ray leaves, and in which direction. */
struct made_ray {
  double origin[3], direction[3], flux;
};

/* Lambertian about an axis. */
static void set_lambertian(struct made_ray *ray, int axis, double sign, uint64_t *seed) {
  double r = sqrt(random_number(seed)), angle = random_between(seed, 0, 6.283185307179586);
  ray->direction[axis] = sign * sqrt(1 - r * r);
  ray->direction[(axis + 1) % 3] = r * cos(angle);
  ray->direction[(axis + 2) % 3] = r * sin(angle);
}

static const char *write_rays(const struct made_ray *rays, int count) {
  const char *path = scratch("lamp.txt");
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  for (int n = 0; n < count; ++n) {
    const double *o = rays[n].origin, *d = rays[n].direction;
    fprintf(file, "%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", o[0], o[1], o[2], d[0], d[1], d[2],
            rays[n].flux);
  }
  assert_int_equal(fclose(file), 0);
  return path;
}

static struct import_light import(const char *path, struct import_wish wish) {
  static struct warnings notes;
  struct import_light light;
  struct error error = {{0}};
  notes = (struct warnings){0};
  wish.files = &path;
  wish.file_count = 1;
  wish.notes = &notes;
  assert_ok(import_files(&wish, "bakeslab import", &light, &error), &error);
  return light;
}

static double flux_of(const struct import_light *light) {
  double flux = 0, rgb[3];
  struct error error = {{0}};
  for (int n = 0; n < light->count; ++n) {
    assert_ok(slab_flux_metric(&light->slabs[n], rgb, &error), &error);
    flux += rgb[1];
  }
  return flux;
}

static struct made_ray rays[RAYS];

/* A Lambertian square millimetre of 1 W has the radiance 1/(pi 1e-6). */
TEST(test_square) {
  static const int samples[3][2] = {{1, 4}, {2, 8}, {4, 16}};
  uint64_t seed = 1;
  for (int n = 0; n < RAYS; ++n) {
    rays[n] = (struct made_ray){
        {random_between(&seed, -0.5, 0.5), 2, random_between(&seed, -0.5, 0.5)}, {0}, 1.0 / RAYS};
    set_lambertian(&rays[n], 1, -1, &seed);
  }
  const char *path = write_rays(rays, RAYS);
  for (int k = 0; k < 3; ++k) {
    int uv = samples[k][0], st = samples[k][1];
    struct import_light light =
        import(path, (struct import_wish){.metres = 1e-3, .uv = {uv, uv}, .st = {st, st}});
    assert_int_equal(light.count, 1);
    const struct slab *slab = &light.slabs[0];
    double sum = 0, square = 0;
    assert_string_equal(slab->radiance_unit, "W/(sr m2)");
    for (int n = 0; n < 100; ++n) { /* where the light is: slopes up to 2 */
      double rgb[3], off;
      slab_lookup(slab, random_between(&seed, -4e-4, 4e-4), random_between(&seed, -4e-4, 4e-4),
                  random_between(&seed, -2, 2), random_between(&seed, -2, 2), rgb);
      off = rgb[1] / (1e6 / 3.14159265358979) - 1;
      sum += off / 100;
      square += off * off / 100;
    }
    assert_true(sqrt(square) < 2 * light.story.error);
    assert_near(sum, 0, 0.03);
    assert_near(flux_of(&light), light.story.flux_out, 1e-6);
    assert_near(light.story.flux_in, 1, 1e-9);
    assert_near(light.story.flux_out + light.story.missed, 1, 1e-6);
    assert_true(light.story.missed < 0.006);
    import_free(&light);
  }
}

/* The part of the flux of all rays that reaches a rectangle across an axis, and how many do. */
static double count_rays(int axis, double at, const double center[2], double half, int *count) {
  double flux = 0;
  *count = 0;
  for (int n = 0; n < RAYS; ++n) {
    const double *o = rays[n].origin, *d = rays[n].direction;
    double steps = (at - o[axis]) / d[axis], off[2];
    for (int k = 0; k < 2; ++k) {
      int c = (axis + 1 + k) % 3;
      off[k] = fabs(o[c] + steps * d[c] - center[k]);
    }
    if (!(d[axis] * at > 0) || off[0] > half || off[1] > half) continue;
    flux += rays[n].flux;
    ++*count;
  }
  return flux;
}

/* The same through the slabs: their mean irradiance on a grid of points. */
static double sum_slabs(const struct import_light *light, int axis, double at,
                        const double center[2], double half) {
  enum { GRID = 5 };
  double sum = 0, normal[3] = {0};
  normal[axis] = at > 0 ? -1 : 1;
  for (int k = 0; k < GRID * GRID; ++k) {
    double p[3];
    p[axis] = at;
    p[(axis + 1) % 3] = center[0] + half * ((2 * (k % GRID) + 1.0) / GRID - 1);
    p[(axis + 2) % 3] = center[1] + half * (2 * (k / GRID) + 1.0 - GRID) / GRID;
    for (int n = 0; n < light->count; ++n)
      sum += (double)oracle_irradiance(&light->slabs[n], p, normal).e[1];
  }
  return sum / (GRID * GRID) * 4 * half * half;
}

/* Moves a ray's origin back along its line, anywhere within a box. */
static void move_back(struct made_ray *ray, const double low[3], const double high[3],
                      uint64_t *seed) {
  double most = INFINITY;
  for (int c = 0; c < 3; ++c) {
    double wall = ray->direction[c] > 0 ? low[c] : high[c];
    most = fmin(most, (ray->origin[c] - wall) / ray->direction[c]);
  }
  double back = random_between(seed, 0, most);
  for (int c = 0; c < 3; ++c) ray->origin[c] -= back * ray->direction[c];
}

/* A cuboid that shines to five sides, each its own light, and most to below; its rays are told from
 * elsewhere on their lines. Floor and walls half its width away get what the rays bring. */
TEST(test_near_field) {
  static const double low[3] = {-1, 0, -0.5}, high[3] = {1, 0.5, 0.5};
  static const int sides[8] = {2, 2, 2, 2, 0, 1, 4, 5}; /* of -x, +x, -y, +y, -z, +z */
  uint64_t seed = 2;
  for (int n = 0; n < RAYS; ++n) {
    int side = sides[random_choose(&seed, 8)], axis = side / 2;
    rays[n].flux = 1.0 / RAYS;
    for (int c = 0; c < 3; ++c) rays[n].origin[c] = random_between(&seed, low[c], high[c]);
    rays[n].origin[axis] = side % 2 ? high[axis] : low[axis];
    set_lambertian(&rays[n], axis, side % 2 ? 1 : -1, &seed);
    if (n % 2) move_back(&rays[n], low, high, &seed);
  }
  struct import_light light =
      import(write_rays(rays, RAYS),
             (struct import_wish){.metres = 1, .box = true, .uv = {4, 4}, .st = {12, 12}});
  assert_int_equal(light.count, 5);
  static const struct {
    int axis;
    double at, center[2], half;
  } places[] = {{1, -1, {0, 0}, 1}, {1, -1, {0.3, 1.2}, 0.5}, {1, -4, {0, 0}, 3},
                {0, 2, {0, 0}, 1},  {0, -2, {-1, 0.2}, 0.7},  {2, 1.5, {0.5, -0.5}, 0.7}};
  for (size_t k = 0; k < sizeof places / sizeof *places; ++k) {
    int count;
    double flux =
        count_rays(places[k].axis, places[k].at, places[k].center, places[k].half, &count);
    double got = sum_slabs(&light, places[k].axis, places[k].at, places[k].center, places[k].half);
    print_message("# %zu: %d rays, %.4f, slabs %+.2f %%\n", k, count, flux, 100 * (got / flux - 1));
    assert_true(count > 1000);
    assert_near(got / flux, 1, 3 / sqrt(count) + 0.02);
  }
  import_free(&light);
}

int main(void) {
  return testing_run(NULL, NULL);
}
