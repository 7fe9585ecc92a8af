/* test_ray_estimate.c - samples by rays of known sources: their flux, their true error against the
 * told one and that of plain bins, edges, colours, unequal rays, and how fine they become. */
#include <stdlib.h>
#include <string.h>

#include "import/rays/ray_estimate.h"
#include "import/rays/ray_etendue.h"
#include "import/rays/ray_held_out.h"
#include "import/rays/ray_partition.h"
#include "oracle/known_rays.h"
#include "oracle/random.h"
#include "testing.h"

enum { NU = 8, NS = 32, RAYS = 20000 };

/* What a test gives a ray: flux that is 1 on average. */
typedef void give_flux(const double abst[SLAB_AXES], uint64_t *seed, double rgb[3]);

static void one_each(const double abst[SLAB_AXES], uint64_t *seed, double rgb[3]) {
  (void)abst, (void)seed;
  rgb[0] = rgb[1] = rgb[2] = 1;
}

static void unequal(const double abst[SLAB_AXES], uint64_t *seed, double rgb[3]) {
  (void)abst;
  rgb[0] = rgb[1] = rgb[2] = -log(1 - random_number(seed));
}

static void red_or_green(const double abst[SLAB_AXES], uint64_t *seed, double rgb[3]) {
  (void)seed;
  rgb[0] = abst[SLAB_U] < 0;
  rgb[1] = abst[SLAB_U] >= 0;
  rgb[2] = 0;
}

static struct ray_estimate *shoot(enum known_kind kind, int rays, uint64_t seed, bool coloured,
                                  double tolerance, give_flux *give, double *all) {
  struct slab page = known_page(kind, NU, NS);
  struct ray_estimate *estimate;
  double abst[SLAB_AXES], rgb[3];
  *all = 0;
  const struct ray_estimate_wish wish = {
      .coloured = coloured, .tolerance = tolerance, .threads = 2};
  assert_int_equal(ray_estimate_new(&page, &wish, &estimate, NULL), RESULT_OK);
  for (int n = 0; n < rays; ++n) {
    known_ray(kind, &seed, abst);
    give(abst, &seed, rgb);
    *all += rgb[1];
    ray_estimate_add(estimate, abst, rgb);
  }
  if (kind == KNOWN_SQUARE) ray_estimate_whole(estimate, *all);
  return estimate;
}

/* Samples, which the caller frees. */
static struct slab take(struct ray_estimate *estimate, struct ray_estimate_told *told) {
  struct slab slab;
  struct error error;
  assert_int_equal(ray_estimate_finish(estimate, &slab, told, &error), RESULT_OK);
  ray_estimate_free(estimate);
  return slab;
}

/* A source's cells, with the factor by which rays that carry the flux `all` make it brighter. */
enum { CELLS = NU * NU * NS * NS };
struct truth {
  double mean[CELLS], etendue[CELLS], factor;
};

static const struct truth *truth_of(enum known_kind kind, double all) {
  static struct truth truth;
  truth.factor = all / known_cells(kind, (const int[]){NU, NU, NS, NS}, truth.mean, truth.etendue);
  return &truth;
}

/* The error of luminances against a source, relative. */
static double error_of(enum known_kind kind, const double *luminance, double all) {
  const struct truth *truth = truth_of(kind, all);
  double error = 0, square = 0;
  for (int n = 0; n < CELLS; ++n) {
    double mean = truth->factor * truth->mean[n], difference = luminance[n] - mean;
    error += truth->etendue[n] * difference * difference;
    square += truth->etendue[n] * mean * mean;
  }
  return sqrt(error / square);
}

static double true_error(enum known_kind kind, const struct slab *slab, double all) {
  double *luminance = calloc(slab_sample_count(slab), sizeof *luminance);
  for (size_t n = 0; n < slab_sample_count(slab); ++n)
    luminance[n] = slab_luminance(slab->rgb + 3 * n);
  double error = error_of(kind, luminance, all);
  free(luminance);
  return error;
}

