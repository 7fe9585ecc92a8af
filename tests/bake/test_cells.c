/* test_cells.c - samples are means over their 4D cells: hard edges come out as the
 * part of a cell that is lit, linear radiance exactly; rays go where the noise is,
 * and the noise that a slab states is that of its samples. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bakes.h"
#include "batch/bake_plan.h"

static const struct bakes_frame frame = {{0, 0, 0}, {2, 0, 0},          {0, 1, 0},
                                         {0, 0, 1}, {-1, 1, -0.8, 0.8}, 0};
static const struct bakes_frame nearby = {{0, 0, 0},  {2, 0, 0},          {0, 1, 0},
                                          {0, 0, -1}, {-1, 1, -0.8, 0.8}, 2};

/* Lit a little beyond the middle, and nothing else. */
static const double depth = 3, pane[4] = {0.23, 0.71, -0.33, 0.05};
/* The same with its edges elsewhere in their cells. */
enum { PANES = 4 };
static const double panes[PANES][4] = {{0.23, 0.71, -0.33, 0.05},
                                       {-1.1, -0.52, 0.31, 0.8},
                                       {0.05, 0.4, 0.02, 0.61},
                                       {-0.77, 0.02, -0.9, -0.44}};

static void pane_lamp(const char *name, const double rectangle[4], const char *radiance) {
  char rest[160];
  snprintf(rest, sizeof rest, "%g, %.17g, %.17g, %.17g, %.17g, %s", depth, rectangle[0],
           rectangle[1], rectangle[2], rectangle[3], radiance);
  bakes_lamp(name);
  bakes_lamp_slab(name, &frame);
  bakes_lamp_macro(name, "Pane", &frame, rest);
}

static int bake_all(void **state) {
  if (bakes_setup(state)) return -1;
  char name[64], lamp[24];
  pane_lamp("pane", pane, "1");
  static const int rays[] = {2, 4, 16, 64, 256};
  for (int n = 0; n < 5; ++n) {
    char options[128];
    snprintf(name, sizeof name, "pane%d.exr", rays[n]);
    snprintf(options, sizeof options, "--uv 4x4 --st 10x10 --uniform --rays %d", rays[n]);
    bakes_start("pane", name, options);
  }
  bakes_start("pane", "points.exr", "--uv 4x4 --st 10x10 --centre");
  bakes_lamp("slope");
  bakes_lamp_slab("slope", &frame);
  bakes_lamp_macro("slope", "Slope", &frame, "1.5, 1");
  bakes_lamp("nearby");
  bakes_lamp_slab("nearby", &nearby);
  bakes_lamp_macro("nearby", "Slope", &nearby, "1.5, 1");
  bakes_start("slope", "slope2.exr", "--uv 2x3 --st 5x4 --rays 2");
  bakes_start("slope", "slope6.exr", "--uv 2x3 --st 5x4 --rays 6");
  bakes_start("slope", "slope16.exr", "--uv 2x3 --st 5x4 --rays 16");
  bakes_start("slope", "slope1.exr", "--uv 2x3 --st 5x4 --centre");
  bakes_start("nearby", "nearby4.exr", "--uv 3x2 --st 4x5 --rays 4");
  bakes_start("nearby", "nearby10.exr", "--uv 3x2 --st 4x5 --uniform --rays 10");
  for (int n = 0; n < PANES; ++n) {
    snprintf(lamp, sizeof lamp, "pane-%d", n);
    pane_lamp(lamp, panes[n], "rgb <1, 0.5, 2>");
    snprintf(name, sizeof name, "uniform-%d.exr", n);
    bakes_start(lamp, name, "--uv 3x2 --st 64x64 --rays 16 --uniform");
    snprintf(name, sizeof name, "adaptive-%d.exr", n);
    bakes_start(lamp, name, "--uv 3x2 --st 64x64 --rays 16");
  }
  bakes_lamp("flat");
  bakes_lamp_slab("flat", &frame);
  bakes_lamp_add("flat", "sphere { 0, 1000 hollow pigment { rgb <0.3, 0.7, 0.9> }\n"
                         "  finish { emission 1 diffuse 0 } }\n");
  bakes_start("flat", "flat.exr", "--uv 3 --st 8 --rays 16");
  bakes_wait();
  return 0;
}

/* RMS difference of the red samples from the cell means; `random` gets what it would
 * be with one random ray a sample. */
