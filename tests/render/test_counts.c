/* test_counts.c - how much work a receiver is: the micro lights that are visited, against the
 * paper's bound (section 4.1) and a count of its own. */
#include <math.h>
#include <stdlib.h>

#define receiver test_receiver /* gather.h has another */
#include "helpers.h"
#undef receiver
#include "gather/gather.h"

static const double window[4] = {-0.7, 1.1, -0.9, 0.6};
static const int sizes[] = {4, 7, 8, 16, 31, 32, 64};
enum { SIZES = sizeof sizes / sizeof sizes[0], EACH = 12 };

static struct light load(const struct slab *slabs, int count) {
  struct light light;
  struct error error = {""};
  if (light_load(write_light("counts.exr", slabs, count), &light, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  return light;
}

static struct receiver copy(const struct test_receiver *from) {
  struct receiver to = {.shininess = 0};
  for (int c = 0; c < 3; ++c) {
    to.position[c] = from->p[c];
    to.normal[c] = to.lift[c] = from->n[c];
  }
  return to;
}

static struct gather_counts count(const struct light *light, enum gather_method method,
                                  const struct receiver *receiver) {
  struct error error = {""};
  struct gather *gather;
  struct gathered gathered;
  const struct gather_settings settings = {
      .lights = light, .light_count = 1, .method = method, .tolerance = 1e-3, .level = -1};
  if (gather_create(&settings, &gather, &error) != RESULT_OK ||
      gather_light(gather, receiver, 1, &gathered, &error) != RESULT_OK)
    fail_msg("%s", error.text);
  const struct gather_counts counts = *gather_counts(gather);
  gather_free(gather);
  return counts;
}

/* ---- A count from the format's text (slab.h). */

static int ascending(const void *a, const void *b) {
  long double x = *(const long double *)a, y = *(const long double *)b;
  return (x > y) - (x < y);
}

/* Pieces of an axis of the aperture between the lines of its samples and of those of the
 * window, seen from (q, z). The ray from q through a has s = kappa a + (q - a)/z. */
static int pieces(const struct slab *slab, int axis, long double q, long double z) {
  long double line[2 * 64],
      kappa = isinf(slab->st_distance) ? 0 : 1 / (long double)slab->st_distance;
  const double *edge = axis ? slab->v : slab->u, *s = slab->st_window + 2 * axis;
  long double half = sqrtl((long double)edge[0] * edge[0] + (long double)edge[1] * edge[1] +
                           (long double)edge[2] * edge[2]) /
                     2;
  long double end[2] = {-half, half}, at[2];
  int near = slab->samples[axis ? SLAB_V : SLAB_U], far = slab->samples[axis ? SLAB_T : SLAB_S];
  for (int k = 0; k < 2; ++k) at[k] = ((long double)s[k] - q / z) / (kappa - 1 / z);
  end[0] = fmaxl(end[0], fminl(at[0], at[1]));
  end[1] = fminl(end[1], fmaxl(at[0], at[1]));
  if (!(end[0] < end[1])) return 0;
  for (int k = 0; k < near; ++k) line[k] = (2 * k + 1 - near) * half / near;
  for (int k = 0; k < far; ++k) line[near + k] = at[0] + (at[1] - at[0]) * (2 * k + 1) / (2 * far);
  qsort(line, (size_t)(near + far), sizeof *line, ascending);
  int count = 1;
  for (int k = 0; k < near + far; ++k)
    count += line[k] > end[0] && line[k] < end[1] && (k == 0 || line[k] > line[k - 1]);
  return count;
}

static uint64_t visible(const struct slab *slab, const double p[3]) {
  long double along[3] = {0}; /* u, v, normal */
  const double *frame[3] = {slab->u, slab->v, slab->normal};
  for (int axis = 0; axis < 3; ++axis) {
    long double length = 0;
    for (int c = 0; c < 3; ++c) {
      along[axis] += ((long double)p[c] - slab->center[c]) * frame[axis][c];
      length += (long double)frame[axis][c] * frame[axis][c];
    }
    along[axis] /= sqrtl(length);
  }
  return (uint64_t)pieces(slab, 0, along[0], along[2]) *
         (uint64_t)pieces(slab, 1, along[1], along[2]);
}

/* ---- Counts. */

struct tally {
  int seen, unseen;
  double worst; /* share of the bound */
};

static void hold(const struct slab *slab, uint32_t seed, struct tally *tally) {
  struct light light = load(slab, 1);
  const int *n = slab->samples;
  uint64_t bound = (uint64_t)(n[SLAB_U] + n[SLAB_S] + 1) * (uint64_t)(n[SLAB_V] + n[SLAB_T] + 1);
  for (int k = 0; k < EACH; ++k) {
    double z = 0.05 * pow(1000, random_number(&seed));
    struct test_receiver aimed = aimed_receiver(slab, z, RECEIVER_FACING, &seed);
    struct receiver receiver = copy(&aimed);
    uint64_t expected = visible(slab, aimed.p);
    assert_true(expected <= bound);
    struct gather_counts pi = count(&light, GATHER_PI, &receiver);
    assert_int_equal(pi.microlights, expected);
    assert_int_equal(pi.nodes, expected);
    assert_int_equal(pi.pages_behind, expected == 0);
    /* At this tolerance no micro light is split. */
    assert_int_equal(count(&light, GATHER_REFERENCE, &receiver).microlights, expected);
    assert_int_equal(count(&light, GATHER_PAPER, &receiver).microlights, expected);
    ++*(expected > 0 ? &tally->seen : &tally->unseen);
    tally->worst = fmax(tally->worst, (double)expected / (double)bound);
  }
  light_free(&light);
}

/* Along u and s the sizes; along v and t few samples, so that the slab stays small; and the
 * other way round. */
static void test_axes(void **state) {
  (void)state;
  struct tally tally = {0};
  for (int k = 0; k < 2 * SIZES * SIZES; ++k) {
    int uv = sizes[k / 2 % SIZES], st = sizes[k / 2 / SIZES];
    const int along_u[SLAB_AXES] = {uv, 3, st, 4}, along_v[SLAB_AXES] = {3, uv, 4, st};
    for (int far = 0; far < 2; ++far) {
      struct slab slab = rough_slab(k % 2 ? along_v : along_u, far ? INFINITY : 0.8, window,
                                    FRAME_TURNED, FILL_UNIFORM, (uint32_t)k);
      hold(&slab, (uint32_t)(2 * k + far), &tally);
      slab_free(&slab);
    }
  }
  print_message("%d receivers, %d see nothing; at most %.3f of the bound\n",
                tally.seen + tally.unseen, tally.unseen, tally.worst);
  assert_true(tally.seen > 9 * tally.unseen);
}

static void test_all_axes(void **state) {
  (void)state;
  static const int grids[][SLAB_AXES] = {{4, 4, 4, 4}, {8, 8, 16, 16}, {16, 16, 32, 32}};
  struct tally tally = {0};
  for (int g = 0; g < 3; ++g)
    for (int far = 0; far < 2; ++far) {
      struct slab slab = rough_slab(grids[g], far ? INFINITY : 2, window, FRAME_MIRRORED,
                                    FILL_UNIFORM, (uint32_t)g);
      hold(&slab, (uint32_t)(500 + 2 * g + far), &tally);
      slab_free(&slab);
    }
  assert_true(tally.seen > 0);
}

/* ---- Pages that are skipped. */

static void test_skipped(void **state) {
  (void)state;
  static const int samples[SLAB_AXES] = {6, 6, 8, 8};
  struct slab slab = rough_slab(samples, INFINITY, window, FRAME_PLAIN, FILL_UNIFORM, 1);
  struct light light = load(&slab, 1);
  static const struct receiver skipped[] = {
      {.position = {0.1, 0.1, -1}, .normal = {0, 0, 1}},     /* behind the aperture */
      {.position = {0.1, 0.1, 1}, .normal = {0, 0, 1}},      /* turned away from it */
      {.position = {4, 0.1, 1}, .normal = {0, 0, -1}},       /* beside the window */
      {.position = {0.1, 0.1, 1}, .normal = {0, 0.6, 0.8}}}; /* all below its tangent plane */
  for (int method = GATHER_AUTO; method < GATHER_METHODS; ++method) {
    if (method == GATHER_LEVELS || method == GATHER_PAPER_LEVELS) continue; /* have aids */
    for (size_t k = 0; k < sizeof skipped / sizeof skipped[0]; ++k) {
      struct gather_counts counts = count(&light, (enum gather_method)method, &skipped[k]);
      assert_int_equal(counts.pages_behind, 1);
      assert_int_equal(counts.microlights, 0);
      assert_int_equal(counts.nodes, 0);
    }
  }
  light_free(&light);
  slab_free(&slab);
}

/* Two pages back to back: every receiver sees one. */
static void test_back_to_back(void **state) {
  (void)state;
  static const int samples[SLAB_AXES] = {6, 6, 8, 8};
  struct slab slabs[2];
  for (int k = 0; k < 2; ++k)
    slabs[k] = rough_slab(samples, INFINITY, window, FRAME_PLAIN, FILL_UNIFORM, (uint32_t)k);
  for (int c = 0; c < 3; ++c) slabs[1].normal[c] = -slabs[0].normal[c];
  struct light light = load(slabs, 2);
  for (int side = 0; side < 2; ++side) {
    struct receiver receiver = {.position = {0.1, 0.1, side ? -1 : 1},
                                .normal = {0, 0, side ? 1 : -1}};
    struct gather_counts counts = count(&light, GATHER_PI, &receiver);
    assert_int_equal(counts.pages_behind, 1);
    assert_int_equal(counts.microlights, visible(&slabs[side], receiver.position));
    assert_true(counts.microlights > 0);
  }
  light_free(&light);
  for (int k = 0; k < 2; ++k) slab_free(&slabs[k]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_axes),
      cmocka_unit_test(test_all_axes),
      cmocka_unit_test(test_skipped),
      cmocka_unit_test(test_back_to_back),
  };
  return cmocka_run_group_tests_name("counts", tests, NULL, NULL);
}