/* The share of the flux that is in cells that the source does not reach. */
static double share_in_dark(enum known_kind kind, const struct slab *slab, double all) {
  const struct truth *truth = truth_of(kind, all);
  double flux = 0;
  for (size_t n = 0; n < CELLS; ++n)
    if (!(truth->mean[n] > 0)) flux += truth->etendue[n] * (double)slab->rgb[3 * n];
  return flux / all;
}

/* RMS error of the mean over the views of each direction. */
static double error_of_views(enum known_kind kind, const struct slab *slab, double all) {
  const struct truth *truth = truth_of(kind, all);
  static double sum[NS][NS];
  double square = 0;
  memset(sum, 0, sizeof sum);
  for (size_t n = 0; n < CELLS; ++n) {
    int at[SLAB_AXES];
    slab_locate(slab, n, at);
    sum[at[SLAB_S]][at[SLAB_T]] +=
        ((double)slab->rgb[3 * n] - truth->factor * truth->mean[n]) / (NU * NU);
  }
  for (int n = 0; n < NS * NS; ++n) square += sum[n / NS][n % NS] * sum[n / NS][n % NS];
  return sqrt(square / (NS * NS));
}

static void check_flux(const struct slab *slab, const double flux[3]) {
  double interpolated[3];
  assert_int_equal(slab_flux_metric(slab, interpolated, NULL), RESULT_OK);
  for (int c = 0; c < 3; ++c) assert_near(interpolated[c], flux[c], 1e-6 * flux[1]);
}

/* ---- Sources of known radiance ---- */

/* The told error is within 1.5 of the true one, and that is a third of plain bins' at most; what it
 * says of sums over the views is within 2.5; little light gets where the source has none; the
 * slab's flux is that of the rays. */
static void check_source(void **state) {
  enum known_kind kind = (enum known_kind)(*(const struct known_source **)state - known_sources);
  for (int run = 0; run < 2; ++run) {
    struct ray_estimate_told told;
    double all;
    struct slab slab = take(shoot(kind, RAYS, 7, false, 0, run ? unequal : one_each, &all), &told);
    double error = true_error(kind, &slab, all);
    assert_true(told.noise <= 1.5 * error && told.noise >= error / 1.5);
    assert_true(error <= told.bins / 3 && told.irradiance == 0);
    check_flux(&slab, told.flux);
    assert_near(told.flux[1], all, 1e-6 * all);
    assert_true(share_in_dark(kind, &slab, all) <= 0.04);
    double views = error_of_views(kind, &slab, all), told_views = told.sample_noise / NU;
    assert_true(told_views <= 2.5 * views && told_views >= views / 2.5);
    slab_free(&slab);
  }
}

static __attribute__((constructor)) void list_sources(void) {
  for (int kind = KNOWN_BEAM; kind < KNOWN_KINDS; ++kind)
    testing_add(known_sources[kind].name, check_source, &known_sources[kind]);
}

/* A Lambertian square millimetre of 1 W: 1 W / (pi mm2) all over, up to chance, which is told: its
 * mean square over some seeds is what it says. */
TEST(test_square_millimetre) {
  enum { SEEDS = 5 };
  double square = 0, expected = 0;
  for (uint64_t seed = 1; seed <= SEEDS; ++seed) {
    struct ray_estimate_told told;
    double all;
    struct slab slab = take(shoot(KNOWN_SQUARE, RAYS, seed, false, 0, one_each, &all), &told);
    for (size_t n = 0; n < slab_sample_count(&slab); ++n) {
      double radiance = (double)slab.rgb[3 * n] / all;
      assert_near(radiance, 318310, 4 * told.noise * 318310);
    }
    double error = true_error(KNOWN_SQUARE, &slab, all);
    square += error * error;
    expected += told.noise * told.noise;
    slab_free(&slab);
  }
  assert_true(square <= 2.25 * expected && expected <= 2.25 * square);
}