static double pane_error(const char *output, const double rectangle[4], double *random) {
  struct slab slab = bakes_load(output, 0);
  double sum = 0, variance = 0, abst[4], count = (double)slab_sample_count(&slab);
  int at[SLAB_AXES];
  for (size_t p = 0; p < slab_sample_count(&slab); ++p) {
    bakes_sample(&slab, p, at, abst);
    double mean = bakes_pane(&slab, depth, rectangle, at);
    double difference = (double)slab.rgb[3 * p] - mean;
    sum += difference * difference;
    variance += mean * (1 - mean);
  }
  slab_free(&slab);
  if (random) *random = sqrt(variance / count);
  return sqrt(sum / count);
}

/* The mean is that of the cell, and K rays come nearer to it than K random ones would. */
TEST(test_hard_edge) {
  static const int rays[] = {2, 4, 16, 64, 256};
  double before = 1, random;
  for (int n = 0; n < 5; ++n) {
    char name[64];
    snprintf(name, sizeof name, "pane%d.exr", rays[n]);
    double error = pane_error(name, pane, &random);
    random /= sqrt(rays[n]);
    print_message("# %3d rays: %.4f, random ones %.4f\n", rays[n], error, random);
    assert_true(error < before && error < random);
    before = error;
  }
}

/* --centre: lit or not, as the ray through the middle of the cell is. */
TEST(test_centre) {
  struct slab slab = bakes_load("points.exr", 0);
  int lit = 0, at[SLAB_AXES];
  for (size_t p = 0; p < slab_sample_count(&slab); ++p) {
    double abst[4], x, y;
    bakes_sample(&slab, p, at, abst);
    bakes_point(&frame, abst, depth, &x, &y);
    bool inside = x > pane[0] && x < pane[1] && y > pane[2] && y < pane[3];
    lit += inside;
    assert_true(slab.rgb[3 * p] == (inside ? 1 : 0));
  }
  assert_true(lit > 5);
  assert_non_null(strstr(slab.json, "\"samples_are\": \"points\""));
  slab_free(&slab);
  slab = bakes_load("pane2.exr", 0);
  assert_non_null(strstr(slab.json, "\"samples_are\": \"cell_means\""));
  slab_free(&slab);
}

/* Radiance linear in a, b, s and t has the mean of its cell at the centre, and pairs of
 * opposite rays find it: what remains is the rounding of POV-Ray's half floats. */
static void check_slope(const char *output, const struct bakes_frame *where) {
  struct slab slab = bakes_load(output, 0);
  double worst = 0, abst[4], expected[3];
  int at[SLAB_AXES];
  for (size_t p = 0; p < slab_sample_count(&slab); ++p) {
    bakes_sample(&slab, p, at, abst);
    bakes_slope(where, 1.5, abst, expected);
    for (size_t c = 0; c < 3; ++c)
      worst = larger(worst, fabs((double)slab.rgb[3 * p + c] / expected[c] - 1));
  }
  print_message("# %-12s %.2g\n", output, worst);
  if (!(worst <= 0x1p-10)) fail_msg("%s: %g", output, worst);
  slab_free(&slab);
}

TEST(test_linear) {
  check_slope("slope1.exr", &frame);
  check_slope("slope2.exr", &frame);
  check_slope("slope6.exr", &frame);
  check_slope("slope16.exr", &frame);
  check_slope("nearby4.exr", &nearby);
  check_slope("nearby10.exr", &nearby);
}

static double red_flux(const struct slab *slab) {
  double rgb[3];
  slab_flux(slab, rgb, NULL);
  return rgb[0];
}

/* The flux that the right samples would have, and theirs. */
static double flux_error(const char *output, const double rectangle[4]) {
  struct slab slab = bakes_load(output, 0);
  double found = red_flux(&slab), abst[4];
  int at[SLAB_AXES];
  for (size_t p = 0; p < slab_sample_count(&slab); ++p) {
    bakes_sample(&slab, p, at, abst);
    slab.rgb[3 * p] = (float)bakes_pane(&slab, depth, rectangle, at);
  }
  double right = red_flux(&slab);
  slab_free(&slab);
  return found / right - 1;
}

