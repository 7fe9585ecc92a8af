/* test_cluster.c - POV-Ray lit by the area lights that were fitted to a slab, against
 * the direct sum of those lights and against the slab; and by its far field. */
#include <stdio.h>
#include <string.h>

#include "chain.h"
#include "include/cluster/cluster.h"
#include "include/point/point.h"

/* The picture's own half floats cost 2e-4. */
static const double exact = 5e-4;

/* Of the stated errors: planes here are tilted, and sampled elsewhere, which matters most
 * where the window cuts light off. */
static const double slack = 1.15, more = 5e-3;

static const int samples[4] = {8, 8, 16, 14};
static const double edges[2] = {1, 0.8}, window[4] = {-1.2, 1.5, -1.4, 1.1};

/* A matt reflector around a soft bulb off its middle, bluer to one side. */
static struct slab smooth_slab(double st_distance, int mirrored, uint64_t seed) {
  struct slab slab = chain_slab(samples, edges, window, st_distance, mirrored, seed);
  for (size_t m = 0; m < slab_sample_count(&slab); ++m) {
    int at[4];
    double x[4];
    slab_locate(&slab, m, at);
    for (int axis = 0; axis < 4; ++axis) x[axis] = slab_position(&slab, axis, at[axis]);
    double s = x[2] - x[0] / st_distance, p = x[0] - 0.4 * s + 0.1;
    double q = x[1] - 0.4 * (x[3] - x[1] / st_distance);
    double light = 1 + cos(3 * x[0]) * cos(2 * x[1]) + 5 * exp(-(p * p + q * q) / 0.1);
    for (int c = 0; c < 3; ++c)
      slab.rgb[3 * m + (size_t)c] = (float)(light * (1 + 0.3 * s * (c - 1)));
  }
  return slab;
}

/* (x, y) on the page, in widths, and z along its normal. */
static void from_page(const struct slab *slab, double x, double y, double z, double origin,
                      double out[3]) {
  double lu = chain_length(slab->u), lv = chain_length(slab->v), width = fmax(lu, lv);
  for (int c = 0; c < 3; ++c)
    out[c] = origin * slab->center[c] +
             width * (x * slab->u[c] / lu + y * slab->v[c] / lv + z * slab->normal[c]);
}

/* Intensity of a lobe, from the header's words. */
static double lobe(const struct cluster_light *light, double cosine) {
  if (cosine <= light->cos_falloff) return 0;
  double p = cosine >= light->cos_radius
                 ? 1
                 : (cosine - light->cos_falloff) / (light->cos_radius - light->cos_falloff);
  return pow(cosine, light->tightness) * p * p * (3 - 2 * p);
}

static int points(int size, int most) {
  while (size > most) size /= 2;
  return size;
}

static void add_light(const struct chain_lamp *lamp, const struct slab *slab,
                      const struct cluster_light *light, int most, const double at[3],
                      const double normal[3], double rgb[3]) {
  int nu = points(light->size[0], most), nv = points(light->size[1], most);
  double axis[3], place[3], width = fmax(chain_length(slab->u), chain_length(slab->v));
  from_page(slab, light->axis[0], light->axis[1], 1, 0, place);
  chain_move(lamp->matrix, lamp->scale, place, 0, axis);
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      double p = (i + 0.5) / nu - 0.5, q = (j + 0.5) / nv - 0.5, away[3];
      from_page(slab, light->center[0] + p * light->edge[0][0] + q * light->edge[1][0],
                light->center[1] + p * light->edge[0][1] + q * light->edge[1][1], 0, 1, place);
      chain_move(lamp->matrix, lamp->scale, place, 1, away);
      for (int c = 0; c < 3; ++c) away[c] = at[c] - away[c];
      double r = chain_length(away), facing = -chain_dot(away, normal) / r;
      double cosine = chain_dot(away, axis) / (r * chain_length(axis));
      if (facing <= 0) continue;
      double size = lamp->scale * width / r;
      for (int c = 0; c < 3; ++c)
        rgb[c] += lamp->gain * light->rgb[c] * lobe(light, cosine) * facing * size * size / nu / nv;
    }
}

/* Radiance E/pi under the lights of all lamps, which are all alike. */
static void sum_lights(const struct chain_lamp *lamps, int count, const struct cluster *cluster,
                       int most, const struct chain_plane *plane, double *rgb) {
  for (int k = 0; k < CHAIN_PIXELS; ++k) {
    double at[3], sum[3] = {0, 0, 0};
    chain_pixel(plane, CHAIN_SIZE, k, at);
    for (int n = 0; n < count; ++n)
      for (int p = 0; p < cluster->page_count; ++p)
        for (int l = 0; l < cluster->pages[p].count; ++l)
          add_light(&lamps[n], &lamps[n].pages[p], &cluster->pages[p].lights[l], most, at,
                    plane->normal, sum);
    for (int c = 0; c < 3; ++c) rgb[3 * k + c] = sum[c] / M_PI;
  }
}