/* The rays held out show the error of samples without them. */
TEST(test_held_out) {
  struct slab page = known_page(KNOWN_BARS, NU, NS);
  struct ray_bins bins;
  struct ray_posterior posterior;
  struct ray_held_out held_out;
  uint64_t seed = 3;
  assert_int_equal(ray_bins_new(&page, false, &bins, NULL), RESULT_OK);
  for (int n = 0; n < 80 * RAYS; ++n) {
    double abst[SLAB_AXES];
    known_ray(KNOWN_BARS, &seed, abst);
    ray_bins_add(&bins, abst, (const double[]){1, 1, 1});
  }
  size_t cells = slab_sample_count(&page);
  double *etendue = ray_etendue(&page), *density = calloc(cells, sizeof *density), square = 0;
  float *counts = malloc(2 * cells * sizeof *counts);
  ray_bins_cells(&bins, etendue, 0, false, counts, counts + cells);
  struct ray_cells rays = {{NU, NU, NS, NS}, counts, counts + cells, 1};
  assert_int_equal(ray_partition(&rays, density, &posterior, NULL), RESULT_OK);
  assert_int_equal(ray_held_out(&bins, etendue, &held_out, NULL), RESULT_OK);
  for (size_t n = 0; n < cells; ++n) square += etendue[n] * density[n] * density[n];
  double error = error_of(KNOWN_BARS, density, bins.flux[0]);
  assert_near(sqrt(held_out.likely / square), error, 0.15 * error);
  assert_true(held_out.least > 0 && held_out.least < held_out.likely);
  free(counts);
  free(density);
  free(etendue);
  ray_bins_free(&bins);
}

/* ---- Edges ---- */

/* Cells without rays beside cells of 20 rays each, whose border is at no power of two, stay dark;
 * the light ones get even. */
TEST(test_edge) {
  enum { EDGE = 13 * 3 * 11 * 5 };
  static float count[EDGE], exposure[EDGE];
  static double density[EDGE];
  struct ray_cells cells = {{13, 3, 11, 5}, count, exposure, 1};
  struct ray_posterior posterior;
  struct slab grid = {.samples = {13, 3, 11, 5}};
  double counted = 0, kept = 0;
  for (size_t n = 0; n < EDGE; ++n) {
    int at[SLAB_AXES];
    slab_locate(&grid, n, at);
    exposure[n] = 2;
    count[n] = at[SLAB_U] < 7 && at[SLAB_S] >= 5 ? 20 : 0;
    counted += (double)count[n];
  }
  assert_int_equal(ray_partition(&cells, density, &posterior, NULL), RESULT_OK);
  for (size_t n = 0; n < EDGE; ++n) {
    if (count[n] > 0)
      assert_near(density[n], 10, 0.05);
    else
      assert_near(density[n], 0, 0.01);
    kept += density[n] * 2;
  }
  assert_near(kept, counted, 1e-6 * counted);
}

/* ---- Threads ---- */

TEST(test_threads) {
  enum { NUMBERS = 5 * 3 * 7 * 22 };
  static float count[NUMBERS], exposure[NUMBERS];
  static double density[2][NUMBERS];
  struct ray_posterior posterior[2];
  uint64_t seed = 7;
  for (size_t n = 0; n < NUMBERS; ++n) {
    exposure[n] = (float)random_between(&seed, 1, 2);
    count[n] = n % 3 ? (float)random_between(&seed, 0, 9) : 0;
  }
  for (int k = 0; k < 2; ++k) {
    struct ray_cells cells = {{5, 3, 7, 22}, count, exposure, k ? 5 : 1};
    assert_int_equal(ray_partition(&cells, density[k], &posterior[k], NULL), RESULT_OK);
  }
  assert_memory_equal(density[0], density[1], sizeof density[0]);
  assert_memory_equal(&posterior[0], &posterior[1], sizeof posterior[0]);
}

/* ---- Colours ---- */

