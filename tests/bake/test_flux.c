/* test_flux.c - the flux of the paper's lamp, lamps/parabolic.pov with its bulb alone,
 * against a ray tracer of its own: the integral of radiance over aperture and window by
 * quasi-random rays. Within 0.5 %. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bakes.h"

/* As the script has them. Radiance leaves downwards through y = 0. */
static const double radius = 10, focus = 2.5, depth = 10, pitch = 5, height = 4, thickness = 0.2;
static const double bulb_radius = 1.5, bulb_radiance = 500, white = 0.8, black = 0.02;
static const double slope = 1.5; /* of the window's edges */

static int bake_all(void **state) {
  if (bakes_setup(state)) return -1;
  assert_int_equal(bakes_run("cp \"$FIXTURES\"/../../../lamps/parabolic.pov ."), 0);
  bakes_start("parabolic", "lamp.exr", "--effects none");
  bakes_start("parabolic", "plain.exr", "--uv 8x8 --st 16x16 --rays 4 --effects none");
  bakes_start("parabolic", "dim.exr", "--uv 8x8 --st 16x16 --rays 4 --effects none --gain 2^-7");
  bakes_wait();
  return 0;
}

/* ---- The lamp ---- */

struct hit {
  double distance, normal[3], albedo; /* albedo < 0: the bulb itself */
};

static void at(const double o[3], const double d[3], double t, double p[3]) {
  for (int c = 0; c < 3; ++c) p[c] = o[c] + t * d[c];
}

/* The nearer of two distances at which a ray meets a surface of revolution. The
 * quadratic a t^2 + b t + c is solved so that a may vanish. */
static void hit_quadric(const double o[3], const double d[3], const double abc[3],
                        const double limits[2], double rise, double surface_albedo,
                        struct hit *hit) {
  double root = abc[1] * abc[1] - 4 * abc[0] * abc[2];
  if (root < 0) return;
  double q = -0.5 * (abc[1] + copysign(sqrt(root), abc[1]));
  const double t[2] = {abc[0] != 0 ? q / abc[0] : -1, q != 0 ? abc[2] / q : -1};
  for (int n = 0; n < 2; ++n) {
    if (!(t[n] > 1e-6 && t[n] < hit->distance)) continue;
    double p[3];
    at(o, d, t[n], p);
    if (p[1] >= limits[0] && p[1] <= limits[1])
      *hit = (struct hit){t[n], {2 * p[0], rise, 2 * p[2]}, surface_albedo};
  }
}

/* x^2 + z^2 = 4 focus (height + depth - y), above y = height: the reflector's inside.
 * Its outside is never lit. */
static void hit_bowl(const double o[3], const double d[3], struct hit *hit) {
  const double limits[2] = {height, height + depth};
  const double abc[3] = {d[0] * d[0] + d[2] * d[2],
                         2 * (o[0] * d[0] + o[2] * d[2]) + 4 * focus * d[1],
                         o[0] * o[0] + o[2] * o[2] + 4 * focus * (o[1] - height - depth)};
  hit_quadric(o, d, abc, limits, 4 * focus, white, hit);
}

static void hit_collar(const double o[3], const double d[3], struct hit *hit) {
  const double limits[2] = {0.1, height};
  const double abc[3] = {d[0] * d[0] + d[2] * d[2], 2 * (o[0] * d[0] + o[2] * d[2]),
                         o[0] * o[0] + o[2] * o[2] - radius * radius};
  hit_quadric(o, d, abc, limits, 0, black, hit);
}

/* A blocker along x or z. Its ends are at the collar, which hides them. */
static void hit_blocker(const double o[3], const double d[3], int along, double middle,
                        struct hit *hit) {
  double low[3] = {-radius, 0.1, -radius}, high[3] = {radius, height, radius};
  int across = 2 - along;
  low[across] = middle - thickness / 2, high[across] = middle + thickness / 2;
  double enter = -INFINITY, leave = INFINITY;
  int side = 0;
  for (int c = 0; c < 3; ++c) {
    double one = (low[c] - o[c]) / d[c], two = (high[c] - o[c]) / d[c];
    if (fmin(one, two) > enter) {
      enter = fmin(one, two);
      side = c;
    }
    leave = fmin(leave, fmax(one, two));
  }
  if (!(enter < leave && enter > 1e-6 && enter < hit->distance)) return;
  double p[3];
  at(o, d, enter, p);
  if (p[0] * p[0] + p[2] * p[2] > radius * radius) return;
  *hit = (struct hit){enter, {0}, black};
  hit->normal[side] = 1;
}

