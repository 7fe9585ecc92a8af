/* Photometric files as slabs: flux and intensity far away against the functions that the files were
 * made of, irradiance near by against arithmetic on the bodies. */
#include <math.h>
#include <string.h>

#include "testing.h"
#include "unit/photometric.h"

/* A body of radiance 1000 all over; sizes along x, y, z. */
struct body {
  const char *name;
  double within;  /* part of the largest intensity in 95 % of the directions */
  char shape;     /* b: box, c: upright cylinder, l: cylinder along x, e: ellipsoid */
  double size[3]; /* x, y, z */
  double says[3]; /* width, length, height in the file */
};

static const double radiance = 1000;

static double body_area(const struct body *body, const double d[3]) {
  const double *s = body->size;
  switch (body->shape) {
  case 'b':
    return s[1] * s[2] * fabs(d[0]) + s[0] * s[2] * fabs(d[1]) + s[0] * s[1] * fabs(d[2]);
  case 'c': /* round */
    return M_PI / 4 * s[0] * s[0] * fabs(d[1]) + s[0] * s[1] * hypot(d[0], d[2]);
  case 'l':
    return M_PI / 4 * s[1] * s[1] * fabs(d[0]) + s[1] * s[0] * hypot(d[1], d[2]);
  default: /* a sphere */
    return M_PI / 4 * s[0] * s[0];
  }
}

static double body_candela(const double d[3], const void *about) {
  const struct body *body = about;
  if (body->size[1] == 0 && d[1] > 0) return 0; /* flat ones shine down */
  return radiance * body_area(body, d);
}

/* Whether a ray meets |p_k| <= half size in the k where `in` says so. */
static bool meets_box(const double p[3], const double d[3], const double half[3]) {
  double low = 0, high = INFINITY;
  for (int k = 0; k < 3; ++k) {
    double a = (-half[k] - p[k]) / d[k], b = (half[k] - p[k]) / d[k];
    low = fmax(low, fmin(a, b));
    high = fmin(high, fmax(a, b));
  }
  return low <= high;
}

/* Whether it meets the part from -half to half along `axis` of the infinite cylinder, or with
 * axis 3 the sphere. */
static bool meets_round(const double p[3], const double d[3], const double half[3], int axis) {
  double a = 0, b = 0, c = -1, low, high;
  for (int k = 0; k < 3; ++k) {
    if (k == axis) continue;
    a += d[k] * d[k] / (half[k] * half[k]);
    b += d[k] * p[k] / (half[k] * half[k]);
    c += p[k] * p[k] / (half[k] * half[k]);
  }
  if (b * b < a * c) return false;
  low = (-b - sqrt(b * b - a * c)) / a;
  high = (-b + sqrt(b * b - a * c)) / a;
  if (axis < 3) {
    double x = (-half[axis] - p[axis]) / d[axis], y = (half[axis] - p[axis]) / d[axis];
    low = fmax(low, fmin(x, y));
    high = fmin(high, fmax(x, y));
  }
  return high > 0 && low <= high;
}

static bool meets(const struct body *body, const double p[3], const double d[3]) {
  double half[3] = {body->size[0] / 2, body->size[1] / 2, body->size[2] / 2};
  if (body->shape == 'b') return meets_box(p, d, half);
  return meets_round(p, d, half, body->shape == 'c' ? 1 : body->shape == 'l' ? 0 : 3);
}

/* Irradiance from the body: pi times the part of cosine-distributed rays that meet it. */
static double arithmetic(const struct body *body, const double p[3], const double n[3]) {
  enum { RAYS = 500 };
  int met = 0, axis = fabs(n[0]) < 0.9 ? 0 : 1;
  double u[3] = {0}, v[3], length;
  u[axis] = 1;
  for (int k = 0; k < 3; ++k) u[k] -= n[axis] * n[k];
  length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  for (int k = 0; k < 3; ++k) u[k] /= length;
  for (int k = 0; k < 3; ++k)
    v[k] = n[(k + 1) % 3] * u[(k + 2) % 3] - n[(k + 2) % 3] * u[(k + 1) % 3];
  for (int i = 0; i < RAYS; ++i)
    for (int j = 0; j < RAYS; ++j) {
      double r2 = (i + 0.5) / RAYS, phi = 2 * M_PI * (j + 0.37) / RAYS, d[3];
      for (int k = 0; k < 3; ++k)
        d[k] = sqrt(r2) * (cos(phi) * u[k] + sin(phi) * v[k]) + sqrt(1 - r2) * n[k];
      met += meets(body, p, d);
    }
  return M_PI * radiance * met / (RAYS * RAYS);
}