/* On a mostly black lamp, no more rays and less error. */
TEST(test_adaptive) {
  double uniform = 0, adaptive = 0;
  for (int n = 0; n < PANES; ++n) {
    char name[64];
    snprintf(name, sizeof name, "uniform-%d.exr", n);
    double before = pane_error(name, panes[n], NULL);
    snprintf(name, sizeof name, "adaptive-%d.exr", n);
    double after = pane_error(name, panes[n], NULL);
    struct slab slab = bakes_load(name, 0);
    double rays = bakes_provenance(&slab, "rays", NULL);
    slab_free(&slab);
    print_message("# pane %d: uniform %.4f, adaptive %.4f with %.1f rays\n", n, before, after,
                  rays);
    assert_true(rays <= 16);
    uniform += before * before;
    adaptive += after * after;
  }
  assert_true(sqrt(adaptive) < 0.6 * sqrt(uniform));
}

/* Stated noise is an upper estimate, within a factor, of the true error. */
TEST(test_noise) {
  double sum_flux = 0, sum_stated = 0;
  for (int n = 0; n < 2 * PANES; ++n) {
    char name[64];
    snprintf(name, sizeof name, "%s-%d.exr", n % 2 ? "uniform" : "adaptive", n / 2);
    struct slab slab = bakes_load(name, 0);
    double luminance = 0.2126 + 0.7152 * 0.5 + 0.0722 * 2;
    double stated = bakes_provenance(&slab, "noise", "sample") / luminance;
    double stated_flux = bakes_provenance(&slab, "noise", "flux");
    slab_free(&slab);
    double error = pane_error(name, panes[n / 2], NULL), flux = flux_error(name, panes[n / 2]);
    print_message("# %-14s samples %.4f, stated %.4f; flux %+.4f, stated %.4f\n", name, error,
                  stated, flux, stated_flux);
    assert_true(stated > 0.7 * error && stated < 4 * error);
    assert_true(fabs(flux) < 3 * stated_flux);
    sum_flux += flux * flux;
    sum_stated += stated_flux * stated_flux;
  }
  assert_true(sum_stated > 0.5 * sum_flux && sum_stated < 400 * sum_flux);
}

/* All rays see the same: no noise, in samples or in flux. */
TEST(test_no_noise) {
  struct slab slab = bakes_load("flat.exr", 0);
  assert_true(bakes_provenance(&slab, "noise", "sample") < 1e-7);
  assert_true(bakes_provenance(&slab, "noise", "flux") < 1e-7);
  assert_true(fabs((double)slab.rgb[0] / 0.3 - 1) < 0x1p-11);
  assert_true(bakes_provenance(&slab, "rays", NULL) == 5); /* the search, and two pairs */
  slab_free(&slab);
}

/* The plan that is told counts batches and frames as the bake cuts them. */
TEST(test_counted) {
  static const int samples[][SLAB_AXES] = {
      {4, 4, 10, 10}, {16, 16, 64, 64}, {30, 20, 150, 70}, {64, 48, 4, 8}, {64, 64, 64, 48}};
  for (size_t k = 0; k < sizeof samples / sizeof *samples; ++k)
    for (int form = BAKE_MESH; form <= BAKE_TRANSPOSED; ++form)
      for (int dear = 0; dear < 2; ++dear) {
        struct slab slabs[2] = {{.st_distance = INFINITY}, {.st_distance = INFINITY}};
        struct bake_tiles tiles;
        struct bake_round round;
        struct bake_plan_size size;
        double largest = 0;
        for (int n = 0; n < 2; ++n) memcpy(slabs[n].samples, samples[k], sizeof samples[k]);
        bake_plan_count(slabs, 2, 6, (enum bake_form)form, dear, &size);
        assert_int_equal(bake_tiles_init(&tiles, slabs, 2, form == BAKE_TRANSPOSED, 8, NULL),
                         RESULT_OK);
        tiles.dear = dear;
        assert_int_equal(bake_plan_whole(&tiles, 0, 6, (enum bake_form)form, &round, NULL),
                         RESULT_OK);
        for (size_t n = 0; n < round.batch_count; ++n)
          largest = fmax(largest, (double)round.batches[n].rays);
        /* Batches end with a pair of images; the last one may be short. */
        assert_true(fabs(size.batches - (double)round.batch_count) <= 1 + 0.1 * size.batches);
        assert_true(fabs(size.largest - largest) <= 0.1 * largest + 2 * 150 * 70);
        assert_true(size.frames == (form == BAKE_MESH ? 0 : (double)round.unit_count));
        bake_round_free(&round);
        bake_tiles_free(&tiles);
      }
}

int main(void) {
  return testing_run(bake_all, bakes_teardown);
}
