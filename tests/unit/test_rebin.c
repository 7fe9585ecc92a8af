/* test_rebin.c - scattered rays become samples: constants, straight lines, flux, holes, and what
 * is told of errors; 200 cameras around a lamp of known radiance light a floor. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "helpers.h"
#include "import/pictures/focus.h"
#include "import/pictures/rebin_levels.h"
#include "oracle/lookup.h"
#include "oracle/random.h"

enum { MOST = 300000 };

struct light {
  struct slab slab;
  struct rebin_ray *ray;
  size_t count;
  struct rebin_report report;
  bool *known;
};

static struct light light_of(int u, int v, int s, int t) {
  struct light light = {.slab = slab_default()};
  struct error error = {{0}};
  const int samples[SLAB_AXES] = {u, v, s, t};
  memcpy(light.slab.samples, samples, sizeof samples);
  light.slab.u[0] = light.slab.v[2] = 0.2;
  light.slab.normal[0] = light.slab.normal[2] = 0;
  light.slab.normal[1] = -1;
  for (int k = 0; k < 4; ++k) light.slab.st_window[k] = k % 2 ? 1.5 : -1.5;
  assert_ok(slab_alloc(&light.slab, &error), &error);
  light.known = calloc(slab_sample_count(&light.slab), sizeof *light.known);
  assert_non_null(light.known);
  light.ray = calloc(MOST, sizeof *light.ray);
  assert_non_null(light.ray);
  return light;
}

static void add(struct light *light, const double at[SLAB_AXES], double value, uint32_t source) {
  struct rebin_ray *ray = &light->ray[light->count++];
  assert_true(light->count <= MOST);
  for (int axis = 0; axis < SLAB_AXES; ++axis) ray->at[axis] = (float)at[axis];
  ray->rgb[0] = ray->rgb[1] = ray->rgb[2] = (float)value;
  ray->weight = 1;
  ray->source = source;
}

static void do_rebin(struct light *light) {
  struct error error = {{0}};
  assert_ok(rebin(light->ray, light->count, &light->slab, light->known, &light->report, &error),
            &error);
}

static void free_light(struct light *light) {
  slab_free(&light->slab);
  free(light->ray);
  free(light->known);
}

static double holes(const struct light *light) {
  size_t count = slab_sample_count(&light->slab), known = 0;
  for (size_t n = 0; n < count; ++n) known += light->known[n];
  return 1 - (double)known / (double)count;
}

static void random_place(const struct light *light, uint64_t *seed, double at[SLAB_AXES]) {
  for (int axis = 0; axis < SLAB_AXES; ++axis)
    at[axis] = random_number(seed) * light->slab.samples[axis] - 0.5;
}

TEST(test_constants_stay) {
  static const int counts[] = {1, 2, 40, 3000};
  for (int k = 0; k < 4; ++k) {
    struct light light = light_of(3, 2, 7, 10);
    uint64_t seed = 3;
    double at[SLAB_AXES];
    for (int n = 0; n < counts[k]; ++n) {
      random_place(&light, &seed, at);
      add(&light, at, 7, (uint32_t)n % 16);
    }
    do_rebin(&light);
    for (size_t n = 0; n < 3 * slab_sample_count(&light.slab); ++n)
      assert_near((double)light.slab.rgb[n], 7, 1e-5);
    if (counts[k] > 1) assert_near(light.report.error, 0, 1e-6);
    free_light(&light);
  }
}

TEST(test_no_rays_no_light) {
  struct light light = light_of(1, 1, 4, 4);
  do_rebin(&light);
  assert_false(slab_is_lit(&light.slab));
  assert_near(holes(&light), 1, 0);
  free_light(&light);
}

/* One value at each end of a row: all between is filled in, in order, and mirrored alike. */
TEST(test_filling_is_between) {
  for (int n = 2; n <= 33; ++n) {
    struct rebin_levels levels;
    struct error error = {{0}};
    const int samples[SLAB_AXES] = {1, 1, n, 1};
    assert_ok(rebin_levels_make(samples, &levels, &error), &error);
    float *node = levels.node[0];
    for (int end = 0; end < 2; ++end) {
      float *known = node + REBIN_NODE * (end ? n - 1 : 0);
      known[0] = end ? 5 : 1;
      known[3] = 1;
    }
    rebin_levels_fill(&levels);
    assert_near((double)node[0], 1, 0);
    assert_near((double)node[REBIN_NODE * (n - 1)], 5, 0);
    for (int k = 0; k < n; ++k) {
      double here = (double)node[REBIN_NODE * k];
      assert_true(k == 0 || here >= (double)node[REBIN_NODE * (k - 1)]);
      if (n % 2 == 0 && (n & (n - 1)) == 0)
        assert_near(here + (double)node[REBIN_NODE * (n - 1 - k)], 6, 1e-5);
    }
    rebin_levels_free(&levels);
  }
}

