/* test_image_error.c - what a picture says of its error, against a lamp whose radiance is known
 * everywhere: pictures by coarse or noisy slabs of it, against one by a slab that is fine enough.
 * That both come out within a factor of 2 guards the estimate against changes; how it does on many
 * lamps is bench/95-error.sh's to say. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_exr.h"
#include "file/slab_json.h"
#include "helpers.h"

#define SCENE "tests/render/scenes/occluder.obj"

/* 0.4 wide, windows +-1.2. */
static double lobe(const double at[4]) {
  double s = at[2] + 0.8 * at[0], t = at[3];
  return exp(-(s * s + t * t) / (2 * 0.25 * 0.25)) * (1 + at[1]);
}

/* Means of the lobe over the cells, with noise where it is light, which is recorded as a bake
 * does. */
static struct slab slab_of(int uv, int st, double noise) {
  static const double window[4] = {-1.2, 1.2, -1.2, 1.2};
  const int samples[4] = {uv, uv, st, st};
  struct slab slab = rough_slab(samples, INFINITY, window, FRAME_PLAIN, FILL_CONSTANT, 1);
  struct error error = {{0}};
  uint64_t seed = 5;
  double squares = 0;
  for (int c = 0; c < 3; ++c) slab.u[c] *= 0.4, slab.v[c] *= 0.4;
  for (size_t n = 0; n < slab_sample_count(&slab); ++n) {
    enum { POINTS = 16 };
    int index[4];
    double sum = 0;
    slab_locate(&slab, n, index);
    for (int p = 0; p < POINTS; ++p) {
      double at[4];
      for (int axis = 0; axis < 4; ++axis)
        at[axis] = slab_position(&slab, axis, index[axis]) +
                   (p >> axis & 1 ? 0.25 : -0.25) * slab_spacing(&slab, axis);
      sum += lobe(at) / POINTS;
    }
    double off = sum > 0.02 ? sqrt(12) * noise * random_between(&seed, -0.5, 0.5) : 0;
    squares += off * off;
    sum += off;
    for (size_t c = 0; c < 3; ++c) slab.rgb[3 * n + c] = (float)sum;
  }
  if (noise > 0) {
    char text[100];
    snprintf(text, sizeof text, "{\"noise\": {\"sample\": %g, \"flux\": 0}}",
             sqrt(squares / (double)slab_sample_count(&slab)));
    assert_int_equal(slab_json_set(&slab, "provenance", text, &error), RESULT_OK);
  }
  return slab;
}

/* A picture of the slab, and the numbers of "error" in its statistics. */
static struct picture render(struct slab *slab, const char *options, json_t **told) {
  char command[1024], out[256], stats[256];
  struct picture picture;
  struct error error = {{0}};
  snprintf(out, sizeof out, "%s", scratch("out.exr"));
  snprintf(stats, sizeof stats, "%s", scratch("out.json"));
  snprintf(command, sizeof command,
           "\"$RENDERSLAB\" image " SCENE " --light '%s at=0,1.5,0 toward=0,0,0' --camera "
           "'from=0.3,2,-2.2 at=0,0,0.1 fov=50' --size 64x48 -q -o %s --stats %s %s",
           write_light("lamp.tif", slab, 1), out, stats, options);
  assert_int_equal(system(command), 0);
  assert_int_equal(slab_exr_read(out, &picture, &error), RESULT_OK);
  json_t *root = json_load_file(stats, 0, NULL);
  *told = json_incref(json_object_get(root, "error"));
  json_decref(root);
  slab_free(slab);
  return picture;
}

static double part(const json_t *told, const char *name) {
  const json_t *value = json_object_get(told, name);
  assert_non_null(value);
  return json_is_null(value) ? NAN : json_number_value(value);
}

/* RMS of the difference over the mean. */
static double off(const struct picture *a, const struct picture *b) {
  size_t count = 3 * (size_t)a->width * (size_t)a->height;
  double sum = 0, mean = 0;
  for (size_t k = 0; k < count; ++k) {
    double d = (double)a->rgb[k] - (double)b->rgb[k];
    sum += d * d / (double)count;
    mean += (double)b->rgb[k] / (double)count;
  }
  return sqrt(sum) / mean;
}

static struct picture truth(void) {
  struct slab fine = slab_of(12, 72, 0);
  json_t *told;
  struct picture picture = render(&fine, "--tolerance 1e-4", &told);
  json_decref(told);
  return picture;
}

/* Resolution alone, noise alone, and the sum alone make nearly all of the error, as they are. */
TEST(test_parts) {
  static const struct {
    const char *part;
    int uv, st;
    double noise;
    const char *options;
  } cases[] = {
      {"resolution", 5, 16, 0, ""}, {"noise", 8, 40, 0.3, ""}, {"sum", 8, 60, 0, "--method views"}};
  struct picture exact = truth();
  for (int k = 0; k < 3; ++k) {
    struct slab slab = slab_of(cases[k].uv, cases[k].st, cases[k].noise);
    json_t *told;
    struct picture picture = render(&slab, cases[k].options, &told);
    double all = part(told, "all"), true_error = off(&picture, &exact);
    print_message("# %s: %.3g %% told, %.3g %% of it so, %.3g %% true\n", cases[k].part, 100 * all,
                  100 * part(told, cases[k].part), 100 * true_error);
    assert_true(all > true_error / 2 && all < 2 * true_error);
    assert_true(part(told, "logluv") == 0);
    assert_int_equal(isnan(part(told, "noise")), !(cases[k].noise > 0));
    assert_true(part(told, cases[k].part) > 0.7 * all);
    json_decref(told);
    picture_free(&picture);
  }
  picture_free(&exact);
}

int main(void) {
  return testing_run(NULL, NULL);
}
