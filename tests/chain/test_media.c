/* test_media.c - lamps of each kind of include in media: pictures of beams against sums of single
 * scattering, and planes behind media that absorb, and in fog.
 *
 * POV-Ray's isotropic media shine by their scattering coefficient times a light's colour, which
 * here is E/pi of a surface that faces the light. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "chain.h"

/* Of the lights of the kinds, at six widths; and of POV-Ray's samples along a ray. */
static const double allowed = 0.04; /* of means; edges of shadows are three times as far off */

static const char *const kinds[] = {"", "--mode cluster --lights 12", "--mode point"};
enum { KINDS = 3, SIZE = CHAIN_SIZE, STEPS = 60 };

/* A ball of medium: its coefficients, by which light dims on its way to a point, too. */
struct ball {
  double center[3], radius, scattering, extinction;
};

/* A matt reflector around a bulb off its middle, which shines along -y: across its beam a
 * camera's rays have no part along the lights' axes, exactly. */
static struct slab soft_slab(uint64_t seed) {
  static const int samples[4] = {4, 4, 12, 12};
  static const double edges[2] = {1, 0.8}, window[4] = {-0.8, 0.9, -0.7, 0.8};
  struct slab slab = chain_slab(samples, edges, window, INFINITY, 0, seed);
  const double frame[3][3] = {{1, 0, 0}, {0, 0, 0.8}, {0, -1, 0}};
  memcpy(slab.u, frame[0], sizeof slab.u);
  memcpy(slab.v, frame[1], sizeof slab.v);
  memcpy(slab.normal, frame[2], sizeof slab.normal);
  for (size_t m = 0; m < slab_sample_count(&slab); ++m) {
    int at[4];
    slab_locate(&slab, m, at);
    double s = slab_position(&slab, 2, at[2]), t = slab_position(&slab, 3, at[3]);
    double light = 1 + 4 * exp(-3 * ((s - 0.2) * (s - 0.2) + t * t));
    for (int c = 0; c < 3; ++c) slab.rgb[3 * m + (size_t)c] = (float)(light * (1 + 0.2 * c));
  }
  return slab;
}

/* Where a ray of unit direction is in the ball: false if nowhere. */
static bool inside(const struct ball *ball, const double from[3], const double way[3],
                   double part[2]) {
  double to[3];
  for (int c = 0; c < 3; ++c) to[c] = from[c] - ball->center[c];
  double b = chain_dot(to, way), d = b * b - chain_dot(to, to) + ball->radius * ball->radius;
  part[0] = fmax(-b - sqrt(fmax(d, 0)), 0);
  part[1] = -b + sqrt(fmax(d, 0));
  return d > 0 && part[1] > part[0];
}

/* Colour of the lights at a point, dimmed by the ball: from the slab's samples, with the cosine
 * to a normal where there is one. */
static void add_lights(const struct slab *slab, const struct ball *ball, const double at[3],
                       const double *normal, double rgb[3]) {
  double lu = chain_length(slab->u), lv = chain_length(slab->v);
  double area = lu * lv / (slab->samples[0] * slab->samples[1]);
  for (int j = 0; j < slab->samples[1]; ++j)
    for (int i = 0; i < slab->samples[0]; ++i) {
      double a = (i + 0.5) / slab->samples[0] - 0.5, b = (j + 0.5) / slab->samples[1] - 0.5;
      double to[3], part[2], dim = 1;
      long double radiance[3];
      for (int c = 0; c < 3; ++c) to[c] = slab->center[c] + a * slab->u[c] + b * slab->v[c] - at[c];
      double r = chain_length(to), height = -chain_dot(to, slab->normal);
      for (int c = 0; c < 3; ++c) to[c] /= r;
      double facing = normal ? chain_dot(to, normal) : 1;
      if (height <= 0 || facing <= 0) continue;
      oracle_lookup_view(slab, i, j, -chain_dot(to, slab->u) / lu * r / height,
                         -chain_dot(to, slab->v) / lv * r / height, radiance);
      if (ball && inside(ball, at, to, part))
        dim = exp(-ball->extinction * (fmin(part[1], r) - fmin(part[0], r)));
      for (int c = 0; c < 3; ++c)
        rgb[c] += (double)radiance[c] * dim * facing * height / (r * r * r) * area / M_PI;
    }
}

/* What a camera with parallel rays along u sees of the ball: SIZE x SIZE x RGB. */
static void sum_beam(const struct slab *slab, const struct ball *ball,
                     const struct chain_plane *seen, double *rgb) {
  double way[3], part[2];
  for (int c = 0; c < 3; ++c) way[c] = -seen->normal[c];
  memset(rgb, 0, sizeof(double) * 3 * CHAIN_PIXELS);
  for (int pixel = 0; pixel < CHAIN_PIXELS; ++pixel) {
    double from[3], at[3];
    chain_pixel(seen, SIZE, pixel, from);
    for (int c = 0; c < 3; ++c) from[c] -= 20 * way[c];
    if (!inside(ball, from, way, part)) continue;
    double step = (part[1] - part[0]) / STEPS;
    for (int k = 0; k < STEPS; ++k) {
      double deep = (k + 0.5) * step, light[3] = {0, 0, 0};
      for (int c = 0; c < 3; ++c) at[c] = from[c] + (part[0] + deep) * way[c];
      add_lights(slab, ball, at, NULL, light);
      for (int c = 0; c < 3; ++c)
        rgb[3 * pixel + c] += ball->scattering * step * exp(-ball->extinction * deep) * light[c];
    }
  }
}

/* The camera that looks across the beam, turned so far towards the lamp, at what is `away`
 * widths from the aperture. */