static const struct body bodies[] = {
    {"rectangle", 0.02, 'b', {0.6, 0, 0.3}, {0.3, 0.6, 0}},
    {"disc", 0.02, 'c', {0.4, 0, 0.4}, {-0.4, -0.4, 0}},
    {"box", 0.02, 'b', {0.6, 0.2, 0.4}, {0.4, 0.6, 0.2}},
    {"cylinder", 0.02, 'c', {0.3, 0.2, 0.3}, {-0.3, -0.3, 0.2}},
    {"lying cylinder", 0.02, 'l', {0.6, 0.2, 0.2}, {-0.2, 0.6, -0.2}},
    {"sphere", 0.02, 'e', {0.3, 0.3, 0.3}, {-0.3, -0.3, -0.3}},
};
enum { BODIES = sizeof bodies / sizeof *bodies };

/* Receivers half an opening's width from its surface: below the middle, below an edge, and beside
 * it where it has a side. */
static void check_near(const struct body *body, const struct import_light *light) {
  double wide = fmax(body->size[0], body->size[2]), most = 0;
  for (int n = 0; n < 6; ++n) {
    double out = wide / 2, x = body->size[0] / 2, y = body->size[1] / 2;
    const double points[6][2][3] = {
        {{0, -y - out, 0}, {0, 1, 0}},
        {{x, -y - out, 0}, {0, 1, 0}},
        {{x + out, -y - out, 0.05}, {0, 1, 0}},
        {{x + out, -y - out, 0}, {-M_SQRT1_2, M_SQRT1_2, 0}},
        {{x + out, 0, 0.02}, {-1, 0, 0}},
        {{x + out, -y, 0.02}, {-M_SQRT1_2, 0, -M_SQRT1_2}},
    };
    if (body->size[1] == 0 && n >= 4) break;
    double right = arithmetic(body, points[n][0], points[n][1]);
    double got = photometric_irradiance(light, points[n][0], points[n][1], 96);
    assert_near(got, right, 0.03 * right);
    most = fmax(most, fabs(got / right - 1));
  }
  print_message("%-40s near by within %.2g %%\n", body->name, 100 * most);
}

/* Intensity in 200 directions from 100 openings away: 95 % of them within a part of the largest,
 * all within 2.5 times that. */
static void check_far(photometric_candela *candela, const void *about, double wide, double within,
                      const struct import_light *light) {
  enum { DIRECTIONS = 200 };
  double right[DIRECTIONS], d[3], most = 0;
  int off = 0;
  for (int n = 0; n < DIRECTIONS; ++n) {
    photometric_direction(n, DIRECTIONS, d);
    right[n] = candela(d, about);
    most = fmax(most, right[n]);
  }
  for (int n = 0; n < DIRECTIONS; ++n) {
    photometric_direction(n, DIRECTIONS, d);
    double got = photometric_far(light, d, 100 * wide);
    off += !(fabs(got - right[n]) <= within * most);
    assert_near(got, right[n], 2.5 * within * most);
  }
  assert_in_range(off, 0, DIRECTIONS / 20);
}

static void check_body(void **state) {
  const struct body *body = *state;
  struct import_light light =
      photometric_import(photometric_ies("body.ies", body_candela, body, 2.5, body->says), NULL);
  /* Cauchy: the mean projected area of a convex body is a quarter of its surface. */
  double surface = 0;
  const double *s = body->size;
  if (body->shape == 'b') surface = 2 * (s[0] * s[1] + s[1] * s[2] + s[0] * s[2]);
  if (body->shape == 'c') surface = M_PI * s[0] * (s[1] + s[0] / 2);
  if (body->shape == 'l') surface = M_PI * s[1] * (s[0] + s[1] / 2);
  if (body->shape == 'e') surface = M_PI * s[0] * s[0];
  double flux = M_PI * radiance * surface / (s[1] == 0 ? 2 : 1);
  assert_near(light.story.flux_out, flux, 0.005 * flux);
  check_far(body_candela, body, fmax(s[0], s[2]), body->within, &light);
  check_near(body, &light);
  import_free(&light);
}

/* Lamps as makers sell them: a narrow downlight, a batwing, and one that shines up, too. */
static double downlight(const double d[3], const void *about) {
  (void)about;
  return d[1] < 0 ? 1000 * pow(-d[1], 12) : 0;
}

static double batwing(const double d[3], const void *about) {
  (void)about;
  double gamma = acos(fmax(-1, fmin(1, -d[1]))), across = d[0] * d[0] / fmax(1e-9, 1 - d[1] * d[1]);
  return gamma < M_PI / 2 ? cos(gamma) * (100 + 300 * pow(sin(1.6 * gamma), 2) * (0.5 + across))
                          : 0;
}

static double both_ways(const double d[3], const void *about) {
  (void)about;
  return d[1] < 0 ? 200 * d[1] * d[1] : 300 * d[1] * d[1] * d[1];
}