TEST(test_colours) {
  struct ray_estimate_told told;
  double all;
  struct slab slab = take(shoot(KNOWN_LOBE, RAYS, 5, true, 0, red_or_green, &all), &told);
  check_flux(&slab, told.flux);
  assert_near(told.flux[1], all, 1e-6 * all);
  assert_near(told.flux[0] + told.flux[1], RAYS, 1e-6 * RAYS);
  const float *left = slab_at(&slab, 1, 4, NS / 2, NS / 2),
              *right = slab_at(&slab, 6, 4, NS / 2, NS / 2);
  assert_near(left[1] / left[0], 0, 0.05);
  assert_near(right[0] / right[1], 0, 0.05);
  slab_free(&slab);
}

/* ---- What is left out ---- */

TEST(test_refused) {
  struct slab page = known_page(KNOWN_BARS, NU, NS), slab;
  struct ray_estimate *estimate;
  struct ray_estimate_told told;
  const double white[] = {1, 1, 1}, none[] = {0, 0, 0}, bad[] = {1, NAN, 1},
               inside[] = {0, 0, 0, 0};
  const double beside[] = {0.11, 0, 0, 0}, steep[] = {0, 0, 0, -1.6}, lost[] = {0, NAN, 0, 0};
  const struct ray_estimate_wish one = {.threads = 1};
  struct slab huge = known_page(KNOWN_BARS, 1000, 1000);
  assert_int_equal(ray_estimate_new(&huge, &one, &estimate, NULL), RESULT_BAD);
  assert_int_equal(ray_estimate_new(&page, &one, &estimate, NULL), RESULT_OK);
  assert_false(ray_estimate_add(estimate, beside, white));
  assert_false(ray_estimate_add(estimate, steep, white));
  assert_false(ray_estimate_add(estimate, lost, white));
  assert_false(ray_estimate_add(estimate, inside, none));
  assert_false(ray_estimate_add(estimate, inside, bad));
  assert_int_equal(ray_estimate_finish(estimate, &slab, &told, NULL), RESULT_OK);
  assert_true(told.rays == 0 && told.noise == 0 && !slab_is_lit(&slab));
  slab_free(&slab);
  assert_true(ray_estimate_add(estimate, (const double[]){0.1, -0.1, 1.5, -1.5}, white));
  slab = take(estimate, &told);
  check_flux(&slab, white);
  slab_free(&slab);
}

/* ---- Resolution ---- */

/* RMS error of irradiance on a patch 4 apertures below, a third of an aperture wide, over its RMS:
 * against a sum over the source itself. */
static double irradiance_error(const struct slab *slab, double factor) {
  enum { SIDE = 4, VIEWS = 20 };
  const double *half = known_sources[KNOWN_LOBE].half;
  double away = RAY_ESTIMATE_APERTURES * 2 * half[0], error = 0, square = 0;
  for (int n = 0; n < SIDE * SIDE; ++n) {
    double x = (n % SIDE - 1.5) * half[0], y = (n / SIDE - 1.5) * half[0], told = 0, truth = 0;
    for (int k = 0; k < VIEWS * VIEWS; ++k) {
      double a = ((k % VIEWS + 0.5) / VIEWS * 2 - 1) * half[0], rgb[3];
      double b = ((k / VIEWS + 0.5) / VIEWS * 2 - 1) * half[1];
      const double abst[] = {a, b, (x - a) / away, (y - b) / away};
      double cosines = pow(1 + abst[2] * abst[2] + abst[3] * abst[3], -2);
      slab_lookup(slab, abst[0], abst[1], abst[2], abst[3], rgb);
      told += cosines * rgb[1];
      truth += cosines * factor * known_radiance(KNOWN_LOBE, abst);
    }
    error += (told - truth) * (told - truth);
    square += truth * truth;
  }
  return sqrt(error / square);
}

/* Fewer samples are enough for less, and keep the tolerance; where it cannot be kept, those of
 * least error are taken. */