static void hit_bulb(const double o[3], const double d[3], struct hit *hit) {
  const double m[3] = {o[0], o[1] - (height + depth - focus), o[2]};
  double a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  double b = m[0] * d[0] + m[1] * d[1] + m[2] * d[2];
  double c = m[0] * m[0] + m[1] * m[1] + m[2] * m[2] - bulb_radius * bulb_radius;
  double root = b * b - a * c;
  if (root < 0) return;
  double t = (-b - sqrt(root)) / a;
  if (t > 1e-6 && t < hit->distance) *hit = (struct hit){t, {0}, -1};
}

static struct hit trace(const double o[3], const double d[3], double most, bool bulb) {
  struct hit hit = {most, {0}, 0};
  hit_bowl(o, d, &hit);
  hit_collar(o, d, &hit);
  for (int n = -1; n <= 1; ++n) {
    hit_blocker(o, d, 0, n * pitch, &hit);
    hit_blocker(o, d, 2, n * pitch, &hit);
  }
  if (bulb) hit_bulb(o, d, &hit); /* casts no shadow */
  return hit;
}

/* Radiance that arrives at o from along d: the bulb's, or that of a diffuse surface
 * under it, albedo E / pi with E = pi L r^2 cos / distance^2. */
static double radiance(const double o[3], const double d[3]) {
  struct hit hit = trace(o, d, INFINITY, true);
  if (hit.albedo < 0) return bulb_radiance;
  if (isinf(hit.distance)) return 0;
  double p[3], to[3], facing = 0, cosine = 0, square = 0, n2 = 0;
  at(o, d, hit.distance, p);
  const double bulb[3] = {0, height + depth - focus, 0};
  for (int c = 0; c < 3; ++c) {
    to[c] = bulb[c] - p[c];
    facing += hit.normal[c] * d[c];
    cosine += hit.normal[c] * to[c];
    square += to[c] * to[c];
    n2 += hit.normal[c] * hit.normal[c];
  }
  if (facing * cosine >= 0) return 0; /* lit from behind */
  struct hit shadow = trace(p, to, 1, false);
  if (shadow.distance < 1 - 1e-6) return 0;
  cosine = fabs(cosine) / sqrt(n2 * square);
  return hit.albedo * bulb_radiance * bulb_radius * bulb_radius / square * cosine;
}

/* ---- */

/* Rays of a Kronecker sequence; cos(theta) d(omega) = ds dt / (1 + s^2 + t^2)^2. */
static double traced_flux(int rays) {
  static const double step[4] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378086,
                                 0.5385972572236100};
  double sum = 0;
  for (int n = 0; n < rays; ++n) {
    double x[4];
    for (int c = 0; c < 4; ++c) x[c] = fmod(0.5 + (n + 1) * step[c], 1) - 0.5;
    double s = 2 * slope * x[2], t = 2 * slope * x[3], r = 1 + s * s + t * t;
    const double o[3] = {2 * radius * x[0], 0, 2 * radius * x[1]}, d[3] = {-s, 1, -t};
    sum += radiance(o, d) / (r * r);
  }
  double metres = 0.01;
  return sum / rays * 4 * slope * slope * 4 * radius * radius * metres * metres;
}

TEST(test_flux) {
  double half = traced_flux(1 << 20), traced = traced_flux(1 << 21), rgb[3];
  assert_true(fabs(half / traced - 1) < 0.001);
  struct slab slab = bakes_load("lamp.exr", 0);
  slab_flux(&slab, rgb, NULL);
  double unit = slab.metres_per_unit, baked = rgb[1] * unit * unit;
  print_message("# baked %.5f W, traced %.5f W, %+.2f %%; stated noise %.2f %%\n", baked, traced,
                100 * (baked / traced - 1), 100 * bakes_provenance(&slab, "noise", "flux"));
  assert_true(fabs(baked / traced - 1) < 0.005);
  slab_free(&slab);
}

/* A lamp 20 units wide through the gain's filter. */
TEST(test_gain) {
  struct slab plain = bakes_load("plain.exr", 0), dim = bakes_load("dim.exr", 0);
  double expected[3], found[3];
  slab_flux(&plain, expected, NULL);
  slab_flux(&dim, found, NULL);
  assert_true(bakes_provenance(&dim, "gain", NULL) == 0x1p-7);
  assert_true(fabs(found[1] / expected[1] - 1) < 0.001);
  slab_free(&plain);
  slab_free(&dim);
}

int main(void) {
  return testing_run(bake_all, bakes_teardown);
}