/* What is missing are directions: each position keeps its own radiance. */
TEST(test_positions_stay_apart) {
  struct light light = light_of(4, 1, 16, 16);
  for (int i = 0; i < 4; ++i)
    for (int n = 0; n < 3; ++n) {
      const double at[SLAB_AXES] = {i, 0, 3 + 5 * n, 8 - 2 * n};
      add(&light, at, 1 + i, (uint32_t)n);
    }
  do_rebin(&light);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 16; ++k)
      for (int l = 0; l < 16; ++l)
        assert_near((double)*slab_at(&light.slab, i, 0, k, l), 1 + i, 1e-4);
  assert_near(holes(&light), 1 - 3 / 256., 1e-12);
  free_light(&light);
}

/* Means of what lies around a sample lean where rays lie to one side; rounds mend that. Not in the
 * half cells at borders, where interpolation is constant. */
TEST(test_straight_lines) {
  struct light light = light_of(3, 3, 6, 6);
  uint64_t seed = 5;
  double at[SLAB_AXES], worst = 0;
  for (int n = 0; n < 20000; ++n) {
    for (int axis = 0; axis < SLAB_AXES; ++axis)
      at[axis] = random_number(&seed) * (light.slab.samples[axis] - 1);
    add(&light, at, 20 + at[0] - 2 * at[1] + 3 * at[2] + at[3], (uint32_t)n % 64);
  }
  do_rebin(&light);
  for (size_t n = 0; n < slab_sample_count(&light.slab); ++n) {
    int s[SLAB_AXES];
    slab_locate(&light.slab, n, s);
    double truth = 20 + s[0] - 2 * s[1] + 3 * s[2] + s[3];
    worst = larger(worst, fabs((double)light.slab.rgb[3 * n] - truth));
  }
  print_message("# straight lines: off by %.3f after %d rounds\n", worst, light.report.rounds);
  assert_true(worst < 0.2);
  assert_int_equal(light.report.rounds, REBIN_ROUNDS);
  free_light(&light);
}

/* ---- A lamp of known radiance in pictures ---- */

static double lobe(double s, double t) {
  return exp(-(s * s + t * t) / (2 * 0.6 * 0.6));
}

/* A wavy source behind the aperture, under a lobe. */
static double radiance(const double abst[SLAB_AXES]) {
  double x = abst[0] - 0.05 * abst[2], y = abst[1] - 0.05 * abst[3];
  return (1 + 0.5 * sin(20 * x + 1) * cos(12 * y)) * lobe(abst[2], abst[3]);
}

/* A bulb 0.1 behind the aperture before a glowing wall, seen at the point (x, y) of its depth. */
static double bulb(const double abst[SLAB_AXES]) {
  double x = abst[0] - 0.1 * abst[2] - 0.02, y = abst[1] - 0.1 * abst[3];
  return hypot(x, y) < 0.025 ? 20 : 1;
}

/* The same behind a round opening as wide as the aperture. */
static double stopped_bulb(const double abst[SLAB_AXES]) {
  return hypot(abst[0], abst[1]) < 0.1 ? bulb(abst) : 0;
}

static double (*lamp)(const double abst[SLAB_AXES]) = radiance;