/* As bright along an axis as across it: the radiance has a peak where the end of a cylinder is all
 * that is seen. */
static double all_around(const double d[3], const void *about) {
  (void)about;
  return 500 * (1 + 0.5 * d[0]);
}

static void check_lamp(const char *name, photometric_candela *candela, const double size[3],
                       double flux, double within) {
  struct import_light light =
      photometric_import(photometric_ies(name, candela, NULL, 2.5, size), NULL);
  if (flux > 0) assert_near(light.story.flux_out, flux, 0.005 * flux);
  assert_near(light.story.flux_out, light.story.flux_in, 1e-3 * light.story.flux_in);
  check_far(candela, NULL, fmax(0.01, fmax(fabs(size[0]), fabs(size[1]))), within, &light);
  import_free(&light);
}

TEST(lamps_give_their_intensities) {
  check_lamp("downlight.ies", downlight, (double[3]){-0.15, -0.15, 0}, 2 * M_PI * 1000 / 13, 0.006);
  check_lamp("batwing.ies", batwing, (double[3]){0.6, 1.2, 0}, 0, 0.006);
  check_lamp("both.ies", both_ways, (double[3]){0.2, 1.2, 0.05}, 2 * M_PI * (200.0 / 3 + 300.0 / 4),
             0.004);
  check_lamp("point.ies", both_ways, (double[3]){0, 0, 0}, 2 * M_PI * (200.0 / 3 + 300.0 / 4),
             0.004);
}

TEST(a_cylinder_is_as_bright_along_its_axis) {
  check_lamp("round.ies", all_around, (double[3]){-0.1, 0.3, -0.1}, 4 * M_PI * 500, 0.02);
}

/* What the slab says of its error holds for directions that it did not look at. */
TEST(the_error_that_is_told_is_true) {
  enum { DIRECTIONS = 3000 };
  const char *path = photometric_ies("told.ies", batwing, NULL, 5, (double[3]){0.6, 1.2, 0});
  const struct import_wish coarse = {.st = {12, 12}, .uv = {2, 2}};
  struct import_light light = photometric_import(path, &coarse);
  double sum = 0, all = 0;
  for (int n = 0; n < DIRECTIONS; ++n) {
    double d[3], right;
    photometric_direction(n, DIRECTIONS, d);
    right = batwing(d, NULL);
    sum += pow(photometric_far(&light, d, 120) - right, 2);
    all += right * right;
  }
  assert_true(light.story.error > 0.05); /* it is coarse */
  assert_near(light.story.error / sqrt(sum / all), 1, 0.1);
  import_free(&light);
}

/* --turn 90 brings what went towards C0 to C90; --lumens and --kelvin do as they say. */
TEST(turned_rescaled_and_coloured) {
  const char *path = photometric_ies("wishes.ies", batwing, NULL, 2.5, (double[3]){0.6, 0.6, 0});
  const struct import_wish coarse = {.tolerance = 0.05, .uv = {2, 2}};
  struct import_wish wish = coarse;
  wish.turn = 90;
  wish.lumens = 1234;
  wish.kelvin = 2700;
  struct import_light plain = photometric_import(path, &coarse),
                      light = photometric_import(path, &wish);
  double factor = 1234 / plain.story.flux_in;
  assert_near(light.story.flux_out, 1234, 1);
  for (int n = 0; n < 20; ++n) {
    double d[3] = {0.3 + 0.02 * n, -0.7, 0.5 - 0.03 * n}, length = 0;
    for (int k = 0; k < 3; ++k) length += d[k] * d[k];
    for (int k = 0; k < 3; ++k) d[k] /= sqrt(length);
    double turned[3] = {d[2], d[1], -d[0]}; /* from C90 to C0 */
    assert_near(photometric_far(&light, d, 60), factor * batwing(turned, NULL),
                0.03 * factor * batwing(turned, NULL));
  }
  const float *sample = slab_at(light.slabs, 0, 0, 20, 20);
  assert_near(slab_luminance(sample) / slab_luminance(slab_at(plain.slabs, 0, 0, 20, 20)), factor,
              0.2 * factor);
  /* 2700 K: chromaticity (0.4599, 0.4106) (CIE 15) */
  double x = 0.4124 * sample[0] + 0.3576 * sample[1] + 0.1805 * sample[2];
  double z = 0.0193 * sample[0] + 0.1192 * sample[1] + 0.9505 * sample[2];
  double y = slab_luminance(sample);
  assert_near(x / (x + y + z), 0.4599, 0.002);
  assert_near(y / (x + y + z), 0.4106, 0.002);
  import_free(&plain);
  import_free(&light);
}

int main(void) {
  for (int n = 0; n < BODIES; ++n) testing_add(bodies[n].name, check_body, &bodies[n]);
  return testing_run(NULL, NULL);
}
