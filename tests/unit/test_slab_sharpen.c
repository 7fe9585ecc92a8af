/* test_slab_sharpen.c - sharpened slabs have the cell means that they were made from, and
 * their views' sums; limited ones the sums, and no negative samples. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/slab_json.h"
#include "helpers.h"
#include "oracle/lookup.h"
#include "oracle/random.h"
#include "slab/slab_sharpen.h"

static const int grids[][4] = {{1, 1, 1, 1}, {2, 1, 1, 5}, {1, 2, 6, 1},
                               {1, 1, 2, 2}, {2, 3, 7, 4}, {1, 1, 64, 64}};
enum { GRIDS = sizeof grids / sizeof *grids };

static struct slab copy_of(const struct slab *slab) {
  struct slab copy;
  struct error error = {{0}};
  assert_ok(slab_copy_geometry(slab, &copy, &error), &error);
  assert_ok(slab_alloc(&copy, &error), &error);
  memcpy(copy.rgb, slab->rgb, 3 * sizeof(float) * slab_sample_count(slab));
  return copy;
}

static void sharpen(struct slab *slab, enum slab_sharpening how) {
  struct error error = {{0}};
  assert_ok(slab_sharpen(slab, how, &error), &error);
}

/* Of the interpolated radiance over a cell of s and t. It is bilinear in each quarter of the
 * cell, so that the quarters' centres tell their means. */
static double interpolated_mean(const struct slab *slab, const int at[4], int channel) {
  double x[4], rgb[3], sum = 0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (int axis = 0; axis < 4; ++axis) x[axis] = slab_position(slab, axis, at[axis]);
    x[2] += (quarter % 2 - 0.5) / 2 * slab_spacing(slab, SLAB_S);
    x[3] += (quarter / 2 - 0.5) / 2 * slab_spacing(slab, SLAB_T);
    oracle_lookup(slab, x, rgb);
    sum += rgb[channel] / 4;
  }
  return sum;
}

TEST(test_cell_means) {
  for (int g = 0; g < GRIDS - 1; ++g) {
    struct slab means = awkward_slab(grids[g], g % 2 ? INFINITY : 0.8);
    fill_colours(&means, (uint64_t)g);
    struct slab sharp = copy_of(&means);
    sharpen(&sharp, SLAB_SHARPEN_EXACT);
    for (size_t n = 0; n < slab_sample_count(&means); ++n) {
      int at[4];
      slab_locate(&means, n, at);
      for (int c = 0; c < 3; ++c)
        assert_near(interpolated_mean(&sharp, at, c), (double)means.rgb[3 * n + (size_t)c], 1e-6);
    }
    struct error error = {{0}};
    assert_ok(slab_unsharpen(&sharp, &error), &error);
    for (size_t n = 0; n < 3 * slab_sample_count(&means); ++n)
      assert_near((double)sharp.rgb[n], (double)means.rgb[n], 1e-6);
    slab_free(&means), slab_free(&sharp);
  }
}

/* In double: the sum of a line, and the line again. */
TEST(test_lines) {
  double means[3 * 300], line[3 * 300], scratch[2 * 300];
  uint64_t seed = 4;
  for (int count = 1; count <= 300; count = count < 9 ? count + 1 : count * 2 - 1) {
    double before = 0, after = 0;
    for (int k = 0; k < 3 * count; ++k) line[k] = means[k] = random_number(&seed);
    slab_sharpen_line(line + 1, count, 3, scratch);
    for (int k = 0; k < count; ++k) {
      before += means[3 * k + 1];
      after += line[3 * k + 1];
    }
    assert_near(after / before, 1, 1e-12);
    slab_unsharpen_line(line + 1, count, 3);
    for (int k = 0; k < 3 * count; ++k) assert_near(line[k], means[k], k % 3 == 1 ? 1e-14 : 0);
  }
}

static void assert_same_sums(const struct slab *a, const struct slab *b, double tolerance) {
  for (int j = 0; j < a->samples[SLAB_V]; ++j)
    for (int i = 0; i < a->samples[SLAB_U]; ++i) {
      double before[3] = {0}, after[3] = {0}, size = 0;
      for (int l = 0; l < a->samples[SLAB_T]; ++l)
        for (int k = 0; k < 3 * a->samples[SLAB_S]; ++k) {
          before[k % 3] += (double)slab_at(a, i, j, 0, l)[k];
          after[k % 3] += (double)slab_at(b, i, j, 0, l)[k];
          size += fabs((double)slab_at(b, i, j, 0, l)[k]);
        }
      for (int c = 0; c < 3; ++c) assert_near(after[c], before[c], tolerance * size);
    }
}

TEST(test_constant) {
  static const float values[] = {1, 0.1F, 1e-30F, 3e4F, -0.7F, 1 / 3.0F};
  for (int g = 0; g < GRIDS; ++g)
    for (int v = 0; v < 6; ++v)
      for (int how = 0; how < 2; ++how) {
        struct slab slab = awkward_slab(grids[g], INFINITY);
        for (size_t n = 0; n < 3 * slab_sample_count(&slab); ++n) slab.rgb[n] = values[v];
        struct slab sharp = copy_of(&slab);
        sharpen(&sharp, how ? SLAB_SHARPEN_POSITIVE : SLAB_SHARPEN_EXACT);
        assert_memory_equal(sharp.rgb, slab.rgb, 3 * sizeof(float) * slab_sample_count(&slab));
        slab_free(&slab), slab_free(&sharp);
      }
}

