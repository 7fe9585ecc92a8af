/* test_radiance.c - lamps of known, smooth radiance, baked and looked up: within
 * 0.1 % of the peak where the file holds floats, 2.2 % with LogLuv. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bakes.h"
#include "oracle/random.h"

enum { RAYS = 500 };

static const struct bakes_frame straight = {
    {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, {-1.2, 1.2, -1.2, 1.2}, 0};
/* u x v = -n, a normal that is no unit vector */
static const struct bakes_frame mirrored = {
    {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, -3}, {-1.2, 1.2, -1.2, 1.2}, 0};
static const struct bakes_frame nearby = {
    {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, {-0.4, 1.8, -1.4, 0.1}, 3};
/* u x v = n, an orthogonal frame askew, edges of 0.7 and 5 */
static const struct bakes_frame askew = {{30, -7, 11},       {0.42, 0.56, 0},       {-2.4, 1.8, 4},
                                         {0.64, -0.48, 0.6}, {0.3, 1.5, -3.1, 0.4}, 0};
static const struct bakes_frame askew_finite = {
    {30, -7, 11}, {0.42, 0.56, 0}, {2.4, -1.8, -4}, {0.64, -0.48, 0.6}, {0.3, 1.1, -1, -0.2}, 1.5};
static const struct bakes_frame elsewhere = {{500, 0, 0}, {0, 0, -3},         {0, 2, 0},
                                             {-1, 0, 0},  {-1, 1, -0.5, 1.5}, 8};

static const struct setting {
  const char *name;
  const struct bakes_frame *frames[2];
} settings[] = {
    {"straight", {&straight, NULL}},
    {"mirrored", {&mirrored, NULL}},
    {"nearby", {&nearby, NULL}},
    {"askew", {&askew, NULL}},
    {"askew-finite", {&askew_finite, NULL}},
    {"two-pages", {&straight, &elsewhere}},
};
enum { SETTINGS = sizeof settings / sizeof *settings };

static const char grid[] = "--uv 12x12 --st 20x20 --uniform --rays 4";

static int bake_all(void **state) {
  if (bakes_setup(state)) return -1;
  char output[64], options[160];
  for (int n = 0; n < SETTINGS; ++n) {
    const struct setting *setting = &settings[n];
    bakes_lamp(setting->name);
    for (int page = 0; page < 2 && setting->frames[page]; ++page) {
      bakes_lamp_slab(setting->name, setting->frames[page]);
      bakes_lamp_macro(setting->name, "Waves", setting->frames[page], "1");
    }
    snprintf(output, sizeof output, "%s.tif", setting->name);
    snprintf(options, sizeof options, "--precision float %s", grid);
    bakes_start(setting->name, output, options);
  }
  bakes_start("straight", "logluv.tif", grid);
  bakes_start("askew-finite", "half.exr", "--precision half --uv 12x12 --st 20x20 --rays 8");
  bakes_wait();
  return 0;
}

/* A ray of lamp space for a, b, s, t; its origin anywhere on it. */
static void write_ray(FILE *out, const struct bakes_frame *frame, const double abst[4],
                      double along) {
  double lu =
      sqrt(frame->u[0] * frame->u[0] + frame->u[1] * frame->u[1] + frame->u[2] * frame->u[2]);
  double lv =
      sqrt(frame->v[0] * frame->v[0] + frame->v[1] * frame->v[1] + frame->v[2] * frame->v[2]);
  const double *n = frame->normal;
  double ln = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  double kappa = frame->distance > 0 ? 1 / frame->distance : 0;
  double s = abst[2] - kappa * abst[0], t = abst[3] - kappa * abst[1];
  double direction[3];
  for (int c = 0; c < 3; ++c)
    direction[c] = n[c] / ln + s * frame->u[c] / lu + t * frame->v[c] / lv;
  for (int c = 0; c < 3; ++c)
    fprintf(out, "%.17g ",
            frame->center[c] + abst[0] * frame->u[c] / lu + abst[1] * frame->v[c] / lv +
                along * direction[c]);
  fprintf(out, "%.17g %.17g %.17g\n", direction[0], direction[1], direction[2]);
}

/* From the first to the last sample of an axis: the format holds radiance constant
 * in the half cell beyond. */
static double between(uint64_t *seed, double low, double high, int samples) {
  double margin = 0.5 * (high - low) / samples;
  return random_between(seed, low + margin, high - margin);
}

/* Largest difference of lookups from the closed form, relative to the peak. */
static double compare(const char *output, const struct bakes_frame *frame, int page) {
  static double rays[RAYS][4];
  uint64_t seed = 1;
  double worst = 0, peak = 0;
  struct slab slab = bakes_load(output, page);
  const int *n = slab.samples;
  double lu = slab_spacing(&slab, SLAB_U) * n[0], lv = slab_spacing(&slab, SLAB_V) * n[1];
  FILE *out = fopen(bakes_path("rays"), "w");
  assert_non_null(out);
  for (int ray = 0; ray < RAYS; ++ray) {
    rays[ray][0] = between(&seed, -lu / 2, lu / 2, n[0]);
    rays[ray][1] = between(&seed, -lv / 2, lv / 2, n[1]);
    rays[ray][2] = between(&seed, frame->window[0], frame->window[1], n[2]);
    rays[ray][3] = between(&seed, frame->window[2], frame->window[3], n[3]);
    write_ray(out, frame, rays[ray], random_between(&seed, -2, 2));
  }
  assert_int_equal(fclose(out), 0);
  slab_free(&slab);
  assert_int_equal(bakes_run("\"$BAKESLAB\" lookup --page %d %s <rays >answers", page + 1, output),
                   0);
  FILE *in = fopen(bakes_path("answers"), "r");
  assert_non_null(in);
  for (int ray = 0; ray < RAYS; ++ray) {
    double found[3], expected[3];
    assert_int_equal(fscanf(in, "%lf %lf %lf", &found[0], &found[1], &found[2]), 3);
    bakes_waves(frame, 1, rays[ray], expected);
    for (int c = 0; c < 3; ++c) {
      worst = larger(worst, fabs(found[c] - expected[c]));
      peak = fmax(peak, expected[c]);
    }
  }
  fclose(in);
  print_message("# %-16s page %d: %.2g of the peak\n", output, page + 1, worst / peak);
  return worst / peak;
}

TEST(test_floats) {
  char output[64];
  for (int n = 0; n < SETTINGS; ++n)
    for (int page = 0; page < 2 && settings[n].frames[page]; ++page) {
      snprintf(output, sizeof output, "%s.tif", settings[n].name);
      double error = compare(output, settings[n].frames[page], page);
      if (!(error <= 1e-3)) fail_msg("%s page %d: %g", output, page + 1, error);
    }
}

TEST(test_logluv) {
  double error = compare("logluv.tif", &straight, 0);
  assert_true(error <= 0.022);
  assert_true(error > 1e-4); /* it is LogLuv that was looked up */
}

TEST(test_half_adaptive) {
  assert_true(compare("half.exr", &askew_finite, 0) <= 2e-3);
}

/* The border's half cells belong to the slab; beyond them there is no light. */
TEST(test_borders) {
  FILE *out = fopen(bakes_path("rays"), "w");
  assert_non_null(out);
  for (int axis = 0; axis < 4; ++axis)
    for (int side = -1; side <= 1; side += 2)
      for (int beyond = 0; beyond < 2; ++beyond) {
        double abst[4] = {0};
        abst[axis] = side * (axis < 2 ? 1 : 1.2) * (beyond ? 1.0001 : 0.9999);
        write_ray(out, &straight, abst, 0);
      }
  assert_int_equal(fclose(out), 0);
  assert_int_equal(bakes_run("\"$BAKESLAB\" lookup straight.tif <rays >answers"), 0);
  FILE *in = fopen(bakes_path("answers"), "r");
  assert_non_null(in);
  for (int ray = 0; ray < 16; ++ray) {
    double rgb[3];
    assert_int_equal(fscanf(in, "%lf %lf %lf", &rgb[0], &rgb[1], &rgb[2]), 3);
    if ((rgb[0] > 0) != (ray % 2 == 0)) fail_msg("ray %d: %g", ray, rgb[0]);
  }
  fclose(in);
}

int main(void) {
  return testing_run(bake_all, bakes_teardown);
}