static struct chain_plane look_at_beam(const struct slab *slab, double away, double turned) {
  const double size = 8;
  struct chain_plane seen;
  double lu = chain_length(slab->u), lv = chain_length(slab->v);
  for (int c = 0; c < 3; ++c) {
    seen.center[c] = slab->center[c] + away * slab->normal[c];
    seen.across[c] = size * slab->v[c] / lv;
    seen.down[c] = size * (cos(turned) * slab->normal[c] - sin(turned) * slab->u[c] / lu);
    seen.normal[c] = cos(turned) * slab->u[c] / lu + sin(turned) * slab->normal[c];
  }
  return seen;
}

static void write_beam(const struct ball *ball, const struct chain_plane *seen) {
  const double *b = ball->center, *p = seen->center, *n = seen->normal;
  const double *a = seen->across, *d = seen->down;
  chain_text(
      "scene.pov", "w",
      "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#include \"lamp.inc\"\n"
      "camera { orthographic location <%.17g, %.17g, %.17g> direction <%.17g, %.17g, %.17g>\n"
      "  right <%.17g, %.17g, %.17g> up <%.17g, %.17g, %.17g> }\n"
      "sphere { <%.17g, %.17g, %.17g>, %.17g hollow pigment { rgbt 1 }\n"
      "  finish { ambient 0 diffuse 0 } interior { media {\n"
      "    scattering { 1, %.17g extinction %.17g } method 2 intervals 2 samples 30 } } }\n"
      "object { Test_Lamp_Canned(1, 1) }\n",
      p[0] + 20 * n[0], p[1] + 20 * n[1], p[2] + 20 * n[2], -n[0], -n[1], -n[2], a[0], a[1], a[2],
      -d[0], -d[1], -d[2], b[0], b[1], b[2], ball->radius, ball->scattering,
      ball->extinction / ball->scattering);
}

/* Beams through balls of clear and of thick medium, before the lamp: across and aslant. */
TEST(test_beams) {
  static double sum[3 * CHAIN_PIXELS];
  static const struct { double extinction, turned; } cases[] = {{0, 0}, {0.3, 0.7}, {0, -1.5}};
  struct slab slab = soft_slab(1);
  struct ball ball = {.radius = 3.5, .scattering = 0.1};
  for (int kind = 0; kind < KINDS; ++kind) {
    chain_include(&slab, 1, "lamp", kinds[kind]);
    for (int n = 0; n < 3; ++n) {
      struct picture picture;
      struct chain_plane seen = look_at_beam(&slab, 6, cases[n].turned);
      memcpy(ball.center, seen.center, sizeof ball.center);
      ball.extinction = cases[n].extinction;
      sum_beam(&slab, &ball, &seen, sum);
      write_beam(&ball, &seen);
      chain_render(&picture);
      double mean = 0, right = 0, rmse = chain_rmse(&picture, sum);
      for (int k = 0; k < 3 * CHAIN_PIXELS; ++k) {
        mean += (double)picture.rgb[k];
        right += sum[k];
      }
      print_message("%-28s extinction %g, turned %g: mean %+.2g, RMS %.2g\n", kinds[kind],
                    ball.extinction, cases[n].turned, mean / right - 1, rmse);
      if (!(fabs(mean / right - 1) <= allowed && rmse <= 3 * allowed))
        fail_msg("%s: mean %g, not %g; RMS %g", kinds[kind], mean, right, rmse);
      picture_free(&picture);
    }
  }
  slab_free(&slab);
}

/* A plane six widths away, white, behind a ball that absorbs, in a medium everywhere, in fog; of
 * the latter the camera's rays pass 50 units. */
TEST(test_dimmed) {
  static double sum[3 * CHAIN_PIXELS];
  static const double everywhere = 0.02;
  struct slab slab = soft_slab(2);
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 6);
  struct ball balls[2] = {{.radius = 1.2, .extinction = 0.4},
                          {.radius = 1e3, .extinction = everywhere}};
  for (int c = 0; c < 3; ++c) {
    balls[0].center[c] = slab.center[c] + 3 * slab.normal[c];
    balls[1].center[c] = plane.center[c];
  }
  for (int kind = 0; kind < KINDS; ++kind) {
    char sdl[512];
    const double *b = balls[0].center;
    chain_include(&slab, 1, "lamp", kinds[kind]);
    for (int what = 0; what < 3; ++what) {
      for (int pixel = 0; pixel < CHAIN_PIXELS; ++pixel) {
        double at[3];
        memset(sum + 3 * pixel, 0, sizeof(double) * 3);
        chain_pixel(&plane, SIZE, pixel, at);
        add_lights(&slab, &balls[what > 0], at, plane.normal, sum + 3 * pixel);
        for (int c = 0; c < 3 && what; ++c) sum[3 * pixel + c] *= exp(-everywhere * 50);
      }
      if (what == 0)
        snprintf(sdl, sizeof sdl,
                 "%s\nsphere { <%.17g, %.17g, %.17g>, 1.2 hollow pigment { rgbt 1 } no_image\n"
                 "  finish { ambient 0 diffuse 0 } interior { media { absorption 0.4 } } }",
                 CHAIN_LIT("1, 1"), b[0], b[1], b[2]);
      else
        snprintf(sdl, sizeof sdl, "%s\n%s", CHAIN_LIT("1, 1"),
                 what == 1 ? "media { absorption 0.02 }" : "fog { distance 50 rgb 0 }");
      double rmse = chain_error_of(&plane, 1, sdl, sum);
      print_message("%-28s %s: %.2g\n", kinds[kind],
                    what == 0   ? "ball"
                    : what == 1 ? "everywhere"
                                : "fog",
                    rmse);
      if (!(rmse <= (kind ? 3 * allowed : 1e-3))) fail_msg("%s, %d: %g", kinds[kind], what, rmse);
    }
  }
  slab_free(&slab);
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