static struct cluster fit(const struct slab *pages, int count, int lights) {
  struct cluster cluster;
  struct error error;
  char options[64];
  snprintf(options, sizeof options, "--mode cluster --lights %d", lights);
  chain_include(pages, count, "lamp", options);
  if (cluster_make(pages, count, &(struct cluster_wish){.lights = lights, .distance = 4}, &cluster,
                   &error) != RESULT_OK)
    fail_msg("%s", error.text);
  return cluster;
}

/* The plane under the lamps' include is lit as by their fitted lights. */
static void compare(const char *what, const struct chain_lamp *lamps, int count,
                    const struct cluster *cluster, int page, double distance) {
  static double direct[3 * CHAIN_PIXELS];
  struct chain_plane plane = chain_facing(&lamps[0], page, distance);
  sum_lights(lamps, count, cluster, 1 << 20, &plane, direct);
  double rmse = chain_error_of(&plane, 1, chain_placed(lamps, count), direct);
  print_message("%-32s %.2g\n", what, rmse);
  if (!(rmse <= exact)) fail_msg("%s: relative RMSE %g", what, rmse);
}

/* The error that the header states holds. */
static void compare_slab(const char *what, const struct slab *slab, double distance,
                         double stated) {
  struct chain_lamp lamp = chain_lamp_of(slab, 1, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, distance);
  double rmse = chain_error(&lamp, 1, &plane, 1, chain_placed(&lamp, 1));
  print_message("%-32s %.3g, stated %.3g\n", what, rmse, stated);
  if (!(rmse <= slack * stated + more)) fail_msg("%s: %g, stated %g", what, rmse, stated);
}

TEST(test_lights) {
  static const struct {
    const char *what;
    double st_distance, distance;
    int mirrored, lights;
  } cases[] = {
      {"1 light, near", INFINITY, 0.7, 0, 1},
      {"8 lights", INFINITY, 4, 0, 8},
      {"4 lights, st plane, u x v = -n", 1.7, 4, 1, 4},
  };
  for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
    struct slab slab = smooth_slab(cases[n].st_distance, cases[n].mirrored, 20);
    struct cluster cluster = fit(&slab, 1, cases[n].lights);
    struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
    compare(cases[n].what, &lamp, 1, &cluster, 0, cases[n].distance);
    for (int k = 0; k < CLUSTER_DISTANCES && cases[n].lights > 1; ++k)
      compare_slab("  against the slab", &slab, cluster_distances[k], cluster.pages[0].error[k]);
    if (cases[n].lights == 8) assert_true(cluster.pages[0].error[1] < 0.1);
    cluster_free(&cluster);
    slab_free(&slab);
  }
}

/* Narrow beams and noise: a lobe between the receivers of the fit must not hide from the
 * error that is stated. */
TEST(test_narrow) {
  static const int fine[4] = {4, 4, 32, 32};
  static const double wide[4] = {-3, 3, -3, 3};
  struct slab slab = chain_slab(fine, edges, wide, INFINITY, 0, 26);
  for (size_t m = 0; m < slab_sample_count(&slab); ++m) {
    int at[4];
    slab_locate(&slab, m, at);
    double s = slab_position(&slab, SLAB_S, at[SLAB_S]),
           t = slab_position(&slab, SLAB_T, at[SLAB_T]);
    double light = s * s + t * t < 1.4 ? 1 : 0.05;
    for (int beam = 0; beam < 3; ++beam) {
      double x = s - 0.9 + 0.7 * beam, y = t - 0.6 * beam * (beam - 1);
      light += 4 * exp(-(x * x + y * y) / 0.02);
    }
    float *rgb = slab.rgb + 3 * m; /* random */
    for (int c = 0; c < 3; ++c) rgb[c] = (float)light * (1 + 0.2F * rgb[c]);
  }
  struct cluster cluster = fit(&slab, 1, 8);
  for (int k = 1; k < CLUSTER_DISTANCES; ++k) /* nearer by, the slab's few views tell apart */
    compare_slab("narrow beams", &slab, cluster_distances[k], cluster.pages[0].error[k]);
  cluster_free(&cluster);
  slab_free(&slab);
}