/* Views are black but for a tilted, coloured band; `behind` is what is beside it. */
static struct slab band(float behind) {
  struct slab slab = awkward_slab((const int[]){2, 2, 24, 20}, INFINITY);
  for (size_t n = 0; n < slab_sample_count(&slab); ++n) {
    int at[4];
    slab_locate(&slab, n, at);
    bool lit = abs(2 * at[2] + at[3] - 30 - 4 * at[0]) < 11;
    for (int c = 0; c < 3; ++c) slab.rgb[3 * n + (size_t)c] = lit ? 1 + (float)c : behind;
  }
  return slab;
}

TEST(test_negative) {
  struct slab means = band(0), exact = copy_of(&means), positive = copy_of(&means);
  sharpen(&exact, SLAB_SHARPEN_EXACT);
  sharpen(&positive, SLAB_SHARPEN_POSITIVE);
  assert_same_sums(&means, &exact, 1e-7);
  assert_same_sums(&means, &positive, 1e-7);
  double lowest = 0, off[2] = {0}, mean[2] = {0};
  for (size_t n = 0; n < slab_sample_count(&means); ++n) {
    const float *p = positive.rgb + 3 * n, *x = exact.rgb + 3 * n, *m = means.rgb + 3 * n;
    lowest = fmin(lowest, (double)x[0]);
    for (int c = 0; c < 3; ++c) assert_true(p[c] >= 0);
    /* the band's colour */
    assert_near((double)p[1], 2 * (double)p[0], 1e-6);
    assert_near((double)p[2], 3 * (double)p[0], 1e-6);
    mean[0] += (double)m[0], mean[1] += (double)p[0];
    off[0] += fabs((double)m[0] - (double)x[0]), off[1] += fabs((double)p[0] - (double)x[0]);
  }
  assert_true(lowest < -0.05);
  assert_near(mean[1] / mean[0], 1, 1e-7); /* clamping would have made it more */
  assert_true(off[1] < off[0]);
  slab_free(&means), slab_free(&exact), slab_free(&positive);
}

/* Where nothing would be negative, both ways are the same; what was negative stays so. */
TEST(test_limits) {
  struct slab bright = band(1.3F), exact = copy_of(&bright), positive = copy_of(&bright);
  sharpen(&exact, SLAB_SHARPEN_EXACT);
  sharpen(&positive, SLAB_SHARPEN_POSITIVE);
  assert_memory_equal(exact.rgb, positive.rgb, 3 * sizeof(float) * slab_sample_count(&exact));
  struct slab below = band(-0.5F), limited = copy_of(&below);
  sharpen(&limited, SLAB_SHARPEN_POSITIVE);
  assert_same_sums(&below, &limited, 1e-7);
  slab_free(&bright), slab_free(&exact), slab_free(&positive);
  slab_free(&below), slab_free(&limited);
}

/* The flux weighs with the cosine, which varies within a cell: it is kept as far as cells
 * are small. */
TEST(test_flux) {
  struct slab means = band(0), sharp = copy_of(&means);
  sharpen(&sharp, SLAB_SHARPEN_EXACT);
  for (int narrow = 0; narrow < 2; ++narrow) {
    double before[3], after[3];
    for (int k = 0; k < 4 && narrow; ++k) means.st_window[k] *= 1e-3;
    memcpy(sharp.st_window, means.st_window, sizeof sharp.st_window);
    slab_flux(&means, before, NULL), slab_flux(&sharp, after, NULL);
    for (int c = 0; c < 3; ++c) assert_near(after[c] / before[c], 1, narrow ? 2e-7 : 2e-3);
  }
  slab_free(&means), slab_free(&sharp);
}

TEST(test_record) {
  struct slab slab = awkward_slab(grids[0], INFINITY);
  struct error error = {{0}};
  assert_false(sampling_of(&slab).sharpened);
  assert_ok(
      slab_json_set(&slab, "provenance", "{\"tool\": \"x\", \"noise\": {\"flux\": 0.5}}", &error),
      &error);
  assert_false(sampling_of(&slab).sharpened);
  assert_ok(slab_json_record_sharpening(&slab, SLAB_SHARPEN_POSITIVE, &error), &error);
  assert_true(sampling_of(&slab).sharpened);
  char *how = json_of(&slab, "provenance", "sharpened");
  char *tool = json_of(&slab, "provenance", "tool");
  assert_string_equal(how, "\"st, not below zero\"");
  assert_string_equal(tool, "\"x\"");
  assert_near(sampling_of(&slab).flux_noise, 0.5, 0);
  assert_true(isnan(sampling_of(&slab).sample_noise));
  free(how), free(tool);
  /* a provenance that is no object gives way */
  assert_ok(slab_json_set(&slab, "provenance", "\"by hand\"", &error), &error);
  assert_ok(slab_json_record_sharpening(&slab, SLAB_SHARPEN_EXACT, &error), &error);
  assert_true(sampling_of(&slab).sharpened);
  slab_free(&slab);
}

int main(void) {
  return testing_run(NULL, NULL);
}