TEST(test_tolerance) {
  struct ray_estimate_told loose, tight;
  double all;
  struct slab few = take(shoot(KNOWN_LOBE, 10 * RAYS, 9, false, 0.1, one_each, &all), &loose);
  double few_error = irradiance_error(&few, truth_of(KNOWN_LOBE, all)->factor);
  struct slab best = take(shoot(KNOWN_LOBE, 10 * RAYS, 9, false, 1e-4, one_each, &all), &tight);
  double best_error = irradiance_error(&best, truth_of(KNOWN_LOBE, all)->factor);
  assert_true(slab_sample_count(&few) < slab_sample_count(&best));
  assert_true(loose.irradiance <= 0.1 && tight.irradiance < loose.irradiance);
  assert_true(tight.irradiance > 1e-4 && few_error < 0.1 && best_error < 0.05);
  assert_memory_equal(loose.samples, few.samples, sizeof few.samples);
  check_flux(&few, loose.flux);
  check_flux(&best, tight.flux);
  slab_free(&few);
  slab_free(&best);
}

/* Samples that are given stay. */
TEST(test_given) {
  struct slab page = known_page(KNOWN_LOBE, NU, NS);
  const struct ray_estimate_wish wish = {.tolerance = 1, .st_given = true, .threads = 1};
  struct ray_estimate *estimate;
  struct ray_estimate_told told;
  assert_int_equal(ray_estimate_new(&page, &wish, &estimate, NULL), RESULT_OK);
  ray_estimate_add(estimate, (const double[]){0, 0, 0, 0}, (const double[]){1, 1, 1});
  struct slab slab = take(estimate, &told);
  assert_true(slab.samples[SLAB_U] < NU && slab.samples[SLAB_S] == NS);
  slab_free(&slab);
}

/* ---- Etendue ---- */

/* The antiderivative of 1/(1 + s^2 + t^2)^2: the form factor of a rectangle (M. F. Modest,
 * "Radiative Heat Transfer", configuration 11). */
static double antiderivative(double s, double t) {
  double x = sqrt(1 + s * s), y = sqrt(1 + t * t);
  return (s / x * atan(t / x) + t / y * atan(s / y)) / 2;
}

static double sum_of_etendue(const struct slab *page) {
  double *etendue = ray_etendue(page), sum = 0;
  for (size_t n = 0; n < slab_sample_count(page); ++n) sum += etendue[n];
  free(etendue);
  return sum;
}

TEST(test_etendue) {
  struct slab page = known_page(KNOWN_BARS, NU, NS);
  const double windows[][4] = {{-1, 2, 0.5, 0.75}, {-300, 500, -40, 1e-3}, {1, 1 + 1e-6, 2, 2.5}};
  for (size_t n = 0; n < sizeof windows / sizeof *windows; ++n) {
    const double *w = windows[n];
    memcpy(page.st_window, w, sizeof page.st_window);
    double expected = 0.04 * (antiderivative(w[1], w[3]) - antiderivative(w[0], w[3]) -
                              antiderivative(w[1], w[2]) + antiderivative(w[0], w[2]));
    assert_near(sum_of_etendue(&page), expected, 1e-8 * expected + 1e-17);
  }
}

/* With the st plane near by, against the flux of a slab of radiance 1, whose weights are others. */
TEST(test_etendue_near) {
  struct slab page = known_page(KNOWN_BARS, NU, NS);
  double flux[3];
  page.st_distance = 0.15;
  page.metres_per_unit = 0.01;
  assert_int_equal(slab_alloc(&page, NULL), RESULT_OK);
  for (size_t n = 0; n < 3 * slab_sample_count(&page); ++n) page.rgb[n] = 1;
  assert_int_equal(slab_flux_metric(&page, flux, NULL), RESULT_OK);
  assert_near(sum_of_etendue(&page), flux[0], 1e-8 * flux[0]);
  free(page.rgb);
}

int main(void) {
  return testing_run(NULL, NULL);
}