/* The mean over a half cell of the aperture, as a picture from (x, y, z) has it. */
static double half_cell(const double from[3], const double middle[2], const double size[2]) {
  double sum = 0;
  for (int n = 0; n < 16; ++n) {
    const double a = middle[0] + ((n % 4 + 0.5) / 4 - 0.5) * size[0];
    const double b = middle[1] + ((n / 4 + 0.5) / 4 - 0.5) * size[1];
    const double abst[SLAB_AXES] = {a, b, (from[0] - a) / from[2], (from[1] - b) / from[2]};
    sum += lamp(abst) / 16;
  }
  return sum;
}

/* What cameras at random places of a hemisphere of 3 apertures see of the aperture. */
static void take_pictures(struct light *light, int pictures, uint64_t seed) {
  const int *size = light->slab.samples;
  for (int n = 0; n < pictures; ++n) {
    double z = random_number(&seed), angle = 2 * M_PI * random_number(&seed), r = sqrt(1 - z * z);
    const double from[3] = {0.6 * r * cos(angle), 0.6 * r * sin(angle), 0.6 * z};
    const double halves[2] = {0.1 / size[0], 0.1 / size[1]};
    for (int p = 0; p < 4 * size[0] * size[1]; ++p) {
      const int half[2] = {p % (2 * size[0]), p / (2 * size[0])};
      double abst[SLAB_AXES], at[SLAB_AXES];
      bool within = true;
      for (int k = 0; k < 2; ++k) {
        at[k] = (half[k] + 0.5) / 2 - 0.5;
        abst[k] = 0.2 * ((half[k] + 0.5) / (2 * size[k]) - 0.5);
        abst[2 + k] = (from[k] - abst[k]) / from[2];
        at[2 + k] = (abst[2 + k] + 1.5) / 3 * size[2 + k] - 0.5;
        within = within && fabs(abst[2 + k]) <= 1.5;
      }
      if (!within) continue;
      double square = 1 + abst[2] * abst[2] + abst[3] * abst[3];
      add(light, at, half_cell(from, abst, halves), (uint32_t)n);
      light->ray[light->count - 1].weight = (float)(1 / (square * square));
    }
  }
}

/* Irradiance of a floor, by the formula or by the slab. */
static double floor_light(const struct slab *slab, double x, double y, double below) {
  double sum = 0;
  const int points = lamp == radiance ? 24 : 64; /* along an edge */
  for (int j = 0; j < points; ++j)
    for (int i = 0; i < points; ++i) {
      double a = 0.2 * ((i + 0.5) / points - 0.5), b = 0.2 * ((j + 0.5) / points - 0.5), rgb[3];
      const double abst[SLAB_AXES] = {a, b, (x - a) / below, (y - b) / below};
      if (fabs(abst[2]) > 1.5 || fabs(abst[3]) > 1.5) continue;
      double square = 1 + abst[2] * abst[2] + abst[3] * abst[3];
      if (slab)
        oracle_lookup(slab, abst, rgb);
      else
        rgb[1] = lamp(abst);
      sum += rgb[1] / (square * square);
    }
  return sum / (points * points * below * below);
}

/* Through aperture and window, by midpoints. */
static double lamp_flux(void) {
  double sum = 0;
  for (int n = 0; n < 40 * 40 * 40 * 40; ++n) {
    const double abst[SLAB_AXES] = {
        0.2 * ((n % 40 + 0.5) / 40 - 0.5), 0.2 * ((n / 40 % 40 + 0.5) / 40 - 0.5),
        3 * ((n / 1600 % 40 + 0.5) / 40 - 0.5), 3 * ((n / 64000 + 0.5) / 40 - 0.5)};
    double square = 1 + abst[2] * abst[2] + abst[3] * abst[3];
    sum += lamp(abst) / (square * square);
  }
  return sum * 0.04 * 9 / (40 * 40 * 40 * 40);
}