TEST(test_placed) {
  struct slab slab = smooth_slab(INFINITY, 0, 21);
  struct cluster cluster = fit(&slab, 1, 2);
  double c = cos(M_PI / 6), s = sin(M_PI / 6);
  const struct {
    const char *what;
    double scale, gain, matrix[12];
  } cases[] = {
      {"rotated, scale 0.3", 0.3, 2.5, {1, 0, 0, 0, c, s, 0, -s, c, 1, 2, 3}},
      {"mirrored, scale 3", 3, 0.1, {-c, -s, 0, -s, c, 0, 0, 0, 1, 0, 1, 0}},
  };
  struct chain_lamp lamps[2];
  for (size_t k = 0; k < 2; ++k) {
    lamps[k] = chain_lamp_of(&slab, 1, 1);
    lamps[k].scale = cases[k].scale;
    lamps[k].gain = cases[k].gain;
    memcpy(lamps[k].matrix, cases[k].matrix, sizeof cases[k].matrix);
    compare(cases[k].what, &lamps[k], 1, &cluster, 0, 2);
  }
  lamps[1] = lamps[0];
  for (int k = 0; k < 3; ++k) lamps[1].matrix[9 + k] += 0.4 * slab.u[k] + 0.3 * slab.v[k];
  compare("two instances", lamps, 2, &cluster, 0, 2);
  cluster_free(&cluster);
  slab_free(&slab);
}

/* Pages of their own sizes, side by side; the smaller gets fewer lights. */
TEST(test_pages) {
  struct slab pages[2] = {smooth_slab(INFINITY, 0, 22), smooth_slab(2, 1, 22)};
  for (int c = 0; c < 3; ++c) {
    pages[1].center[c] += pages[1].u[c];
    pages[1].u[c] *= 0.5;
    pages[1].v[c] *= 0.5;
  }
  struct cluster cluster = fit(pages, 2, 3);
  struct chain_lamp lamp = chain_lamp_of(pages, 2, 1);
  assert_int_equal(cluster.page_count, 2);
  assert_true(cluster.pages[0].count > cluster.pages[1].count);
  assert_true(cluster_light_count(&cluster) <= 3);
  compare("two pages", &lamp, 1, &cluster, 0, 3);
  cluster_free(&cluster);
  slab_free(&pages[0]);
  slab_free(&pages[1]);
}

/* Fewer points, asked for in the scene. */
TEST(test_fewer_points) {
  static double direct[3 * CHAIN_PIXELS];
  struct slab slab = smooth_slab(INFINITY, 0, 23);
  struct cluster cluster = fit(&slab, 1, 1);
  struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
  struct chain_plane plane = chain_facing(&lamp, 0, 0.8);
  for (int most = 1; most <= 2; ++most) {
    char sdl[1024];
    snprintf(sdl, sizeof sdl, "#declare Test_Lamp_Lights = %d;\n%s", most, chain_placed(&lamp, 1));
    sum_lights(&lamp, 1, &cluster, most, &plane, direct);
    assert_true(chain_error_of(&plane, 1, sdl, direct) < exact);
  }
  cluster_free(&cluster);
  slab_free(&slab);
}

TEST(test_refusals) {
  struct slab slab = smooth_slab(INFINITY, 0, 24);
  static const char *const modes[2] = {"cluster --lights 1", "point"};
  for (int m = 0; m < 2; ++m) {
    char options[64];
    snprintf(options, sizeof options, "--mode %s", modes[m]);
    chain_include(&slab, 1, "lamp", options);
    chain_says(&slab, CHAIN_LIT("0.0015, 1"), 1,
               "Test_Lamp_Canned: too small for POV-Ray's shadow tolerance");
    chain_says(&slab, CHAIN_LIT("0, 1"), 1, "Test_Lamp_Canned: Scale is 0.0000, must be positive");
  }
  /* A sheet of the lamp's name is another lamp. */
  chain_include(&slab, 1, "sheet", "");
  chain_says(&slab, "#include \"lamp.inc\"\n#include \"sheet.inc\"", 1,
             "another lamp of this name is included already");
  slab_free(&slab);
}

/* The far field, from afar: within its stated error, whichever way it is turned; the
 * smallest Scale is right, too. */
TEST(test_point) {
  static const double st_distances[2] = {INFINITY, 30};
  for (int d = 0; d < 2; ++d) {
    struct slab slab = smooth_slab(st_distances[d], d, 25);
    struct point point;
    chain_include(&slab, 1, "lamp", "--mode point");
    assert_int_equal(point_make(&slab, 1, NULL, 20, NULL, &point, NULL), RESULT_OK);
    compare_slab(d ? "point, st plane" : "point, infinite", &slab, 20, point.error_at);
    assert_true(point.error_at < 0.02);
    struct chain_lamp lamp = chain_lamp_of(&slab, 1, 1);
    const double mirrored[12] = {-0.6, 0.8, 0, 0.8, 0.6, 0, 0, 0, 1, 3, 1, 2};
    memcpy(lamp.matrix, mirrored, sizeof mirrored);
    lamp.scale = 0.0041;
    struct chain_plane plane = chain_facing(&lamp, 0, 20);
    double rmse = chain_error(&lamp, 1, &plane, 1, chain_placed(&lamp, 1));
    print_message("%-32s %.3g\n", "  mirrored, Scale 0.0041", rmse);
    assert_true(rmse <= slack * point.error_at + more);
    point_free(&point);
    slab_free(&slab);
  }
}

int main(void) {
  return testing_run(chain_setup, chain_teardown);
}