static double floor_error(const struct slab *slab, double apertures) {
  double below = 0.2 * apertures, wrong = 0, all = 0;
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i) {
      double x = ((i + 0.5) / 8 - 1) * 1.5 * below, y = ((j + 0.5) / 8 - 1) * 1.5 * below;
      double truth = floor_light(NULL, x, y, below), off = floor_light(slab, x, y, below) - truth;
      wrong += off * off;
      all += truth * truth;
    }
  return sqrt(wrong / all);
}

TEST(test_200_pictures_light_a_floor) {
  static const double apertures[] = {0.5, 3, 30};
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    struct light light = light_of(8, 8, 11, 11);
    take_pictures(&light, 200, seed);
    do_rebin(&light);
    double rgb[3];
    struct error error = {{0}};
    assert_ok(slab_flux(&light.slab, rgb, &error), &error);
    assert_near(rgb[1] / lamp_flux(), 1, 0.025);
    for (int k = 0; k < 3; ++k) {
      double off = floor_error(&light.slab, apertures[k]);
      print_message("# seed %d, %g apertures away: %.2f %%; told %.2f %%, of means %.2f %%; holes "
                    "%.1f %%\n",
                    (int)seed, apertures[k], 100 * off, 100 * light.report.error,
                    100 * light.report.mean_error, 100 * holes(&light));
      assert_true(off < 0.03);
    }
    free_light(&light);
  }
}

/* Between pictures it moves, and does not fade from one place into the next. */
TEST(test_a_bulb_stays_sharp) {
  struct light light = light_of(12, 12, 11, 11);
  struct slab slab = light.slab;
  struct error error = {{0}};
  struct focus_report report;
  slab.rgb = NULL;
  lamp = bulb;
  take_pictures(&light, 200, 7);
  assert_ok(focus_rebin(light.ray, light.count, (const int[]){0, 0}, &slab, &report, &error),
            &error);
  assert_near(report.depth, 0.1, 0.013);
  assert_true(slab.samples[SLAB_S] > 11); /* finer than the cameras stand */
  assert_true(report.holes > 0 && report.holes < 0.2);
  assert_true(report.flux_holes > 0 && report.flux_holes < report.holes);
  do_rebin(&light); /* on the aperture itself */
  double near = floor_error(&slab, 0.5), far = floor_error(&slab, 3);
  print_message("# at its depth: %.2f %% near by, %.2f %% far; on the aperture: %.2f %%, %.2f %%\n",
                100 * near, 100 * far, 100 * floor_error(&light.slab, 0.5),
                100 * floor_error(&light.slab, 3));
  assert_true(near < 0.03 && far < 0.03);
  assert_true(report.rebin.error < 0.7 * light.report.error);
  slab_free(&slab);
  free_light(&light);
}

/* The opening's edge is sharp though light is interpolated behind it: its corners are dark, and its
 * flux is not dimmed by them. */
TEST(test_light_stays_within_the_opening) {
  struct light light = light_of(12, 12, 11, 11);
  struct slab slab = light.slab;
  struct error error = {{0}};
  struct focus_report report;
  slab.rgb = NULL;
  lamp = stopped_bulb;
  take_pictures(&light, 200, 7);
  assert_ok(focus_rebin(light.ray, light.count, (const int[]){0, 0}, &slab, &report, &error),
            &error);
  assert_near(report.depth, 0.1, 0.026);
  for (int k = 0; k < slab.samples[SLAB_S]; ++k)
    for (int l = 0; l < slab.samples[SLAB_T]; ++l)
      assert_near((double)*slab_at(&slab, 0, 11, k, l), 0, 0);
  assert_true(*slab_at(&slab, 3, 3, slab.samples[SLAB_S] / 2, slab.samples[SLAB_T] / 2) > 0);
  double near = floor_error(&slab, 0.5), far = floor_error(&slab, 3);
  print_message("# with a round opening: %.2f %% near by, %.2f %% far\n", 100 * near, 100 * far);
  assert_true(near < 0.06 && far < 0.06);
  slab_free(&slab);
  free_light(&light);
}

int main(void) {
  return testing_run(NULL, NULL);
}
